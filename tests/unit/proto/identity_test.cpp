#include <gtest/gtest.h>

#include <mechane/proto/identity.hpp>

namespace mechane::proto {
namespace {

TEST(Identity, BothHalvesOfAnIdAreRandom) {
  const std::uint64_t first = random_id();
  const std::uint64_t second = random_id();
  EXPECT_NE(first >> 32, second >> 32);
  EXPECT_NE(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second));
  EXPECT_NE(first, 0U);
  EXPECT_FALSE(host_name().empty());
}

}  // namespace
}  // namespace mechane::proto
