#include <pounding/model/reduction.hpp>

#include <fmt/format.h>

namespace pounding {

std::string Reduction::text() const {
  switch (kind) {
    case Kind::none: return "none";
    case Kind::automatic: return "auto";
    case Kind::all_modes: return "all modes";
    case Kind::blocks: return fmt::format("{{links: {}, ground: {}}}", links, ground);
    case Kind::lowest: break;
  }
  return fmt::format("{{modes: {}}}", modes);
}

}  // namespace pounding
