#pragma once
/// Parts that yield by one of the laws of hysteresis/, by its name.

#include <map>
#include <string>
#include <vector>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/structures/one_or_each.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// A law of yielding for the storeys of a structure, without its stiffness, which is that of the storey: `{.law =
/// "bouc_wen", .values =
/// {{"yield_force", {1.6e6, 1.2e6}}, {"exponent", 1}}}`. SI units.
struct SpringOptions {
  std::string law;  ///< name of the law
  std::map<std::string, OneOrEach, std::less<>>
      values{};  ///< its numbers by their names: one for all storeys, or a list
  std::map<std::string, std::string, std::less<>> words{};  ///< its choices, as in {"memory", "last"}

  /// Settings of the law in storey `storey`, counted from 0, of as many as `stiffness` has entries [N/m]. Throws
  /// std::invalid_argument for a list of another length, and for a stiffness that is given.
  hysteresis::Settings of_storey(int storey, const std::vector<double>& stiffness) const;
};

/// Every number and choice of a law with these settings but its stiffness, defaults included; numbers that nothing
/// stands for are left out. The value of a choice is the place of its word in the law's table, from 0. Throws as
/// make_spring() does.
std::vector<YieldingPart::Parameter> parameters_of(const hysteresis::Settings& settings);

/// Slope of Spring::evaluate() at a thousand yield deformations [N/m], without a damper beside the law.
double slope_far_behind_yield(const Spring& spring);

}  // namespace pounding
