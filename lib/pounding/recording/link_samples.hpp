#pragma once
/// Histories of links: one sample an output time while a link is open; while it presses two a step, one at the peak
/// force, and more where the force bends.

#include <array>
#include <cstddef>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/model.hpp>
#include <pounding/results/results.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// One sample of a link.
struct LinkSample {
  double time = 0, penetration = 0, velocity = 0, force = 0, energy = 0;  ///< [s], [m], [m/s], [N], [J]
  std::array<double, 2> friction{};  ///< along the contact, in one or two directions [N]
};

/// Samples of the present impact of one link. They are held back until it ends: where they become too many, every other
/// one is dropped, so that the memory of an impact is bounded however long it lasts.
class ImpactSamples {
 public:
  /// More samples than these of one impact are thinned out; an even number.
  static constexpr std::size_t max_count = 2048;

  /// Whether no impact has begun.
  bool empty() const { return samples_.empty(); }
  /// The first sample of a contact that presses from the start of the run.
  void begin_pressed(const LinkSample& sample);
  /// A sample in contact. The first one of an impact stands twice, with zero force before: a force may jump at the
  /// touch.
  void add(const LinkSample& sample);
  /// Appends the samples so far, the last one included, to a history.
  void show(LinkHistory& history) const;
  /// The impact is over, or the run: its samples go to the history.
  void finish(LinkHistory& history);
  /// For a checkpoint.
  void archive(Archive& archive);

 private:
  std::vector<LinkSample> samples_;
  LinkSample last_{};  // that was skipped
  int stride_ = 1, skipped_ = 0;
};

/// Fills the histories of all links of a model.
class LinkSamples {
 public:
  /// Makes one history a link in `histories`, which must outlive this as model and stepper must. None for a system
  /// without contacts.
  LinkSamples(const Model& model, const Stepper& stepper, std::vector<LinkHistory>& histories);

  /// The step that the stepper has just kept; `output_due` when it holds an output time.
  void step(bool output_due);
  /// The run is over.
  void end();
  /// Appends the samples of unfinished impacts to the histories, and takes them back.
  void show_unfinished();
  void hide_unfinished();
  /// For a checkpoint: also the lengths of the histories, to which reading cuts them.
  void archive(Archive& archive);

 private:
  struct Inside;

  std::array<double, 2> friction(std::size_t link, double LinkStep::* force) const;
  void add_inside(std::size_t link, const LinkStep& step, const Contact& contact, const ImpactRow& row);
  void add_inside(const Inside& in, double s, const Jet& at, double force);
  void add_between(const Inside& in, double s, double force_s, double e, double force_e, int depth);

  const Model& model_;
  const Stepper& stepper_;
  std::vector<LinkHistory>& histories_;
  std::vector<ImpactSamples> impacts_;
  std::vector<int> first_tangent_;    // by link: first column of its friction; -1 for none
  std::vector<std::size_t> lengths_;  // of the histories without what is shown
};

}  // namespace pounding
