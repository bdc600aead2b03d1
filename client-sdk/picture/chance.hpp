// Draws that are always the same: pictures must not depend on a library's generator.
#pragma once

#include <cstdint>

namespace mechane::picture {

/// A row of draws, 0..1 each, for whatever three numbers name (PCG's output permutation; O'Neill 2014).
class Chance {
 public:
  Chance(std::uint32_t first, std::uint32_t second, std::uint32_t third)
      : state_((first * 0x9E3779B9U) ^ (second * 0x85EBCA6BU) ^ (third * 0xC2B2AE35U)) {}
  float draw() {
    state_ = state_ * 747796405U + 2891336453U;
    const std::uint32_t word = ((state_ >> ((state_ >> 28U) + 4U)) ^ state_) * 277803737U;
    return static_cast<float>(((word >> 22U) ^ word) >> 8U) / static_cast<float>(1U << 24U);
  }

 private:
  std::uint32_t state_;
};

}  // namespace mechane::picture
