#pragma once
/// Suggestions for mistyped names, shared by inputs, programs, C and Python.

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/base/excerpt.hpp>

namespace pounding {

/// Normalises a letter for comparison: names that differ only in case or separator (`-`, blank, `_`) are equal.
constexpr char folded(char c) noexcept {
  if (c == '-' || c == ' ') return '_';
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// True if two names are equal after normalisation.
constexpr bool is_same_name(std::string_view a, std::string_view b) noexcept {
  return std::ranges::equal(a, b, {}, folded, folded);
}

/// Edit distance with transpositions: number of insertions, deletions, replacements and swaps of neighbouring letters.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = folded(a[i - 1]) == folded(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && folded(a[i - 1]) == folded(b[j - 2]) && folded(a[i - 2]) == folded(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

/// A term used by other programs, papers and languages, and its name here.
struct Synonym {
  std::string_view word, name;
};

/// Contact materials are those of OpenSees; `gap` is the contact element of many structural programs.
inline constexpr std::array synonyms{Synonym{"ImpactMaterial", "bilinear_hertz"},
                                     Synonym{"Hertzdamp", "hertz_damped"},
                                     Synonym{"JankowskiImpact", "jankowski"},
                                     Synonym{"ViscoelasticGap", "kelvin_voigt"},
                                     Synonym{"ElasticPPGap", "linear_spring"},
                                     Synonym{"gap", "linear_spring"},
                                     Synonym{"kelvin", "kelvin_voigt"},
                                     Synonym{"linear_viscoelastic", "kelvin_voigt"},
                                     Synonym{"linear", "linear_spring"},
                                     Synonym{"newton", "stereomechanical"},
                                     Synonym{"cor", "restitution"},
                                     Synonym{"e", "restitution"},
                                     Synonym{"cr", "restitution"},
                                     Synonym{"coefficient_of_restitution", "restitution"},
                                     Synonym{"k", "stiffness"},
                                     Synonym{"mu", "friction"},
                                     Synonym{"n", "exponent"},
                                     Synonym{"m", "mass"},
                                     Synonym{"T", "period"},
                                     Synonym{"zeta", "damping"},
                                     Synonym{"xi", "damping"},
                                     Synonym{"rho", "density"},
                                     Synonym{"nu", "poisson"},
                                     Synonym{"young", "E"},
                                     Synonym{"percent", "%"},
                                     Synonym{"pct", "%"},
                                     Synonym{"meter", "m"},
                                     Synonym{"meters", "m"},
                                     Synonym{"metre", "m"},
                                     Synonym{"metres", "m"},
                                     Synonym{"millimetre", "mm"},
                                     Synonym{"millimetres", "mm"},
                                     Synonym{"inch", "in"},
                                     Synonym{"inches", "in"},
                                     Synonym{"feet", "ft"},
                                     Synonym{"sec", "s"},
                                     Synonym{"second", "s"},
                                     Synonym{"seconds", "s"},
                                     Synonym{"ton", "t"},
                                     Synonym{"tons", "t"},
                                     Synonym{"tonne", "t"},
                                     Synonym{"tonnes", "t"},
                                     Synonym{"newton", "N"}};

/// Maximum length of names that are compared by edit distance.
inline constexpr std::size_t longest_name_compared = 64;

/// The allowed name for which `read` is another term, otherwise the nearest by edit distance; empty if none is near.
inline std::string_view nearest_name(std::string_view read, std::span<const std::string_view> allowed) {
  if (read.size() > longest_name_compared) return {};
  if (std::find(allowed.begin(), allowed.end(), read) == allowed.end())
    for (const Synonym& other : synonyms)
      if (is_same_name(read, other.word) && std::find(allowed.begin(), allowed.end(), other.name) != allowed.end())
        return other.name;
  // One error per three letters counts as a typing mistake; more is a different name.
  std::size_t nearest_distance = std::max<std::size_t>(1, read.size() / 3) + 1;
  std::string_view nearest;
  for (const std::string_view name : allowed) {
    // The difference in length is a lower bound on the distance.
    const std::size_t longer = std::max(read.size(), name.size()) - std::min(read.size(), name.size());
    if (name.size() > longest_name_compared || longer >= nearest_distance) continue;
    const std::size_t distance = edit_distance(read, name);
    if (distance < nearest_distance && distance < std::max<std::size_t>(1, std::min(read.size(), name.size()))) {
      nearest_distance = distance;
      nearest = name;
    }
  }
  return nearest;
}

/// ` Did you mean "hertz_damped"?` if there is a near name; otherwise ` Allowed: a, b, c.`; empty if no names are
/// allowed.
inline std::string suggestion(std::string_view read, std::span<const std::string_view> allowed) {
  if (const std::string_view name = nearest_name(read, allowed); !name.empty())
    return " Did you mean \"" + excerpt(name) + "\"?";
  if (allowed.empty()) return {};
  std::string text = " Allowed: ";
  for (std::size_t i = 0; i < allowed.size(); ++i) text += (i == 0 ? "" : ", ") + excerpt(allowed[i]);
  return text + ".";
}

}  // namespace pounding
