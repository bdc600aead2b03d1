// Two small random generators that give the same numbers with every library and compiler, unlike the standard's distributions.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mechane {

/// SplitMix64 (Steele, Lea, Flood 2014): one long sequence from one seed. Fitted objects depend on its bits.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
  /// In [0, 1).
  [[nodiscard]] double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// In [0, n); n > 0. The bias of the remainder is below 2^-40 for any count of ours.
  [[nodiscard]] std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }

 private:
  std::uint64_t state_;
};

/// 32-bit PCG with its RXS-M-XS output (O'Neill 2014): a short sequence for each combination of up to three numbers, such as a particle and
/// its life; for drawing and sound. Accepted pictures depend on its bits, so SplitMix64 cannot replace it.
class ShortRandom {
 public:
  explicit ShortRandom(std::uint32_t first, std::uint32_t second = 0, std::uint32_t third = 0)
      : state_((first * 0x9E3779B9U) ^ (second * 0x85EBCA6BU) ^ (third * 0xC2B2AE35U)) {}

  /// In [0, 1).
  [[nodiscard]] float unit() {
    state_ = state_ * 747796405U + 2891336453U;
    const std::uint32_t word = ((state_ >> ((state_ >> 28U) + 4U)) ^ state_) * 277803737U;
    return static_cast<float>(((word >> 22U) ^ word) >> 8U) / static_cast<float>(1U << 24U);
  }
  [[nodiscard]] float between(float low, float high) { return low + (high - low) * unit(); }

 private:
  std::uint32_t state_;
};

}  // namespace mechane
