// The kernels for AVX2: eight lanes. Compiled with -mavx2 and -mfma, so nothing else belongs in this file.
#include "server/collision/kernel_body.hpp"

#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>
#endif

namespace mechane::collision {

#if defined(__AVX2__) && defined(__FMA__)
namespace {

/// For each set of lanes: these, one after the other.
constexpr auto kOrders = [] {
  std::array<std::array<int, 8>, 256> orders{};
  for (std::size_t set = 0; set < orders.size(); ++set) {
    std::size_t at = 0;
    for (int lane = 0; lane < 8; ++lane) {
      if ((set >> lane & 1U) != 0) orders[set][at++] = lane;
    }
  }
  return orders;
}();

struct Avx2Lanes : PortableLanes<8> {
  static F root(F x) { return _mm256_sqrt_ps(x); }
  static F select(I condition, F a, F b) { return _mm256_blendv_ps(b, a, reinterpret_cast<__m256>(condition)); }
  static F mad(F a, F b, F c) { return _mm256_fmadd_ps(a, b, c); }
  template <class Vector>
  static Vector pack(Vector from, LaneMask lanes) {
    __m256i order;
    __builtin_memcpy(&order, kOrders[lanes].data(), sizeof order);
    return reinterpret_cast<Vector>(_mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(from), order));
  }
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
