#pragma once
/// Keys that select a hysteretic law: for storeys (springs.cpp), hinges (hinges.cpp), devices (devices.cpp) and
/// isolators (isolators.cpp).

#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/table.hpp>
#include <pounding/input/keys/key.hpp>

namespace pounding::keys {

/// Keys and sections generated from the tables of laws; owns the texts that they refer to.
class YieldingKeys {
 public:
  /// One section per law, in the order of the laws.
  std::vector<const Section*> sections() const {
    std::vector<const Section*> all;
    for (const Section& section : sections_) all.push_back(&section);
    return all;
  }

 protected:
  /// Stores a text for the lifetime of the keys.
  std::string_view kept(std::string text) { return texts_.emplace_back(std::move(text)); }
  /// Stores keys for the lifetime of a section.
  std::vector<Key>& more_keys() { return keys_.emplace_back(); }
  const Section& add_section(const Section& section) { return sections_.emplace_back(section); }

  /// Capitalizes the first letter unless it is a symbol of one letter.
  static std::string capital(std::string_view text) {
    std::string all(text);
    if (!all.empty() && all[0] >= 'a' && all[0] <= 'z' && (all.size() < 2 || all[1] != ' '))
      all[0] = static_cast<char>(all[0] - 'a' + 'A');
    return all;
  }

  /// A number with its unit; forces in kN.
  static std::string shown(double value, std::string_view unit) {
    if (unit == "N") return fmt::format("{:g} kN", value / 1e3);
    return fmt::format("{:g}{}{}", value, unit.empty() ? "" : " ", unit);
  }

  static std::string shown_list(const hysteresis::ParameterInfo& info) {
    std::string all;
    for (const double value : info.typical_list) all += (all.empty() ? "[" : ", ") + shown(value, info.unit);
    return all + "]";
  }

  /// Key of a parameter of a law: the example is its typical value, the default its value in `made`.
  template <class Parameter, class L>
  Key key_of(const Parameter& parameter, const L& made) {
    const hysteresis::ParameterInfo& info = parameter.info;
    const bool is_required = info.need == hysteresis::Need::required;
    Key spec{info.name,
             quantity(parse_unit_dimension(info.unit)).in(info.unit),
             is_required ? required : optional,
             kept(fmt::format("{}.", capital(info.meaning))),
             kept(info.is_list() ? shown_list(info) : shown(info.typical, info.unit)),
             "0.2.0"};
    if (info.is_list()) spec.form = Form::one_or_list;
    if (!is_required)
      spec.otherwise = parameter.value ? kept(shown(made.*parameter.value, info.unit)) : std::string_view("none");
    return spec;
  }

  /// Map of a law on one line: "{stiffness: 50 MN/m, yield_force: 600 kN}".
  class Example {
   public:
    void add(const Key& spec) { text_ += fmt::format("{}{}: {}", text_.empty() ? "" : ", ", spec.key, spec.example); }
    std::string text() const { return fmt::format("{{{}}}", text_); }

   private:
    std::string text_;
  };

  /// Adds the choices of a law.
  template <class L>
  void add_choices(const L& made, std::vector<Key>& keys) {
    if constexpr (requires { L::choices; })
      for (const auto& each : L::choices)
        keys.push_back({each.info.name, choice(each.info.words), otherwise(each.info.words[each.get(made)]),
                        kept(fmt::format("{}.", capital(each.info.meaning))), each.info.words.back(), "0.2.0"});
  }

 private:
  std::deque<std::string> texts_;
  std::deque<std::vector<Key>> keys_;
  std::deque<Section> sections_;
};

/// Calls `visit` with each law of a variant, default-constructed.
template <class Any>
struct EachLaw;
template <class... L>
struct EachLaw<std::variant<L...>> {
  template <class Visit>
  static void visit(Visit&& visit) {
    (visit(L{}), ...);
  }
};

}  // namespace pounding::keys
