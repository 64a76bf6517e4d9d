// Prints a dictionary for libFuzzer: input keys, and names of laws and units.

#include <cstdio>
#include <set>
#include <string>

#include <pounding/core/unit_reader.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/laws/compiled.hpp>

int main() {
  using namespace pounding;
  std::set<std::string> all = {": ",  "- ", "{", "}", "[",     "]",      "&a ", "*a", "\\x0a  ",
                               "---", "#",  "|", ">", "1e308", "1e-308", "-1",  "nan"};
  const auto add = [&](std::string_view text) {
    std::string spec;
    for (const char c : text) {
      if (c == '"' || c == '\\') spec += '\\';
      spec += c;
    }
    if (!spec.empty() && spec.size() < 60) all.insert(spec);
  };
  const auto add_section = [&](const keys::Section& section) {
    for (const keys::Key& spec : section.keys) {
      add(spec.key);
      add(spec.example);
      for (const std::string_view choice : spec.choices) add(choice);
      for (const std::string_view instead : spec.instead) add(instead);
      for (const std::string_view unit : unit_names(spec.dimension)) add(unit);
    }
  };
  for (const keys::Section* section : keys::sections()) add_section(*section);
  for (const laws::Entry& law : laws::catalogue()) {
    add(law.name);
    for (const laws::Formula& formula : law.formulas) add(formula.name);
    add_section(keys::parameters_of(law));
  }
  for (const std::string& spec : all) std::printf("\"%s\"\n", spec.c_str());
}
