// Arguments of `pounding calibrate`, one per line: law, restitution, m1, m2, stiffness, velocity, exponent, then
// NAME=VALUE.

#include <pounding/input/collision.hpp>
#include "fuzz.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pounding;
  std::string_view text = fuzz::text_of(data, size);
  CollisionInput words;
  for (std::string* word :
       {&words.law, &words.restitution, &words.m1, &words.m2, &words.stiffness, &words.velocity, &words.exponent})
    *word = fuzz::next_line(text);
  while (!text.empty()) {
    const std::string_view line = fuzz::next_line(text);
    const std::size_t equals = std::min(line.find('='), line.size());
    words.parameters.emplace_back(line.substr(0, equals), line.substr(std::min(equals + 1, line.size())));
  }
  try {
    fuzz::refusing([&] {
      for (const CalibratedRow& row : calibrate(read_collision(words)))
        fuzz::require(!row.refused.empty() || row.impact.restitution <= 1 + 1e-6, "an impact gains no energy",
                      row.formula);
    });
  } catch (const std::invalid_argument& error) {
    fuzz::require_printable(error);
  }
  return 0;
}
