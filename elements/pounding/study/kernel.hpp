#pragma once
/// Histories of linear structures that pound, thousands in a second: no allocation, no file and no PETSc in the loop.
///
/// Between impacts the motion of every mode is exact, since the ground's acceleration is straight between samples;
/// touches and peaks are located on its Taylor polynomial. So is the motion in contact by a law that is linear in each
/// of its phases. With the other laws of pounding/laws the modes are integrated by Dormand & Prince's pair 5(4). Each
/// step is cut at samples and landed on the events of the contact. Where a law's force grows by a fraction of a power
/// of d (Hertz: d^1.5), it is not smooth in time after a touch; steps there go by s = (t - touch)^(1/p), in which it
/// is, p = 2 or 4 by the law's own exponents. Dormand & Prince 1980, J. Comput. Appl. Math. 6:19.

#include <span>
#include <vector>

#include <pounding/study/linear_model.hpp>

namespace pounding::study {

/// Acceleration of the ground: straight between samples, zero after the last.
struct EvenRecord {
  std::span<const double> accelerations;  ///< the first at time 0; two at least [m/s^2]
  double step = 0;                        ///< between samples [s]
  double factor = 1;                      ///< multiplies all samples
};

/// How histories are computed.
struct Settings {
  double duration = 0;  ///< of a history [s]; 0: of the record
  double tolerance =
      2e-5;  ///< error of a step in contact, relative to the closing speed of the impact, in [1e-13, 1e-2]
  long max_steps = 10'000'000;  ///< in contact, in one history
};

/// One link in one history.
struct LinkPeaks {
  int impacts = 0;
  double peak_force = 0;        ///< [N]
  double peak_penetration = 0;  ///< [m]
  double impulse = 0;           ///< of all impacts [N s]
  double energy_lost = 0;       ///< in all impacts; without what a contact that still presses can give back [J]
};

/// One history.
struct Peaks {
  std::vector<double> outputs;   ///< as LinearModel::outputs
  std::vector<LinkPeaks> links;  ///< as LinearModel::links
  long steps = 0;                ///< kept in contact
};

/// Runs one history. It depends on its arguments alone, so that rows may be computed in any order, in any chunks and on
/// any thread: the bits are the same. Throws std::invalid_argument as LinearModel::check(), and for a record or
/// settings out of range; SolverError, with the time, when steps in contact become too short or too many.
Peaks run(const LinearModel& model, const EvenRecord& record, const Settings& settings = {});

}  // namespace pounding::study
