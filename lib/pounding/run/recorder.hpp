#pragma once
/// Turns kept steps into histories, peaks and the energy balance.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/run/floor_response.hpp>
#include <pounding/model/model.hpp>
#include <pounding/results/results.hpp>
#include <pounding/stepping/stepper.hpp>
#include <pounding/results/summary.hpp>

namespace pounding {

/// Largest absolute value of a quantity that is known with its slope at both ends of every step.
class Peak {
 public:
  /// Values and slopes at the ends of a step of length h; a turn inside it is found on the cubic through them.
  void follow(double h, double begin, double slope_begin, double end, double slope_end);
  void follow(double value);
  /// Values at the beginning, the middle and the end of a step: a turn inside it is found on the parabola through them.
  void follow(double begin, double middle, double end);
  double largest() const { return largest_; }

 private:
  double largest_ = 0;
};

/// Samples of one link, dense inside impacts. A long impact is thinned evenly so that the memory stays bounded.
class LinkSampler {
 public:
  /// Along the contact, one or two directions [N].
  using Friction = std::array<double, 2>;

  /// A kept step outside of contact goes straight to the history.
  void apart(double time, const LinkMotion& motion, double energy, LinkHistory& history) const;
  /// A kept step in contact waits for the end of the impact.
  void pressed(double time, const LinkMotion& motion, double force, const Friction& friction, double energy);
  /// The impact is over (or the run is): its samples go to the history.
  void finish(LinkHistory& history);
  /// Copies the samples of an impact that is not over, for a file that is written meanwhile.
  void show(LinkHistory& history) const;
  void archive(Archive& archive);

 private:
  struct Sample {
    double time, penetration, velocity, force, energy;
    Friction friction;
  };
  static void append(const Sample& sample, LinkHistory& history);

  std::vector<Sample> samples_;
  Sample last_{};
  int stride_ = 1, skipped_ = 0;
};

/// Fills the results of a run, step by step.
class Recorder {
 public:
  Recorder(const Model& model, const Stepper& stepper, Results& results);

  /// The initial state.
  void begin();
  /// The step that the stepper has just kept.
  void step();
  /// Unfinished impacts and the last energies.
  void end();
  /// Calls `write` with the results as they are now, impacts that are not over included.
  void with_present_state(const std::function<void()>& write);
  /// What goes on from one step to the next beside the histories, and how long those of links and energies are without
  /// what is shown of the present state: reading cuts the histories of a file there.
  void archive(Archive& archive);

  /// Of all links so far.
  int impacts() const;
  /// Peaks and energies so far.
  void summarize(Summary& summary) const;

 private:
  /// Peaks of one floor and of the storey below it. In space displacement, drift and acceleration are horizontal vectors.
  struct FloorPeaks {
    Peak displacement, drift, acceleration;
  };

  void sample(double time, const Eigen::MatrixXd& motion, const Eigen::VectorXd& ground, bool at_end);
  void sample_structure(int structure, const Eigen::MatrixXd& motion, bool inside, double time);
  void sample_whole(double time, bool inside);
  void sample_members(int structure, const Eigen::VectorXd& u, bool inside, double time);
  void add_enforced(int structure, double time);
  void follow_peaks();
  void follow_vector(Peak& peak, double h, int column, int below);
  int tangent_of(int link) const;  // first column of its friction
  void sample_links();
  void sample_energy();
  void collect_impacts();
  void accelerations_of_ground(double time, Eigen::VectorXd& ground) const;

  const Model& model_;
  const Stepper& stepper_;
  Results& results_;
  FloorResponse followed_;
  GroundPlan plan_;
  std::vector<int> first_;
  bool looks_inside_;  // steps are so long that accelerations turn inside them
  bool linked_, whole_ = false;  // whole: shears of frames, nodes or members are reported
  long outputs_ = 0;
  bool energy_due_ = false;
  std::vector<std::vector<FloorPeaks>> peaks_;
  std::vector<LinkSampler> samplers_;
  double largest_input_ = 0, largest_imbalance_ = 0;
  Eigen::MatrixXd motion_, begin_, middle_, end_;
  Eigen::VectorXd ground_, u_, v_, a_, force_;
};

}  // namespace pounding
