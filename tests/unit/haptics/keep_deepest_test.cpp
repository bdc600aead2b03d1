#include "server/haptics/keep_deepest.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::haptics {
namespace {

struct Item {
  int depth_m = 0;
  int index = 0;
  bool operator==(const Item&) const = default;
};

RC_GTEST_PROP(KeepDeepest, KeepsWhatASearchOfTheWholeTableWould, ()) {
  std::array<Item, 5> table{}, expected{};
  std::uint32_t count = 0, expected_count = 0;
  KeepDeepest keep(table, count);
  int index = 0;
  for (const int depth : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 9))) {
    const Item item{depth, index++};
    keep.add(item);
    if (expected_count < expected.size()) {
      expected[expected_count++] = item;
      continue;
    }
    const auto shallowest =
        std::ranges::min_element(expected, [](const Item& a, const Item& b) { return a.depth_m < b.depth_m; });
    if (shallowest->depth_m < depth) *shallowest = item;
  }
  RC_ASSERT(count == expected_count);
  RC_ASSERT(table == expected);
}

/// As where each touch adds what it has, with a table of its own.
TEST(KeepDeepest, KnowsWhatIsInTheTableAlready) {
  std::array<Item, 3> table{};
  std::uint32_t count = 0;
  int index = 0;
  for (const int depth : {4, 2, 7, 5, 1, 6})
    KeepDeepest(table, count).add({depth, index++});
  std::ranges::sort(table, {}, &Item::depth_m);
  EXPECT_EQ(table, (std::array<Item, 3>{Item{5, 3}, Item{6, 5}, Item{7, 2}}));
}

TEST(KeepDeepest, AHigherRankStaysWhateverItsDepth) {
  std::array<Item, 3> table{};
  std::uint32_t count = 0;
  KeepDeepest keep(table, count);
  keep.add({1, 0}, 101);
  for (int index = 1; index < 6; ++index)
    keep.add({10 + index, index});
  EXPECT_EQ(table[0], (Item{1, 0}));
  EXPECT_EQ(table[1].depth_m + table[2].depth_m, 14 + 15);
}

}  // namespace
}  // namespace mechane::haptics
