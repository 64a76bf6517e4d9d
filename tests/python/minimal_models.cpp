// Writes a small model for each input key, as SECTION.KEY.yaml, and the records that they name: minimal_models FOLDER/

#include <fstream>
#include <string>

#include <fmt/format.h>

#include <pounding/input/keys/sections.hpp>
#include <pounding/laws/compiled.hpp>
#include "input/minimal_models.hpp"

using namespace pounding;

namespace {

void write(const std::string& folder, std::string_view section, std::string_view key, const std::string& model) {
  std::ofstream(fmt::format("{}{}.{}.yaml", folder, section, key)) << model;
}

}  // namespace

int main(int count, char** keys) {
  if (count != 2) return 2;
  const std::string folder = keys[1];
  test::write_records(folder);
  for (const keys::Section* section : keys::sections())
    for (const keys::Key& spec : section->keys)
      write(folder, section->name, spec.key, test::with_key(*section, spec, std::string(spec.example)));
  for (const laws::Entry& law : laws::catalogue())
    for (const keys::Key& spec : keys::parameters_of(law).keys)
      write(folder, law.name, spec.key, test::with_keys(keys::link, test::keys_of_law(law, spec)));
}
