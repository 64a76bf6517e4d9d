#pragma once
/// The parts of the paper that are computed, one file each. PETSc must be running (petsc::Environment).

#include <span>
#include <string_view>

#include "reproduce/report.hpp"

namespace pounding::reproduce {

namespace sdof { Item make(); }  ///< section 3: Eqs. 1 and 2, the matrices and the runs
namespace force_laws { Item make(); }  ///< section 4: Eqs. 3-14, Table 1
namespace table2 { Item make(); }  ///< section 5: Eqs. 15-17, Table 2, Fig. 6
namespace section5 { Item make(); }  ///< section 5.1: Eq. 18, Table 3, Figs. 7 and 8
namespace cyclic { Item make(); }  ///< section 6: Eq. 19, Figs. 9-11
namespace section7 { Item make(); }  ///< section 7: Eqs. 20-38, Table 4, Figs. 12-14
namespace beyond { Item make(); }  ///< where the paper stops: exact calibration, two oscillators and two frames in an earthquake

struct ItemMaker {
  std::string_view name, title;
  Item (*make)();
};
/// All items, in the order of the paper.
std::span<const ItemMaker> item_makers();
/// The item of a name; throws InputError with the nearest known name.
const ItemMaker& item_maker(std::string_view name);

}  // namespace pounding::reproduce
