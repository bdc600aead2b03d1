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

}  // namespace
}  // namespace mechane::haptics
