#pragma once
/// The items of the paper that are recomputed, one file each. PETSc must be initialized (petsc::Environment).

#include <span>
#include <string_view>

#include "reproduce/report.hpp"

namespace pounding::reproduce {

namespace sdof {
Item make();
}  // namespace sdof
namespace force_laws {
Item make();
}  // namespace force_laws
namespace table2 {
Item make();
}  // namespace table2
namespace section5 {
Item make();
}  // namespace section5
namespace cyclic {
Item make();
}  // namespace cyclic
namespace section7 {
Item make();
}  // namespace section7
namespace beyond {
Item make();
}  // namespace beyond

struct ItemMaker {
  std::string_view name, title;
  Item (*make)();
};
/// All items, in the order of the paper.
std::span<const ItemMaker> item_makers();
/// The item of this name; throws InputError with the nearest known name.
const ItemMaker& item_maker(std::string_view name);

}  // namespace pounding::reproduce
