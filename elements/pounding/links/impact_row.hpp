#pragma once
/// One row of the table of impacts.

#include <cmath>

namespace pounding {

/// One impact of one link, as in /impacts of the results file.
struct ImpactRow {
  int link = 0;           ///< index into the links, in the order of the input
  double t_start = 0;     ///< touch [s]
  double t_end = 0;       ///< separation: the penetration is zero again, or the law ends the contact [s]
  double t_release = 0;   ///< the force fell to zero for the last time [s]; equals t_end for laws without a slack phase
  double v_approach = 0;  ///< closing speed at touch [m/s]
  double v_separation = 0;      ///< opening speed at separation, positive when the bodies part [m/s]
  double restitution = 0;       ///< v_separation / v_approach; NaN for a touch at rest
  double peak_force = 0;        ///< [N]; NaN for a rigid impact
  double t_peak = 0;            ///< time of the peak force [s]
  double peak_penetration = 0;  ///< [m]
  double impulse = 0;           ///< integral of the force [N s]
  double energy_lost = 0;       ///< work that the link took and dissipated [J]
  double energy_stored = 0;     ///< work that a contact which still presses can give back [J]; zero once it is over
};

/// True while the contact presses: neither released nor over.
inline bool still_presses(const ImpactRow& row) noexcept { return std::isnan(row.t_end) && std::isnan(row.t_release); }

}  // namespace pounding
