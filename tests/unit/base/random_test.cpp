// The numbers that fits and accepted pictures depend on: the published ones of each algorithm.
#include "server/base/random.hpp"

#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace mechane {
namespace {

TEST(Random, HasThePublishedNumbersOfSplitMix64) {
  Random random(1234567);
  for (const std::uint64_t expected : {6457827717110365317U, 3203168211198807973U, 9817491932198370423U,
                                       4593380528125082431U, 16408922859458223821U}) {
    EXPECT_EQ(random.next(), expected);
  }
}

TEST(Random, StaysWithinItsRanges) {
  Random random(3);
  double sum = 0;
  std::set<std::size_t> seen;
  for (int i = 0; i < 10'000; ++i) {
    const double u = random.unit();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    seen.insert(random.below(7));
  }
  EXPECT_NEAR(sum / 10'000, 0.5, 0.02);
  EXPECT_EQ(seen, (std::set<std::size_t>{0, 1, 2, 3, 4, 5, 6}));
}

// The first number without a name is the published hash of 0 by the same permutation (Jarzynski, Olano 2020): 129708002.
TEST(ShortRandom, HasTheNumbersThatPicturesWereAcceptedWith) {
  const auto top24 = [](ShortRandom& random) { return static_cast<std::uint32_t>(std::ldexp(random.unit(), 24)); };
  ShortRandom none(0);
  for (const std::uint32_t expected : {129708002U >> 8U, 2274998U, 3929824U, 5713780U})
    EXPECT_EQ(top24(none), expected);
  ShortRandom named(1, 2, 3);
  for (const std::uint32_t expected : {891203U, 6092070U, 2076898U, 13161919U})
    EXPECT_EQ(top24(named), expected);
}

TEST(ShortRandom, HasAnotherSequenceForEachName) {
  constexpr std::uint32_t kEach = 8;
  std::set<std::array<float, 3>> sequences;
  double sum = 0;
  for (std::uint32_t i = 0; i < kEach * kEach * kEach; ++i) {
    ShortRandom random(i % kEach, i / kEach % kEach, i / kEach / kEach);
    const float first = random.unit();
    ASSERT_GE(first, 0);
    ASSERT_LT(first, 1);
    sum += first;
    const float second = random.between(-2, 2);
    ASSERT_GE(second, -2);
    ASSERT_LT(second, 2);
    sequences.insert({first, second, random.unit()});
  }
  EXPECT_EQ(sequences.size(), kEach * kEach * kEach);
  EXPECT_NEAR(sum / (kEach * kEach * kEach), 0.5, 0.05);
}

}  // namespace
}  // namespace mechane
