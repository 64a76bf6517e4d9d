// Writes a small model with each word of the input, as SECTION.KEY.yaml, and the records that they name: minimal_models
// FOLDER/

#include <fstream>
#include <string>

#include <fmt/format.h>

#include <pounding/input/words/sections.hpp>
#include <pounding/laws/compiled.hpp>
#include "input/minimal_models.hpp"

using namespace pounding;

namespace {

void write(const std::string& folder, std::string_view section, std::string_view key, const std::string& model) {
  std::ofstream(fmt::format("{}{}.{}.yaml", folder, section, key)) << model;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  const std::string folder = words[1];
  test::write_records(folder);
  for (const words::Section* section : words::sections())
    for (const words::Word& word : section->words)
      write(folder, section->name, word.key, test::with_word(*section, word, std::string(word.example)));
  for (const laws::Entry& law : laws::catalogue())
    for (const words::Word& word : words::parameters_of(law).words)
      write(folder, law.name, word.key, test::with_keys(words::link, test::keys_of_law(law, word)));
}
