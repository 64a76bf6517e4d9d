#pragma once
/// Yielding parts by the name of their hysteretic law.

#include <map>
#include <string>
#include <vector>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/structures/one_or_each.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// A hysteretic law for the storeys of a structure, without its stiffness, which is that of the storey: `{.law =
/// "bouc_wen", .values = {{"yield_force", {1.6e6, 1.2e6}}, {"exponent", 1}}}`. SI units.
struct SpringOptions {
  std::string law;  ///< name of the law
  std::map<std::string, OneOrEach, std::less<>>
      values{};  ///< numeric parameters by name: one value for all storeys, or a list
  std::map<std::string, std::string, std::less<>> words{};  ///< keyword parameters, as in {"memory", "last"}

  /// Settings of the law in storey `storey`, numbered from 0; `stiffness` has one entry per storey [N/m]. Throws
  /// std::invalid_argument for a list of a different length, and if a stiffness is given.
  hysteresis::Settings of_storey(int storey, const std::vector<double>& stiffness) const;
};

/// Numbers and choices of a law with these settings except its stiffness, including defaults; parameters without a
/// value are omitted. The value of a choice is the index of its keyword in the table of the law. Throws like
/// make_spring().
std::vector<YieldingPart::Parameter> parameters_of(const hysteresis::Settings& settings);

/// Slope of force `direction` of an element, in addition to its stiffness, at a thousand yield deformations in this
/// direction [N/m], without a damper in parallel.
double slope_far_behind_yield(const Element& element, int direction = 0);

}  // namespace pounding
