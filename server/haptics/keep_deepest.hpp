// A table of fixed size that keeps the deepest contacts, or those that rank first.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

namespace mechane::haptics {

/// Fills a table of the caller's; what is in it already ranks by its depth. While this object lives, nobody else may change the table.
template <class Item, std::size_t kSize>
class KeepDeepest {
 public:
  KeepDeepest(std::array<Item, kSize>& table, std::uint32_t& count) noexcept : table_(table), count_(count) {
    for (std::size_t i = 0; i < count_; ++i)
      ranks_[i] = table_[i].depth_m;
  }

  /// Ranks by depth.
  void add(const Item& item) noexcept { add(item, item.depth_m); }

  /// In a full table, the item takes the place of the one with the lowest rank (of the first of those), if its own is higher.
  void add(const Item& item, double rank) noexcept {
    if (count_ < kSize) {
      ranks_[count_] = rank;
      table_[count_++] = item;
      return;
    }
    const auto higher = [this](std::uint16_t a, std::uint16_t b) {
      return ranks_[a] != ranks_[b] ? ranks_[a] > ranks_[b] : a > b;
    };
    if (!sorted_) {
      std::iota(lowest_.begin(), lowest_.end(), std::uint16_t{0});
      std::make_heap(lowest_.begin(), lowest_.end(), higher);
      sorted_ = true;
    }
    if (!(ranks_[lowest_.front()] < rank)) return;
    std::pop_heap(lowest_.begin(), lowest_.end(), higher);
    ranks_[lowest_.back()] = rank;
    table_[lowest_.back()] = item;
    std::push_heap(lowest_.begin(), lowest_.end(), higher);
  }

 private:
  static_assert(kSize <= 65'536);
  std::array<Item, kSize>& table_;
  std::uint32_t& count_;
  std::array<double, kSize> ranks_;          // of the items of the table
  std::array<std::uint16_t, kSize> lowest_;  // a heap of places in the table, made when it is full
  bool sorted_ = false;
};

}  // namespace mechane::haptics
