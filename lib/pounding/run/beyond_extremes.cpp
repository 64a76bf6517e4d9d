#include <pounding/run/beyond_extremes.hpp>

#include <cmath>

#include <pounding/linear/wide_vectors.hpp>

namespace pounding {
namespace {

constexpr int knots = LinearQuantities::batch;

POUNDING_INLINE bool goes_beyond(const double* values, const double* rates, const double* third, double least,
                                 double largest) {
#ifdef POUNDING_HAS_FOUR
  const Four low{least, least, least, least}, high{largest, largest, largest, largest};
  Four lowest = low, highest = high;
  for (int i = 0; i < knots; i += 4) {
    const auto* const times = reinterpret_cast<const Four*>(third + i);
    const Four value = *reinterpret_cast<const Four*>(values + i),
               move = *times * *reinterpret_cast<const Four*>(rates + i);
    const Four there = value + move, back = value - move;
    highest = there > highest ? there : highest;
    highest = back > highest ? back : highest;
    lowest = there < lowest ? there : lowest;
    lowest = back < lowest ? back : lowest;
  }
  const auto beyond = (highest > high) | (lowest < low);
  return (beyond[0] | beyond[1] | beyond[2] | beyond[3]) != 0;
#else
  bool beyond = false;
  for (int i = 0; i < knots; ++i) {
    const double move = third[i] * std::abs(rates[i]);
    beyond = beyond || values[i] + move > largest || values[i] - move < least;
  }
  return beyond;
#endif
}

POUNDING_INLINE int find(const Reach& reach, const Extremes& extremes, int* found) {
  int count = 0;
  const double* values = reach.evaluated.data();
  for (int q = 0; q < static_cast<int>(extremes.size()); ++q, values += 2 * knots) {
    const double least = extremes.min[q], largest = extremes.max[q],
                 move = reach.third_begin * std::abs(reach.rates[q]);
    if (reach.values[q] + move > largest || reach.values[q] - move < least ||
        goes_beyond(values, values + knots, reach.third.data(), least, largest))
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
