#pragma once
/// One row of the table of impacts.

#include <cmath>

namespace pounding {

/// One impact of a link, as in /impacts of the results file.
struct ImpactRow {
  int link = 0;           ///< index into the links, in the order of the input
  double t_start = 0;     ///< touch [s]
  double t_end = 0;       ///< separation: the penetration returns to zero, or the law ends the contact [s]
  double t_release = 0;   ///< the force fell to zero for the last time [s]; equals t_end for laws without a slack phase
  double v_approach = 0;  ///< closing speed at touch [m/s]
  double v_separation = 0;      ///< opening speed at separation, positive if the bodies separate [m/s]
  double restitution = 0;       ///< v_separation / v_approach; NaN for a touch at rest
  double peak_force = 0;        ///< [N]; NaN for a rigid impact
  double t_peak = 0;            ///< time of the peak force [s]
  double peak_penetration = 0;  ///< [m]
  double impulse = 0;           ///< integral of the force [N s]
  double energy_lost = 0;       ///< work done on the link and dissipated [J]
  double energy_stored = 0;     ///< recoverable energy of a closed contact [J]; zero after the impact
};

/// True while the contact presses: neither released nor separated.
inline bool still_presses(const ImpactRow& row) noexcept { return std::isnan(row.t_end) && std::isnan(row.t_release); }

}  // namespace pounding
