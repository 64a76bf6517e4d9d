#include <pounding/sections/softening.hpp>

#include <cmath>
#include <set>
#include <variant>

namespace pounding::sections {
namespace {

/// Largest stress on a monotonic path to a strain of 0.5 in one direction, and stress at its end.
Softening follow_monotonic(const materials::AnyMaterial& material, std::size_t index, double direction) {
  constexpr double first = 1e-5, ratio = 1.06;
  Softening found{index};
  std::visit(
      [&]<class M>(const M& law) {
        const auto reach = [&](double strain) {
          found.rest = law.respond(typename M::State{}, direction * strain).force;
          if (std::abs(found.rest) > std::abs(found.strength)) found.strength = found.rest;
        };
        // Concrete has its strength at this strain, steel its yield stress.
        if (std::isfinite(law.yield_deformation())) reach(law.yield_deformation());
        for (double strain = first; strain < 0.5; strain *= ratio) reach(strain);
      },
      material);
  return found;
}

bool falls(const Softening& path) { return std::abs(path.rest) < 0.999 * std::abs(path.strength); }

}  // namespace

std::optional<Softening> find_softening(const FibreSection& section) {
  std::optional<Softening> concrete;
  bool all_soften = true;
  std::set<std::size_t> used;
  for (const Fibre& fibre : section.fibres()) used.insert(fibre.material);
  for (const std::size_t index : used) {
    const auto path = [&](double direction) { return follow_monotonic(section.materials()[index], index, direction); };
    const Softening compression = path(-1), tension = path(1);
    const bool is_concrete = tension.strength < 0.5 * -compression.strength;
    if (!is_concrete && falls(tension)) return tension;
    if (!is_concrete && falls(compression)) return compression;
    if (!is_concrete) continue;
    all_soften = all_soften && falls(compression);
    if (!concrete && falls(compression)) concrete = compression;
  }
  return all_soften ? concrete : std::nullopt;
}

}  // namespace pounding::sections
