// A table of fixed size that keeps the deepest contacts.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

namespace mechane::haptics {

/// Fills a table of the caller's. While this object lives, nobody else may change the table.
template <class Item, std::size_t kSize>
class KeepDeepest {
 public:
  KeepDeepest(std::array<Item, kSize>& table, std::uint32_t& count) noexcept : table_(table), count_(count) {}

  /// In a full table, the item takes the place of the shallowest one (of the first of those), if it is deeper than that.
  void add(const Item& item) noexcept {
    if (count_ < kSize) {
      table_[count_++] = item;
      return;
    }
    const auto deeper = [this](std::uint16_t a, std::uint16_t b) {
      return table_[a].depth_m != table_[b].depth_m ? table_[a].depth_m > table_[b].depth_m : a > b;
    };
    if (!sorted_) {
      std::iota(shallowest_.begin(), shallowest_.end(), std::uint16_t{0});
      std::make_heap(shallowest_.begin(), shallowest_.end(), deeper);
      sorted_ = true;
    }
    if (!(table_[shallowest_.front()].depth_m < item.depth_m)) return;
    std::pop_heap(shallowest_.begin(), shallowest_.end(), deeper);
    table_[shallowest_.back()] = item;
    std::push_heap(shallowest_.begin(), shallowest_.end(), deeper);
  }

 private:
  static_assert(kSize <= 65'536);
  std::array<Item, kSize>& table_;
  std::uint32_t& count_;
  std::array<std::uint16_t, kSize> shallowest_;  // a heap of places in the table, made when it is full
  bool sorted_ = false;
};

}  // namespace mechane::haptics
