#pragma once
/// Sums by vectors of four numbers where the processor has them (AVX), by two vectors of two elsewhere; large products
/// by vectors of eight (AVX-512). All give the same bits: products and sums are rounded one by one, as the compiler is
/// told not to fuse them.
///
/// A loop is written once as a POUNDING_INLINE function of Four. A POUNDING_WIDE function that does nothing but call it
/// is compiled for wide vectors; it is to be called where has_wide_vectors(). POUNDING_WIDEST and has_widest_vectors()
/// are those of Eight.

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
/// Four numbers, anywhere in memory.
using Four = double __attribute__((vector_size(32), aligned(8), may_alias));
/// Eight numbers, anywhere in memory.
using Eight = double __attribute__((vector_size(64), aligned(8), may_alias));
#endif

/// Whether this processor runs POUNDING_WIDE functions, and whether it runs POUNDING_WIDEST ones.
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
