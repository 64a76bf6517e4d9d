#pragma once
/// Vectors of four numbers (AVX, or two vectors of two elsewhere), and of eight (AVX-512) for large products. Results
/// are bitwise identical: each product and sum is rounded separately, because contraction is disabled.
///
/// Write a loop once, as a POUNDING_INLINE function of Four. Compile it for wide vectors through a POUNDING_WIDE
/// function that only calls it, and call that one if has_wide_vectors(). POUNDING_WIDEST and has_widest_vectors() are
/// the equivalents for Eight.

#if defined(__GNUC__) && defined(__x86_64__)
#define POUNDING_INLINE inline __attribute__((always_inline))
#define POUNDING_WIDE __attribute__((target("avx")))
#define POUNDING_WIDEST __attribute__((target("avx512f")))
#else
#define POUNDING_INLINE inline
#define POUNDING_WIDE
#define POUNDING_WIDEST
#endif

namespace pounding {

#ifdef __GNUC__
#define POUNDING_HAS_FOUR
/// Four numbers at any address.
using Four = double __attribute__((vector_size(32), aligned(8), may_alias));
/// Eight numbers at any address.
using Eight = double __attribute__((vector_size(64), aligned(8), may_alias));
#endif

/// True if this processor supports POUNDING_WIDE functions; true if it supports POUNDING_WIDEST ones.
#if defined(__GNUC__) && defined(__x86_64__)
inline bool has_wide_vectors() {
  static const bool has = __builtin_cpu_supports("avx") != 0;
  return has;
}
inline bool has_widest_vectors() {
  static const bool has = __builtin_cpu_supports("avx512f") != 0;
  return has;
}
#else
inline bool has_wide_vectors() { return false; }
inline bool has_widest_vectors() { return false; }
#endif

}  // namespace pounding
