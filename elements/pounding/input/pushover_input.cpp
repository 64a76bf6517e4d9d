#include <pounding/input/pushover_input.hpp>

#include <cmath>
#include <filesystem>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/names.hpp>
#include <pounding/core/text.hpp>
#include <pounding/core/units.hpp>

namespace pounding {
namespace {

constexpr std::size_t longest_file = 10'000'000;

constexpr std::string_view blanks = " \t\r\n";

// Splits a text at a mark; parts may be empty.
std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(mark, begin), text.size());
    parts.push_back(trimmed(text.substr(begin, end - begin), blanks));
    begin = end + 1;
  }
  return parts;
}

// An option, with its name for messages.
class Option {
 public:
  Option(const PushoverInput& keys, std::string_view name) : name_(keys.mark + std::string(name)) {}
  [[noreturn]] void refuse(const std::string& text) const { throw InputError(name_ + ": " + text); }

 private:
  std::string name_;
};

const Structure& find_structure(const Model& model, const PushoverInput& keys) {
  const Option option(keys, "structure");
  std::vector<std::string> names, yielding;
  for (const Structure& s : model.structures) {
    names.push_back(s.name);
    if (!s.yielding.empty()) yielding.push_back(s.name);
    if (s.name == keys.structure) return s;
  }
  if (!keys.structure.empty()) option.refuse(unknown_name("structure", keys.structure, names));
  if (yielding.size() != 1)
    option.refuse(yielding.empty() ? "no structure of this model yields; add yield_force to an oscillator or a "
                                     "shear_building, or hinges to a frame"
                                   : fmt::format("{} structures of this model yield; name one of them, such as {}",
                                                 yielding.size(), yielding.front()));
  for (const Structure& s : model.structures)
    if (s.name == yielding.front()) return s;
  option.refuse("structure not found");
}

double read_target(const Option& option, std::string_view text, double height) {
  constexpr std::string_view roof = "roof";
  const std::string whole(text);
  if (text.ends_with(roof)) text = trimmed(text.substr(0, text.size() - roof.size()), blanks);
  double number = 0, target = 0;
  if (text.empty()) option.refuse(R"(no target displacement; type one such as "250 mm" or "2 % roof")");
  if (text.ends_with('%')) {
    if (!parse_number(trimmed(text.substr(0, text.size() - 1), blanks), number))
      option.refuse(
          fmt::format(R"("{}" is not a fraction of the height; type one such as "2 % roof")", excerpt(whole)));
    if (std::isnan(height))
      option.refuse(fmt::format(
          R"("{}" requires the height of the structure, which is unknown; add height to its storeys, or type a displacement such as "250 mm")",
          excerpt(whole)));
    target = number / 100 * height;
  } else if (parse_number(text, number)) {
    option.refuse(fmt::format(R"("{0}" has no unit; type "{0} mm", or a fraction of the height such as "2 % roof")",
                              excerpt(text)));
  } else {
    try {
      target = parse_quantity(text, dimension::length);
    } catch (const InputError& error) {
      option.refuse(fmt::format(R"({}; or a fraction of the height such as "2 % roof")", error.what()));
    }
  }
  if (target == 0)
    option.refuse(R"(the target displacement must not be zero; type one such as "250 mm" or "2 % roof")");
  if (std::abs(target) > height)
    option.refuse(fmt::format(R"("{}" exceeds the height of the roof, {}; type a smaller displacement)", excerpt(whole),
                              format_quantity(height, dimension::length)));
  return target;
}

std::vector<double> read_targets(const Structure& s, const PushoverInput& keys) {
  const double height = roof_height(s);
  std::vector<double> targets;
  if (!keys.cyclic.empty())
    for (const std::string_view text : split(keys.cyclic, ','))
      targets.push_back(read_target(Option(keys, "cyclic"), text, height));
  if (!keys.to.empty() || keys.cyclic.empty())
    targets.push_back(read_target(Option(keys, "to"), trimmed(keys.to, blanks), height));
  return targets;
}

std::vector<double> read_forces(const Option& option, const std::string& path, std::size_t floors) {
  std::vector<double> forces;
  const std::string text = read_text_file(path, "file of forces", longest_file);
  std::size_t number = 0;
  for (const std::string_view line : split(text, '\n')) {
    ++number;
    for (const std::string_view item : parts_between(line.substr(0, line.find('#')), " \t,;"))
      if (double force = 0; parse_number(item, force))
        forces.push_back(force);
      else
        option.refuse(
            fmt::format("{}:{}: \"{}\" is not a number; the file contains one force per floor, from the ground up",
                        path, number, excerpt(item)));
  }
  if (forces.size() != floors)
    option.refuse(fmt::format(
        "{} contains {} numbers, but the structure has {} floor{}; write one force per floor, from the ground up", path,
        forces.size(), floors, floors == 1 ? "" : "s"));
  return forces;
}

void read_load(const Structure& s, const PushoverInput& keys, PushoverOptions& options) {
  const Option option(keys, "load");
  constexpr std::string_view names[] = {"triangular", "uniform", "mode1"};
  for (const LoadPattern pattern : {LoadPattern::triangular, LoadPattern::uniform, LoadPattern::mode1})
    if (keys.load == name_of(pattern)) {
      options.pattern = pattern;
      return;
    }
  std::error_code unknown;
  if (!std::filesystem::exists(keys.load, unknown))
    option.refuse(
        fmt::format("\"{}\" is neither a pattern nor a file.{}", excerpt(keys.load), suggestion(keys.load, names)));
  options.pattern = LoadPattern::given;
  options.forces = read_forces(option, keys.load, s.floors.size());
}

}  // namespace

Pushover pushover(const Model& model, const PushoverInput& keys, const ModeSolver& modes) {
  const Structure& s = find_structure(model, keys);
  PushoverOptions options;
  if (keys.direction != "x" && keys.direction != "y")
    Option(keys, "direction").refuse(fmt::format("takes x or y; \"{}\" was read", excerpt(keys.direction)));
  options.direction = keys.direction == "y" ? 1 : 0;
  read_load(s, keys, options);
  options.targets = read_targets(s, keys);
  const std::string location = fmt::format("{}: structures.{}: ", model.source_file, s.name);
  try {
    return pushover(s, options, modes);
  } catch (const std::invalid_argument& error) {
    throw InputError(location + error.what());
  } catch (const SolverError& error) {
    throw SolverError(location + error.what());
  }
}

}  // namespace pounding
