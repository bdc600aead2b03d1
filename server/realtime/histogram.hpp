// LatencyHistogram: durations from 1 ns to over 10 s in fixed memory, each known to within 0.8 %.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "server/base/clock.hpp"

namespace mechane::realtime {

/// Log-linear buckets: below 128 ns one for each nanosecond, above that 64 for each doubling, so that a bucket is at most 1/64
/// of its value wide, and its middle is at most 1/128 off. One thread records and resets; any other may read at the same
/// time, without a lock, and sees each bucket as it was at some moment of the read (counters are relaxed atomics with a
/// single writer).
class LatencyHistogram {
 public:
  LatencyHistogram() = default;
  LatencyHistogram(const LatencyHistogram& other) noexcept { *this = other; }
  LatencyHistogram& operator=(const LatencyHistogram& other) noexcept {
    for (std::size_t i = 0; i < kBuckets; ++i)
      set(counts_[i], get(other.counts_[i]));
    set(max_ns_, get(other.max_ns_));
    return *this;
  }

  /// Adds one duration. Negative ones count as 0; those over 17 s fall into the last bucket, but max() is still exact.
  void record(Duration d) noexcept {
    const auto ns = static_cast<std::uint64_t>(std::max<std::int64_t>(d.count(), 0));
    add(counts_[bucket_of(ns)], 1);
    if (ns > get(max_ns_)) set(max_ns_, ns);
  }
  /// Adds the counts of `other`.
  void merge(const LatencyHistogram& other) noexcept {
    for (std::size_t i = 0; i < kBuckets; ++i)
      add(counts_[i], get(other.counts_[i]));
    set(max_ns_, std::max(get(max_ns_), get(other.max_ns_)));
  }
  /// What was counted since `earlier`, a copy of this histogram taken before. Its max() is that of the topmost bucket
  /// in use.
  [[nodiscard]] LatencyHistogram since(const LatencyHistogram& earlier) const noexcept {
    LatencyHistogram result;
    for (std::size_t i = 0; i < kBuckets; ++i) {
      const std::uint64_t count = get(counts_[i]) - get(earlier.counts_[i]);
      set(result.counts_[i], count);
      if (count > 0) set(result.max_ns_, std::min(middle_of(i), get(max_ns_)));
    }
    return result;
  }
  void reset() noexcept {
    for (auto& c : counts_)
      set(c, 0);
    set(max_ns_, 0);
  }

  [[nodiscard]] std::uint64_t count() const noexcept {
    std::uint64_t sum = 0;
    for (const auto& c : counts_)
      sum += get(c);
    return sum;
  }
  /// The longest, exactly.
  [[nodiscard]] Duration max() const noexcept { return Duration(static_cast<std::int64_t>(get(max_ns_))); }

  /// The duration that a share `p` (0 .. 1) of all does not exceed: the sample of rank ceil(p n), to within 0.8 %. 0
  /// when empty.
  [[nodiscard]] Duration quantile(double p) const noexcept {
    const std::uint64_t n = count();
    if (n == 0) return Duration{0};
    const double rank = std::ceil(std::clamp(p, 0.0, 1.0) * static_cast<double>(n));
    const std::uint64_t wanted = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(rank), 1, n);
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < kBuckets; ++i) {
      seen += get(counts_[i]);
      if (seen >= wanted) return Duration(static_cast<std::int64_t>(std::min(middle_of(i), get(max_ns_))));
    }
    return max();
  }

 private:
  static constexpr unsigned kSubBits = 6;  // 64 buckets a doubling
  static constexpr std::uint64_t kSub = 1u << kSubBits;
  static constexpr unsigned kTopBit = 33;  // the last doubling begins at 2^33 ns = 8.6 s
  static constexpr std::size_t kBuckets = (kTopBit - kSubBits + 2) * kSub;

  using Counter = std::atomic<std::uint64_t>;
  static std::uint64_t get(const Counter& c) noexcept { return c.load(std::memory_order_relaxed); }
  static void set(Counter& c, std::uint64_t v) noexcept { c.store(v, std::memory_order_relaxed); }
  static void add(Counter& c, std::uint64_t v) noexcept {
    set(c, get(c) + v);
  }  // one writer: no read-modify-write needed

  static std::size_t bucket_of(std::uint64_t ns) noexcept {
    if (ns < 2 * kSub) return ns;
    const unsigned top = static_cast<unsigned>(std::bit_width(ns)) - 1;
    if (top > kTopBit) return kBuckets - 1;
    const unsigned shift = top - kSubBits;
    return shift * kSub + (ns >> shift);
  }
  static std::uint64_t middle_of(std::size_t bucket) noexcept {
    if (bucket < 2 * kSub) return bucket;
    const unsigned shift = static_cast<unsigned>(bucket / kSub) - 1;
    const std::uint64_t low = (kSub + bucket % kSub) << shift;
    return low + (std::uint64_t{1} << shift) / 2;
  }

  std::array<Counter, kBuckets> counts_{};
  Counter max_ns_{0};
};

}  // namespace mechane::realtime
