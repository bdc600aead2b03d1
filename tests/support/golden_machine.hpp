// Which machines give the bits that tests/golden accepted.
#pragma once

namespace mechane::test {

/// The mathematics library chooses its code by the processor; only those with FMA give the accepted bits.
inline bool gives_golden_bits() {
  return __builtin_cpu_supports("fma") != 0 && __builtin_cpu_supports("avx2") != 0;
}

}  // namespace mechane::test
