// A table of fixed size that keeps the deepest contacts.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace mechane::haptics {

/// Adds `item`. In a full table it takes the place of the shallowest one, if it is deeper than that.
template <class Item, std::size_t kSize>
void keep_deepest(std::array<Item, kSize>& table, std::uint32_t& count, const Item& item) noexcept {
  if (count < kSize) {
    table[count++] = item;
    return;
  }
  const auto shallowest =
      std::min_element(table.begin(), table.end(), [](const Item& a, const Item& b) { return a.depth_m < b.depth_m; });
  if (shallowest->depth_m < item.depth_m) *shallowest = item;
}

}  // namespace mechane::haptics
