// Prints a dictionary for libFuzzer: the words of the input, of the laws and of the units.

#include <cstdio>
#include <set>
#include <string>

#include <pounding/core/unit_names.hpp>
#include <pounding/input/words/sections.hpp>
#include <pounding/laws/compiled.hpp>

int main() {
  using namespace pounding;
  std::set<std::string> all = {": ",  "- ", "{", "}", "[",     "]",      "&a ", "*a", "\\x0a  ",
                               "---", "#",  "|", ">", "1e308", "1e-308", "-1",  "nan"};
  const auto add = [&](std::string_view text) {
    std::string word;
    for (const char c : text) {
      if (c == '"' || c == '\\') word += '\\';
      word += c;
    }
    if (!word.empty() && word.size() < 60) all.insert(word);
  };
  const auto add_section = [&](const words::Section& section) {
    for (const words::Word& word : section.words) {
      add(word.key);
      add(word.example);
      for (const std::string_view choice : word.choices) add(choice);
      for (const std::string_view instead : word.instead) add(instead);
      for (const std::string_view unit : unit_names(word.dimension)) add(unit);
    }
  };
  for (const words::Section* section : words::sections()) add_section(*section);
  for (const laws::Entry& law : laws::catalogue()) {
    add(law.name);
    for (const laws::Formula& formula : law.formulas) add(formula.name);
    add_section(words::parameters_of(law));
  }
  for (const std::string& word : all) std::printf("\"%s\"\n", word.c_str());
}
