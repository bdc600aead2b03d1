// The kernels for AVX2: eight lanes. Compiled with -mavx2, so nothing else belongs in this file.
#include "server/collision/kernel_body.hpp"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace mechane::collision {

#ifdef __AVX2__
namespace {

struct Avx2Lanes : PortableLanes<8> {
  static F root(F x) { return _mm256_sqrt_ps(x); }
  static F select(I condition, F a, F b) { return _mm256_blendv_ps(b, a, reinterpret_cast<__m256>(condition)); }
  static F lesser(F a, F b) { return _mm256_min_ps(a, b); }
  static F greater(F a, F b) { return _mm256_max_ps(a, b); }
  template <int Scale>
  static I gather(const void* table, I index) {
    return reinterpret_cast<I>(
        _mm256_i32gather_epi32(static_cast<const int*>(table), reinterpret_cast<__m256i>(index), Scale));
  }
  static LaneMask mask_of(I condition) {
    return static_cast<LaneMask>(_mm256_movemask_ps(reinterpret_cast<__m256>(condition)));
  }
};

}  // namespace

const Kernels* avx2_kernels() noexcept {
  static constexpr Kernels kTable = KernelBody<Avx2Lanes>::table("avx2");
  return &kTable;
}
#else
const Kernels* avx2_kernels() noexcept {
  return nullptr;
}
#endif

}  // namespace mechane::collision
