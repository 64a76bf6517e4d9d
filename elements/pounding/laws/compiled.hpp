#pragma once
/// Instantiations of the laws, for sources that link Pounding::links, which contains the code: it is not compiled
/// again. all.hpp and free_impact.hpp provide the same functions without a library.

#include <pounding/laws/all.hpp>
#include <pounding/laws/free_impact.hpp>

namespace pounding::laws {

extern template struct Catalogue<Settings, Entry, AnyLaw>;
extern template std::vector<ResolvedValue> describe(const AnyLaw&, double);
extern template std::string_view formula_name(const AnyLaw&) noexcept;
extern template double damping_number(const AnyLaw&, double);
extern template double damping_coefficient(const AnyLaw&, double);
extern template FreeImpact free_impact(const AnyLaw&, double, double);
extern template FreeImpact integrated_free_impact(const AnyLaw&, double, double);

}  // namespace pounding::laws
