#pragma once
/// Laws created in C from the settings of C++.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include <pounding.h>
#include <pounding/laws/all.hpp>

namespace pounding::test {

struct Destroy {
  void operator()(pnd_law* law) const { pnd_destroy(law); }
};
using LawInC = std::unique_ptr<pnd_law, Destroy>;

/// Null if it is refused.
inline LawInC made_in_c(const laws::Settings& s) {
  std::vector<pnd_value> values;
  for (const auto& [name, value] : s.values) values.push_back({name.c_str(), value});
  if (s.restitution) values.push_back({"restitution", *s.restitution});
  if (s.impact_velocity) values.push_back({"impact_velocity", *s.impact_velocity});
  values.push_back({"reduced_mass", s.reduced_mass});
  pnd_law* law = nullptr;
  pnd_create(s.law.c_str(), s.formula.c_str(), values.data(), values.size(), &law);
  return LawInC(law);
}

/// Every law with each of its formulas, at a fixed design velocity if it needs one, and with each direct damping
/// parameter.
inline std::vector<laws::Settings> every_setting() {
  std::vector<laws::Settings> list;
  for (const laws::Entry& entry : laws::catalogue()) {
    const laws::Settings typical = laws::typical_settings(entry);
    list.push_back(typical);
    for (const laws::Formula& f : entry.formulas) {
      list.push_back(typical);
      list.back().formula = f.name;
    }
    if (entry.takes_impact_velocity) {
      list.push_back(typical);
      list.back().impact_velocity = 0.3;
    }
    for (const laws::ParameterInfo& p : entry.parameters) {
      if (p.need != laws::Need::damping) continue;
      list.push_back(typical);
      list.back().restitution.reset();
      list.back().values.emplace(p.name, p.typical);
    }
  }
  return list;
}

inline std::string text(const laws::Settings& s) {
  std::string line = s.law + " " + s.formula;
  if (s.impact_velocity) line += " impact_velocity";
  if (!s.restitution)
    for (const auto& [name, value] : s.values) line += " " + name;
  return line;
}

}  // namespace pounding::test
