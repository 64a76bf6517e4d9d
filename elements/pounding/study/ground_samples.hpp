#pragma once
/// Ground acceleration of a history: linear in intervals that are short compared with the periods of all modes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <pounding/study/kernel.hpp>
#include <pounding/study/modal_state.hpp>

namespace pounding::study {

class GroundSamples {
 public:
  GroundSamples(const LinearModel& model, const EvenRecord& record)
      : factor_(record.factor),
        pieces_(pieces(model, record)),
        step_(record.step / static_cast<double>(pieces_)),
        reach_(fastest(model) * step_),
        refined_(refined(record, pieces_)),
        samples_(pieces_ == 1 ? record.accelerations : refined_),
        last_(static_cast<long>(samples_.size()) - 1) {}
  // Not copyable: contains a pointer to its own samples.
  GroundSamples(const GroundSamples&) = delete;
  GroundSamples& operator=(const GroundSamples&) = delete;

  /// Length of an interval [s].
  double step() const noexcept { return step_; }
  /// Maximum omega h or 2 zeta omega h of an interval, at most 1.
  double reach() const noexcept { return reach_; }
  /// Value just before the beginning of interval n; zero after the record.
  double before(long n) const noexcept { return n <= last_ ? factor_ * samples_[static_cast<std::size_t>(n)] : 0; }
  /// Value just after it: the record jumps to zero at its end.
  double after(long n) const noexcept { return after(n, before(n)); }
  /// Value just after it, from the known value just before it.
  double after(long n, double before) const noexcept { return n < last_ ? before : 0; }
  /// Acceleration in interval n.
  Ground in(long n) const noexcept { return {.at = after(n), .slope = slope(n)}; }
  /// Acceleration in interval n and the next one; in n alone if the record jumps between them.
  Ground in_both(long n) const noexcept {
    if (n + 1 == last_) return in(n);
    return {.at = after(n), .slope = slope(n), .corner = step_, .bend = slope(n + 1) - slope(n)};
  }

 private:
  double slope(long n) const noexcept { return (before(n + 1) - after(n)) / step_; }
  static double fastest(const LinearModel& model) {
    double rate = 0;
    for (std::size_t j = 0; j < model.stiffness.size(); ++j)
      rate = std::max({rate, std::sqrt(model.stiffness[j]), model.damping[j]});
    return rate;
  }
  static long pieces(const LinearModel& model, const EvenRecord& record) {
    return std::max(1L, static_cast<long>(std::ceil(fastest(model) * record.step)));
  }
  // Samples between which the record is linear, one at each end of an interval.
  static std::vector<double> refined(const EvenRecord& record, long pieces) {
    std::vector<double> all;
    if (pieces == 1) return all;
    const auto samples = record.accelerations;
    all.reserve(samples.size() * static_cast<std::size_t>(pieces));
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
      for (long part = 0; part < pieces; ++part)
        all.push_back(samples[i] +
                      (samples[i + 1] - samples[i]) * static_cast<double>(part) / static_cast<double>(pieces));
    all.push_back(samples.back());
    return all;
  }

  double factor_;
  long pieces_;
  double step_, reach_;
  std::vector<double> refined_;
  std::span<const double> samples_;
  long last_;
};

}  // namespace pounding::study
