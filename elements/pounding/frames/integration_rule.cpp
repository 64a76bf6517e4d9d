#include <pounding/frames/integration_rule.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <pounding/base/root.hpp>
#include <pounding/core/refuse.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding {
namespace {

/// Legendre polynomials P_n and P_{n-1} at x in [-1, 1].
struct Legendre {
  double last = 1, before = 0;
};

Legendre legendre_polynomials(int degree, double x) {
  Legendre p;
  for (int k = 1; k <= degree; ++k) p = {((2 * k - 1) * x * p.last - (k - 1) * p.before) / k, p.last};
  return p;
}

/// All roots of a polynomial with distinct roots in (-1, 1), as fractions of the member.
template <class Polynomial>
void add_roots(std::vector<double>& locations, const Polynomial& polynomial) {
  constexpr int cells = 200;  // by equal angles, as the roots nearly are
  const auto at = [](int i) { return -std::cos(std::numbers::pi * (i + 0.5) / cells); };
  for (int i = 0; i + 1 < cells; ++i) {
    const double low = polynomial(at(i)), high = polynomial(at(i + 1));
    if (low * high < 0) locations.push_back(0.5 * (1 + find_root(polynomial, at(i), low, at(i + 1), high)));
  }
}

void require_points(const char* rule, int points) {
  if (points < 2 || points > 10)
    refuse(std::string(rule) + " has " + std::to_string(points) + " points, but must have 2 to 10");
}

/// Both hinges from the points of the one at the start, and the interior.
IntegrationRule hinged(const std::vector<IntegrationPoint>& hinge, std::size_t with_fibres, double reach, double start,
                       double end, HingeInterior interior) {
  laws::require_not_negative("hinge length", start);
  laws::require_not_negative("hinge length", end);
  const double between = 1 - reach * (start + end);
  if (between < 0)
    refuse("hinge lengths " + laws::number_text(start) + " and " + laws::number_text(end) +
           " of the member must sum to at most " + laws::number_text(1 / reach) + " for this rule");
  IntegrationRule rule;
  auto& inner = interior == HingeInterior::elastic ? rule.elastic : rule.points;
  const auto add = [](std::vector<IntegrationPoint>& points, double at, double weight) {
    if (weight > 0) points.push_back({at, weight});
  };
  for (std::size_t i = 0; i < hinge.size(); ++i)
    add(i < with_fibres ? rule.points : inner, start * hinge[i].at, start * hinge[i].weight);
  const double middle = 0.5 * (1 + reach * (start - end)), offset = 0.5 * between / std::numbers::sqrt3;
  add(inner, middle - offset, 0.5 * between);
  add(inner, middle + offset, 0.5 * between);
  for (std::size_t i = hinge.size(); i-- > 0;)
    add(i < with_fibres ? rule.points : inner, 1 - end * hinge[i].at, end * hinge[i].weight);
  return rule;
}

}  // namespace

void IntegrationRule::check() const {
  if (points.empty()) refuse("an integration rule needs at least one point with fibres");
  double sum = 0;
  for (const auto* all : {&points, &elastic})
    for (const auto& [at, weight] : *all) {
      if (!(at >= 0 && at <= 1)) laws::refuse("location of an integration point", at, "in [0, 1]");
      if (!std::isfinite(weight) || weight == 0) laws::refuse("weight of an integration point", weight, "not zero");
      sum += weight;
    }
  if (!(std::abs(sum - 1) < 1e-6)) laws::refuse("sum of the weights of an integration rule", sum, "1");
}

IntegrationRule fixed_locations(std::vector<double> locations) {
  const std::size_t n = locations.size();
  if (n < 1 || n > 20) refuse("an integration rule has " + std::to_string(n) + " points, but must have 1 to 20");
  std::ranges::sort(locations);
  const IntegrationRule gauss = n < 3 ? IntegrationRule{{{0.5, 1}}} : legendre(static_cast<int>((n + 1) / 2));
  IntegrationRule rule;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0 && locations[i] == locations[i - 1])
      laws::refuse("location of an integration point", locations[i], "given once");
    // Integral of the Lagrange polynomial of this location.
    double weight = 0;
    for (const auto& [at, part] : gauss.points) {
      double value = part;
      for (std::size_t j = 0; j < n; ++j)
        if (j != i) value *= (at - locations[j]) / (locations[i] - locations[j]);
      weight += value;
    }
    rule.points.push_back({locations[i], weight});
  }
  return rule;
}

IntegrationRule legendre(int points) {
  require_points("a Gauss-Legendre rule", points);
  std::vector<double> roots;
  add_roots(roots, [points](double x) { return legendre_polynomials(points, x).last; });
  IntegrationRule rule;
  for (const double at : roots) {
    const double x = 2 * at - 1, before = points * legendre_polynomials(points, x).before;
    rule.points.push_back({at, (1 - x * x) / (before * before)});
  }
  return rule;
}

IntegrationRule lobatto(int points) {
  require_points("a Gauss-Lobatto rule", points);
  std::vector<double> locations{0, 1};
  // (1 - x^2) P'_{n-1}, up to a factor.
  add_roots(locations, [points](double x) {
    const Legendre p = legendre_polynomials(points - 1, x);
    return p.before - x * p.last;
  });
  return fixed_locations(locations);
}

IntegrationRule radau(int points) {
  require_points("a Gauss-Radau rule", points);
  std::vector<double> locations{0};
  add_roots(locations, [points](double x) {
    const Legendre p = legendre_polynomials(points, x);
    return p.last + p.before;
  });
  return fixed_locations(locations);
}

IntegrationRule newton_cotes(int points) {
  require_points("a Newton-Cotes rule", points);
  std::vector<double> locations;
  for (int i = 0; i < points; ++i) locations.push_back(static_cast<double>(i) / (points - 1));
  return fixed_locations(locations);
}

IntegrationRule hinge_radau(double start, double end, HingeInterior interior) {
  return hinged({{0, 1}, {8.0 / 3, 3}}, 1, 4, start, end, interior);
}

IntegrationRule hinge_radau_two(double start, double end, HingeInterior interior) {
  return hinged({{0, 0.25}, {2.0 / 3, 0.75}}, 2, 1, start, end, interior);
}

IntegrationRule hinge_midpoint(double start, double end, HingeInterior interior) {
  return hinged({{0.5, 1}}, 1, 1, start, end, interior);
}

IntegrationRule hinge_endpoint(double start, double end, HingeInterior interior) {
  return hinged({{0, 1}}, 1, 1, start, end, interior);
}

}  // namespace pounding
