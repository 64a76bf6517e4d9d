#include <pounding/input/isolator_input.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/input/spring_input.hpp>

namespace pounding {

namespace {

// Reads one coefficient, or those of slow and fast sliding with the rate.
void read_friction(const Input& friction, const std::optional<Input>& rate, IsolatorOptions& options) {
  if (!friction.is_list()) {
    if (rate)
      rate->fail_at_key("requires two coefficients of friction; type friction: [4 %, 8 %], for slow and fast sliding");
    options.law.values.emplace("friction", friction.as_quantity());
    return;
  }
  const std::vector<Input> both = friction.items();
  if (both.size() != 2)
    friction.fail(fmt::format("takes one coefficient, or [slow, fast]; a list of {} was read", both.size()));
  if (!rate) friction.fail("depends on the velocity, and the rate is missing; add rate: 60 s/m");
  options.velocity = IsolatorOptions::Velocity{.slow_friction = both[0].as_quantity(), .rate = rate->as_quantity()};
  options.law.values.emplace("friction", both[1].as_quantity());
}

}  // namespace

IsolatorOptions read_isolator_law(const Input& isolator) {
  if (!isolator.is_map())
    isolator.fail(
        "takes one law with its parameters; type isolator: {friction_pendulum: {radius: 2 m, friction: 6 %}}");
  isolator.only_keys();
  const hysteresis::Entry* entry = law_among_keys(isolator, "an isolator");
  if (!entry) isolator.fail("the law is missing; type isolator: {friction_pendulum: {radius: 2 m, friction: 6 %}}");
  const Input law = isolator.at(entry->name);
  law.only_keys();
  IsolatorOptions options{.law = {.law = std::string(entry->name)}, .capacity = isolator.find_quantity("capacity")};
  for (const hysteresis::ParameterInfo& parameter : entry->parameters) {
    if (parameter.need == hysteresis::Need::required && parameter.name != "weight") law.at(parameter.name);
    const auto value = law.find(parameter.name);
    if (!value) continue;
    if (law.knows("rate") && parameter.name == "friction")
      read_friction(*value, law.find("rate"), options);
    else
      options.law.values.emplace(parameter.name, value->as_quantity());
  }
  options.law.words = read_choices(law, *entry);
  try {
    make_isolator("", {Row(1)}, options, 1);
  } catch (const std::invalid_argument& error) {
    location_of(error.what(), law, *entry).fail(error.what());
  }
  return options;
}

}  // namespace pounding
