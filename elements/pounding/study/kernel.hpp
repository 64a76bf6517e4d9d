#pragma once
/// Response histories of linear structures with pounding, thousands per second: no allocation, file access or PETSc in
/// the loop.
///
/// Between impacts the motion of each mode is exact, since the ground acceleration is linear between samples; touches
/// and peaks are located on its Taylor polynomial. The same holds in contact for laws that are linear in each of their
/// phases. For the other laws of pounding/laws the modes are integrated by Dormand & Prince's pair 5(4). Each step is
/// cut at samples and ends on the events of the contact. If the force of a law grows with a fractional power of d
/// (Hertz: d^1.5), it is not smooth in time after a touch. Steps there use s = (t - touch)^(1/p), in which it is
/// smooth, with p = 2 or 4 from the exponents of the law. Dormand & Prince 1980, J. Comput. Appl. Math. 6:19.

#include <span>
#include <vector>

#include <pounding/study/linear_model.hpp>

namespace pounding::study {

/// Ground acceleration: linear between samples, zero after the last.
struct EvenRecord {
  std::span<const double> accelerations;  ///< the first at time 0; at least two [m/s^2]
  double step = 0;                        ///< between samples [s]
  double factor = 1;                      ///< multiplies all samples
};

/// Settings of the histories.
struct Settings {
  double duration = 0;  ///< of a history [s]; 0: that of the record
  double tolerance =
      2e-5;  ///< error of a step in contact, relative to the closing speed of the impact, in [1e-13, 1e-2]
  long max_steps = 10'000'000;  ///< maximum number of steps in contact, per history
};

/// Peaks of one link in one history.
struct LinkPeaks {
  int impacts = 0;
  double peak_force = 0;        ///< [N]
  double peak_penetration = 0;  ///< [m]
  double impulse = 0;           ///< of all impacts [N s]
  double energy_lost = 0;       ///< in all impacts; without the recoverable energy of a closed contact [J]
};

/// Peaks of one history.
struct Peaks {
  std::vector<double> outputs;   ///< in the order of LinearModel::outputs
  std::vector<LinkPeaks> links;  ///< in the order of LinearModel::links
  long steps = 0;                ///< accepted steps in contact
};

/// Computes one history. Pure: results are bitwise independent of order, chunking and threads. Throws
/// std::invalid_argument like LinearModel::check(), and for a record or settings out of range; SolverError, with the
/// time, if steps in contact become too short or too many.
Peaks run(const LinearModel& model, const EvenRecord& record, const Settings& settings = {});

}  // namespace pounding::study
