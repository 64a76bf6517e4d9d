#pragma once
/// Sums by vectors of four numbers where the processor has them (AVX), by two vectors of two elsewhere. Both give the same bits:
/// products and sums are rounded one by one, AVX has no fused ones.
///
/// A loop is written once as a POUNDING_INLINE function of Four. A POUNDING_WIDE function that does nothing but call it is compiled
/// for wide vectors; it is to be called where has_wide_vectors().

#if defined(__GNUC__) && defined(__x86_64__)
#define POUNDING_INLINE inline __attribute__((always_inline))
#define POUNDING_WIDE __attribute__((target("avx")))
#else
#define POUNDING_INLINE inline
#define POUNDING_WIDE
#endif

namespace pounding {

#ifdef __GNUC__
#define POUNDING_HAS_FOUR
/// Four numbers, anywhere in memory.
using Four = double __attribute__((vector_size(32), aligned(8), may_alias));
#endif

/// Whether this processor runs POUNDING_WIDE functions.
inline bool has_wide_vectors() {
#if defined(__GNUC__) && defined(__x86_64__)
  static const bool has = __builtin_cpu_supports("avx") != 0;
  return has;
#else
  return false;
#endif
}

}  // namespace pounding
