#pragma once
/// Vectors of numbers for SIMD: one number per mode of the structures.

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

// Packs are passed only within a translation unit, where they are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace pounding::study {

/// Arrays over links, with a size known at compile time for few links; N is 0 for a size known only at run time.
template <int N, class T = double>
using Numbers = std::conditional_t<(N > 0), std::array<T, static_cast<std::size_t>(N > 0 ? N : 1)>, std::vector<T>>;

template <int N, class T = double>
Numbers<N, T> numbers(int count, const T& value = {}) {
  if constexpr (N > 0) {
    Numbers<N, T> all;
    all.fill(value);
    return all;
  } else {
    return Numbers<N, T>(static_cast<std::size_t>(count), value);
  }
}

/// W doubles for SIMD.
template <int W>
struct Pack;

/// Two doubles in one register.
template <>
struct Pack<2> {
  typedef double Vector __attribute__((vector_size(16)));
  Vector v{};

  double at(std::size_t k) const noexcept { return v[k]; }
  void set(std::size_t k, double x) noexcept { v[k] = x; }

  friend Pack operator+(const Pack& a, const Pack& b) noexcept { return {a.v + b.v}; }
  friend Pack operator-(const Pack& a, const Pack& b) noexcept { return {a.v - b.v}; }
  friend Pack operator*(const Pack& a, const Pack& b) noexcept { return {a.v * b.v}; }
  friend Pack operator*(double a, const Pack& b) noexcept { return {a * b.v}; }
  friend Pack operator*(const Pack& a, double b) noexcept { return {a.v * b}; }
  Pack& operator+=(const Pack& b) noexcept { return v += b.v, *this; }
  Pack& operator-=(const Pack& b) noexcept { return v -= b.v, *this; }
  Pack operator-() const noexcept { return {-v}; }
};

/// Four doubles in two registers. A single vector of four would be passed through memory on processors without
/// registers of that size.
template <>
struct Pack<4> {
  Pack<2> low, high;

  double at(std::size_t k) const noexcept { return k < 2 ? low.at(k) : high.at(k - 2); }
  void set(std::size_t k, double x) noexcept { k < 2 ? low.set(k, x) : high.set(k - 2, x); }

  friend Pack operator+(const Pack& a, const Pack& b) noexcept { return {a.low + b.low, a.high + b.high}; }
  friend Pack operator-(const Pack& a, const Pack& b) noexcept { return {a.low - b.low, a.high - b.high}; }
  friend Pack operator*(const Pack& a, const Pack& b) noexcept { return {a.low * b.low, a.high * b.high}; }
  friend Pack operator*(double a, const Pack& b) noexcept { return {a * b.low, a * b.high}; }
  friend Pack operator*(const Pack& a, double b) noexcept { return {a.low * b, a.high * b}; }
  Pack& operator+=(const Pack& b) noexcept { return low += b.low, high += b.high, *this; }
  Pack& operator-=(const Pack& b) noexcept { return low -= b.low, high -= b.high, *this; }
  Pack operator-() const noexcept { return {-low, -high}; }
};

inline double sum(const Pack<2>& x) noexcept { return x.v[0] + x.v[1]; }
inline double sum(const Pack<4>& x) noexcept { return sum(x.low + x.high); }
/// Absolute values.
inline Pack<2> magnitude(const Pack<2>& x) noexcept {
  typedef long long Bits __attribute__((vector_size(16)));
  constexpr Bits but_the_sign = {0x7fffffffffffffff, 0x7fffffffffffffff};
  return {Pack<2>::Vector(Bits(x.v) & but_the_sign)};
}
inline Pack<4> magnitude(const Pack<4>& x) noexcept { return {magnitude(x.low), magnitude(x.high)}; }
inline double smallest(const Pack<2>& x) noexcept { return std::min(x.v[0], x.v[1]); }
inline double smallest(const Pack<4>& x) noexcept { return std::min(smallest(x.low), smallest(x.high)); }

inline Pack<4> four(double a, double b, double c, double d) noexcept {
  return {Pack<2>{Pack<2>::Vector{a, b}}, Pack<2>{Pack<2>::Vector{c, d}}};
}

/// A pack of equal numbers.
template <class P>
constexpr P same(double x) noexcept;
template <>
constexpr Pack<2> same(double x) noexcept {
  return {Pack<2>::Vector{x, x}};
}
template <>
constexpr Pack<4> same(double x) noexcept {
  return {same<Pack<2>>(x), same<Pack<2>>(x)};
}

/// One number per mode, in packs filled up with zeros: at most M modes, or any number if M is 0.
template <int M>
class Modes {
 public:
  static constexpr int width = M == 1 || M == 2 ? 2 : 4;
  using Part = Pack<width>;

  Modes() = default;
  explicit Modes(int count) {
    if constexpr (M == 0) parts_.resize(static_cast<std::size_t>((count + width - 1) / width));
  }

  /// Number of packs.
  std::size_t parts() const noexcept { return parts_.size(); }
  Part& part(std::size_t i) noexcept { return parts_[i]; }
  const Part& part(std::size_t i) const noexcept { return parts_[i]; }
  /// Value of one mode.
  double& operator[](std::size_t j) noexcept { return reinterpret_cast<double*>(parts_.data())[j]; }
  double operator[](std::size_t j) const noexcept { return reinterpret_cast<const double*>(parts_.data())[j]; }

 private:
  Numbers<(M + width - 1) / width, Part> parts_{};
};

/// Dot product.
template <int M>
double dot(const Modes<M>& a, const Modes<M>& b) noexcept {
  typename Modes<M>::Part all = a.part(0) * b.part(0);
  for (std::size_t i = 1; i < a.parts(); ++i) all += a.part(i) * b.part(i);
  return sum(all);
}

}  // namespace pounding::study
