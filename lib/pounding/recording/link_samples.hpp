#pragma once
/// Histories of links: one sample per output time while a link is open; in contact two per step, one at the peak force,
/// and more if the force curves sharply.

#include <array>
#include <cstddef>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/model.hpp>
#include <pounding/results/envelope.hpp>
#include <pounding/results/results.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// One sample of a link.
struct LinkSample {
  double time = 0, penetration = 0, velocity = 0, force = 0, energy = 0;  ///< [s], [m], [m/s], [N], [J]
  std::array<double, 2> friction{};                                       ///< tangential, in one or two directions [N]
};

/// Samples of the current impact of one link, buffered until it ends. If the buffer is full, every other sample is
/// dropped, so the memory per impact is bounded.
class ImpactSamples {
 public:
  /// Maximum number of samples per impact before they are thinned; even.
  static constexpr std::size_t max_count = 2048;

  /// True if no impact has begun.
  bool empty() const { return samples_.empty(); }
  /// Adds the first sample of a contact that is closed at the start of the run.
  void begin_pressed(const LinkSample& sample);
  /// Adds a sample in contact. The first one of an impact is preceded by a copy with zero force, because the force may
  /// jump at the touch.
  void add(const LinkSample& sample);
  /// Appends all samples, including the last one, to a history.
  void show(LinkHistory& history) const;
  /// Moves the samples to the history at the end of the impact or the run.
  void finish(LinkHistory& history);
  /// For a checkpoint.
  void archive(Archive& archive);

 private:
  std::vector<LinkSample> samples_;
  LinkSample last_{};  // last skipped sample
  int stride_ = 1, skipped_ = 0;
};

/// Fills the histories of all links of a model.
class LinkSamples {
 public:
  /// Creates one history per link in `histories`; none for a system without contacts. All arguments must outlive this.
  LinkSamples(const Model& model, const StepView& stepper, std::vector<LinkHistory>& histories);

  /// Reads the gaps at the start of the run.
  void begin();
  /// Records the step that the stepper has just accepted; `output_due` if it contains an output time.
  void step(bool output_due);
  /// Largest openings of all links, in the order of the model, see LinkSummary [m].
  const Extremes& openings() const { return openings_; }
  /// Completes the histories at the end of the run.
  void end();
  /// Appends the samples of unfinished impacts to the histories; removes them again.
  void show_unfinished();
  void hide_unfinished();
  /// For a checkpoint. Includes the lengths of the histories; reading truncates them.
  void archive(Archive& archive);

 private:
  struct Inside;

  void show_openings();
  void record_opening(std::size_t link, const LinkStep& step);
  std::array<double, 2> friction(std::size_t link, double LinkStep::* force) const;
  void add_inside(std::size_t link, const LinkStep& step, const ImpactRow& row);
  void add_inside(const Inside& in, double s, const Jet& at, double force);
  void add_between(const Inside& in, double s, double force_s, double e, double force_e, int depth);

  const Model& model_;
  const StepView& stepper_;
  std::vector<LinkHistory>& histories_;
  std::vector<ImpactSamples> impacts_;
  std::vector<int> first_tangent_;    // by link: first column of its friction; -1 for none
  std::vector<std::size_t> lengths_;  // of the histories without unfinished impacts
  Extremes openings_;                 // by link, from the undeformed state [m]
  std::vector<double> gaps_;          // by link, at the beginning of the step: permanent indentation widens them [m]
};

}  // namespace pounding
