// A quantity with its unit. An accepted value is finite, and survives a round trip through a report.

#include <cmath>

#include <pounding/core/units.hpp>
#include "fuzz.hpp"

namespace {

using namespace pounding;

constexpr Dimension dimensions[] = {
    dimension::none,      dimension::mass,         dimension::length,          dimension::time,
    dimension::frequency, dimension::acceleration, dimension::velocity,        dimension::force,
    dimension::damping,   dimension::stiffness,    dimension::hertz_stiffness, dimension::density};

void read_as(const Dimension& expected, std::string_view text) {
  fuzz::refusing([&] {
    const double value = parse_quantity(text, expected);
    fuzz::require(std::isfinite(value), "a quantity is finite", text);
    const std::string written = format_quantity(value, expected, 17);
    const double again = parse_quantity(written, expected);
    fuzz::require(std::abs(again - value) <= 1e-14 * std::abs(value), "a quantity is read as it is written", written);
  });
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  read_as(dimensions[size % std::size(dimensions)], text);
  fuzz::refusing(
      [&] { fuzz::require(!quantity_name(parse_unit(text).dimension).empty(), "a dimension has a name", text); });
  return 0;
}
