#pragma once
/// The hardest impacts of a run: the state before each, and what the links did.

#include <Eigen/Core>
#include <utility>
#include <vector>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// Some milliseconds of a run in which links press.
struct ImpactWindow {
  /// Force of a link in one step [N], and the slopes of its law at the end of it; those of links that are no contacts
  /// are zero.
  struct Force {
    int link = 0;
    double begin = 0, middle = 0, end = 0;
    double by_penetration = 0, by_rate = 0;  ///< [N/m], [N s/m]
  };
  /// One kept step, with the links whose force is not zero in it.
  struct Step {
    double begin = 0, end = 0;  ///< [s]
    std::vector<Force> forces;

    /// Writes all members, or reads them back.
    void archive(Archive& archive);
  };

  double force = 0;      ///< the largest of the contacts that count [N]
  Eigen::VectorXd u, v;  ///< coordinates of the structures at the beginning of the first step, and their rates
  std::vector<Step> steps;

  double begin() const { return steps.front().begin; }
  double end() const { return steps.back().end; }
  /// Writes all members, or reads them back.
  void archive(Archive& archive);
};

/// Keeps the windows with the largest forces while a run goes on. A window begins with the step that leads to a touch,
/// and ends 2 ms after nothing presses any more, or after 0.1 s: then the next one begins at once.
class ImpactWindows {
 public:
  /// So many are kept.
  static constexpr std::size_t maximum = 3;

  /// `counts`: by contact, whether its impacts are looked at. `stepper` must outlive this.
  ImpactWindows(const Stepper& stepper, std::vector<bool> counts) : stepper_(stepper), counts_(std::move(counts)) {}

  /// One kept step.
  void step();
  /// The run is over, perhaps within an impact.
  void end();
  /// The windows with the largest forces, the hardest first.
  const std::vector<ImpactWindow>& hardest() const { return hardest_; }
  /// For a checkpoint.
  void archive(Archive& archive);

 private:
  bool presses() const;
  void record();

  const Stepper& stepper_;
  std::vector<bool> counts_;
  std::vector<ImpactWindow> hardest_;
  ImpactWindow present_;  // without steps where nothing presses
  double last_pressed_ = 0;
};

}  // namespace pounding
