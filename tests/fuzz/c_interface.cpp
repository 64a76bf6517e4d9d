// The C interface. One token per line: law, formula, then NAME VALUE, each a parameter of the law; after an empty line
// numbers: successive pairs of penetration and rate.

#include <cstdlib>
#include <string>
#include <vector>

#include <pounding.h>
#include "fuzz.hpp"

namespace {

using pounding::fuzz::next_line;
using pounding::fuzz::require;

void require_status(int status) {
  if (status == PND_OK) return;
  require(status == PND_BAD_ARGUMENT || status == PND_FAILED, "the status is one of those of the interface");
  const std::string_view text = pnd_error_text();
  require(!text.empty() && text.size() < 512 && text == pounding::message_text(text),
          "an error has a text that can be printed", text);
}

void describe(const char* name) {
  std::size_t law = 0;
  const int found = pnd_find_law(name, &law);
  require_status(found);
  if (found != PND_OK) law = std::string_view(name).size();
  pnd_law_info info;
  require_status(pnd_describe_law(law, &info));
  for (std::size_t i = 0; i < 12; ++i) {
    pnd_parameter_info parameter;
    pnd_formula_info formula;
    require_status(pnd_describe_parameter(law, i, &parameter));
    require_status(pnd_describe_formula(law, i, &formula));
  }
}

void move(const pnd_law* law, std::string_view numbers) {
  pnd_contact contact = {};
  const std::string text(numbers);
  const char* at = text.c_str();
  for (int i = 0; i < 100; ++i) {
    char* end = nullptr;
    const double penetration = std::strtod(at, &end);
    if (end == at) break;
    const double rate = std::strtod(end, &end);
    at = end;
    pnd_response response;
    require_status(pnd_respond(law, &contact, penetration, rate, &response));
    switch (i % 8) {
      case 3: require_status(pnd_touch(law, rate, &contact)); break;
      case 6: require_status(pnd_separate(law, penetration, &contact)); break;
      default: require_status(pnd_accept(law, penetration, rate, &contact));
    }
    if (i == 0) {
      pnd_free_impact impact;
      require_status(pnd_collide(law, penetration, rate, &impact));
    }
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text = pounding::fuzz::text_of(data, size);
  const std::string name(next_line(text)), formula(next_line(text));
  describe(name.c_str());

  std::vector<std::string> names;
  std::vector<pnd_value> values;
  for (std::string_view line = next_line(text); !line.empty(); line = next_line(text)) names.emplace_back(line);
  for (std::string& each : names) {
    const std::size_t blank = each.find(' ');
    const double value = blank == each.npos ? 0 : std::strtod(each.c_str() + blank, nullptr);
    if (blank != each.npos) each[blank] = '\0';
    values.push_back({each.c_str(), value});
  }
  pnd_law* law = nullptr;
  const int made = pnd_create(name.c_str(), formula.c_str(), values.data(), values.size(), &law);
  require_status(made);
  require((made == PND_OK) == (law != nullptr), "a law is created exactly if the status is PND_OK");
  if (law) move(law, text);
  pnd_destroy(law);
  return 0;
}
