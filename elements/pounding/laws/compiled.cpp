#include <pounding/laws/compiled.hpp>

namespace pounding::laws {

template struct Catalogue<Settings, Entry, AnyLaw>;
template std::vector<ResolvedValue> describe(const AnyLaw&, double);
template std::string_view formula_name(const AnyLaw&) noexcept;
template double damping_number(const AnyLaw&, double);
template double damping_coefficient(const AnyLaw&, double);
template FreeImpact free_impact(const AnyLaw&, double, double);
template FreeImpact integrated_free_impact(const AnyLaw&, double, double);

}  // namespace pounding::laws
