// The kernels for AVX-512: sixteen lanes. Compiled with -mavx512f -mavx512dq, so nothing else belongs in this file.
#include "server/collision/kernel_body.hpp"

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#include <immintrin.h>
#endif

namespace mechane::collision {

#if defined(__AVX512F__) && defined(__AVX512DQ__)
namespace {

// The masked forms, with every lane set: for the others, g++ 12 warns of an uninitialised value in its own header.
struct Avx512Lanes : PortableLanes<16> {
  static constexpr __mmask16 kEvery = 0xffff;

  static F root(F x) { return _mm512_mask_sqrt_ps(x, kEvery, x); }
  static F select(I condition, F a, F b) {
    return _mm512_mask_blend_ps(_mm512_movepi32_mask(reinterpret_cast<__m512i>(condition)), b, a);
  }
  static F mad(F a, F b, F c) { return _mm512_fmadd_ps(a, b, c); }
  template <class Vector>
  static Vector pack(Vector from, LaneMask lanes) {
    const auto set = static_cast<__mmask16>(lanes);
    return reinterpret_cast<Vector>(_mm512_maskz_compress_epi32(set, reinterpret_cast<__m512i>(from)));
  }
  static F lesser(F a, F b) { return _mm512_mask_min_ps(a, kEvery, a, b); }
  static F greater(F a, F b) { return _mm512_mask_max_ps(a, kEvery, a, b); }
  template <int Scale>
  static I gather(const void* table, I index) {
    const auto lanes = reinterpret_cast<__m512i>(index);
    return reinterpret_cast<I>(_mm512_mask_i32gather_epi32(lanes, kEvery, lanes, table, Scale));
  }
  static LaneMask mask_of(I condition) { return _mm512_movepi32_mask(reinterpret_cast<__m512i>(condition)); }
};

}  // namespace

const Kernels* avx512_kernels() noexcept {
  static constexpr Kernels kTable = KernelBody<Avx512Lanes>::table("avx512");
  return &kTable;
}
#else
const Kernels* avx512_kernels() noexcept {
  return nullptr;
}
#endif

}  // namespace mechane::collision
