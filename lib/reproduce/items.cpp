#include "reproduce/items.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <pounding/core/error.hpp>

namespace pounding::reproduce {
namespace {

constexpr ItemMaker makers[] = {{"sdof", "the equivalent oscillator, Eqs. 1 and 2", &sdof::make},
                                {"laws", "every force law, Eqs. 3-14", &force_laws::make},
                                {"table2", "the proposed damping, Eqs. 15-17", &table2::make},
                                {"section5", "its accuracy, Eq. 18", &section5::make},
                                {"cyclic", "the cyclic process, Eq. 19", &cyclic::make},
                                {"section7", "the damping ratio, Eqs. 20-38", &section7::make},
                                {"beyond", "exact calibration and earthquakes", &beyond::make}};

}  // namespace

std::span<const ItemMaker> item_makers() { return makers; }

const ItemMaker& item_maker(std::string_view name) {
  if (const auto found = std::ranges::find(makers, name, &ItemMaker::name); found != std::end(makers)) return *found;
  std::vector<std::string_view> names;
  for (const ItemMaker& maker : makers) names.push_back(maker.name);
  throw InputError("--only " + std::string(name) + ": unknown item of the paper." + suggestion(name, names));
}

}  // namespace pounding::reproduce
