#include <pounding/recording/beyond_extremes.hpp>

#include <cmath>

#include <pounding/linear/wide_vectors.hpp>

namespace pounding {
namespace {

constexpr int knots = LinearQuantities::batch;

POUNDING_INLINE bool goes_beyond(const double* values, const double* rates, const double* third, double minimum,
                                 double largest) {
  int beyond = 0;  // branch-free, so that comparisons are vectorized
  for (int i = 0; i < knots; ++i) {
    const double move = third[i] * std::abs(rates[i]);
    beyond |= (values[i] + move > largest) | (values[i] - move < minimum);
  }
  return beyond != 0;
}

POUNDING_INLINE int find(const Reach& reach, const Extremes& extremes, int* found) {
  int count = 0;
  const double* values = reach.evaluated.data();
  for (int q = 0; q < static_cast<int>(extremes.size()); ++q, values += 2 * knots) {
    const double minimum = extremes.min[q], largest = extremes.max[q],
                 move = reach.third_begin * std::abs(reach.rates[q]);
    if (reach.values[q] + move > largest || reach.values[q] - move < minimum ||
        goes_beyond(values, values + knots, reach.third.data(), minimum, largest))
      found[count++] = q;
  }
  return count;
}

POUNDING_WIDE int find_by_wide_vectors(const Reach& reach, const Extremes& extremes, int* found) {
  return find(reach, extremes, found);
}

}  // namespace

void find_beyond(const Reach& reach, const Extremes& extremes, std::vector<int>& found) {
  found.resize(extremes.size());
  const int count =
      has_wide_vectors() ? find_by_wide_vectors(reach, extremes, found.data()) : find(reach, extremes, found.data());
  found.resize(static_cast<std::size_t>(count));
}

}  // namespace pounding
