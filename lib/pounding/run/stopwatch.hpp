#pragma once
/// Wall time.

#include <chrono>

namespace pounding {

/// Measures from its construction or from the last restart.
class Stopwatch {
 public:
  /// Elapsed wall time [s].
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  void restart() { begin_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace pounding
