#pragma once
/// Converts the accepted steps of a run to results: histories, impacts, envelopes and the energy balance.

#include <Eigen/Core>
#include <functional>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>
#include <pounding/recording/collapse.hpp>
#include <pounding/recording/device_histories.hpp>
#include <pounding/recording/floor_envelopes.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/recording/force_envelopes.hpp>
#include <pounding/recording/link_samples.hpp>
#include <pounding/recording/spring_histories.hpp>
#include <pounding/recording/step_motion.hpp>
#include <pounding/recording/storey_shears.hpp>
#include <pounding/recording/structure_histories.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// Fills the results of a run, step by step.
class Recorder {
 public:
  /// Creates the histories in `results`. All arguments must outlive this.
  Recorder(const Model& model, const StepView& stepper, Results& results);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Records the initial state.
  void begin();
  /// Records the step that the stepper has just accepted. Returns true if it contains an output time.
  bool step();
  /// Completes the results at the end of the run: unfinished impacts, the last energies.
  void end();
  /// Calls `write` with results that include the current state, such as unfinished impacts, and then removes it.
  void with_present_state(const std::function<void()>& write);
  /// Serialises the recorder, the envelopes, and the lengths of the link and energy histories; reading truncates these
  /// histories.
  void archive(Archive& archive);

  /// State of collapse of the structures.
  const Collapse& collapse() const { return collapse_; }
  /// Mapping of the rows of the floor motion.
  const FloorResponse& response() const { return response_; }
  /// Number of impacts of all links up to now.
  int impacts() const;
  /// Fills peaks, links, devices and energies of a summary for the run up to now.
  void summarize(Summary& summary) const;

 private:
  void sample_outputs_until(double end);
  void sample(double time, bool inside);
  void accelerations_of_ground(double time);
  void sample_energy();
  std::vector<ImpactRow> impacts_in_order() const;
  bool has_links() const { return stepper_.system().contact_count() > 0; }

  const Model& model_;
  const StepView& stepper_;
  Results& results_;
  GroundPlan plan_;
  FloorResponse response_;
  LinkSamples links_;
  DeviceHistories devices_;
  StructureHistories structures_;
  SpringHistories springs_;
  StepMotion step_motion_;
  FloorEnvelopes floors_;
  Collapse collapse_;
  StoreyShears storeys_;
  ForceEnvelopes forces_;
  long outputs_ = 0;                          // number of recorded output times
  double max_input_ = 0, max_imbalance_ = 0;  // maximum absolute values over the run [J]
  Eigen::MatrixXd motion_;                    // motion of the floors at an output time
  Eigen::VectorXd ground_;                    // accelerations of all ground motions at that time [m/s^2]
};

}  // namespace pounding
