#include "server/realtime/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::realtime {
namespace {

// Durations spread over all orders of magnitude, 0 ns to 15 s.
rc::Gen<std::vector<std::int64_t>> samples() {
  const auto one =
      rc::gen::map(rc::gen::pair(rc::gen::inRange(0, 34), rc::gen::arbitrary<std::uint64_t>()), [](const auto& p) {
        return std::min<std::int64_t>(static_cast<std::int64_t>(p.second % (std::uint64_t{1} << p.first)),
                                      15'000'000'000);
      });
  return rc::gen::nonEmpty(rc::gen::container<std::vector<std::int64_t>>(one));
}

LatencyHistogram of(const std::vector<std::int64_t>& ns) {
  LatencyHistogram h;
  for (const std::int64_t d : ns)
    h.record(Duration(d));
  return h;
}

RC_GTEST_PROP(LatencyHistogram, QuantilesAreThoseOfTheSortedSamplesWithin1Percent, ()) {
  auto ns = *samples();
  const LatencyHistogram h = of(ns);
  std::sort(ns.begin(), ns.end());
  RC_ASSERT(h.count() == ns.size());
  RC_ASSERT(h.max().count() == ns.back());
  for (const double p : {0.0, 0.01, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto n = static_cast<double>(ns.size());
    const auto rank = static_cast<std::size_t>(std::max(std::ceil(p * n), 1.0)) - 1;
    const auto exact = static_cast<double>(ns[rank]);
    const auto found = static_cast<double>(h.quantile(p).count());
    RC_ASSERT(std::abs(found - exact) <= 0.01 * exact);
  }
}

RC_GTEST_PROP(LatencyHistogram, MergingIsCountingBoth, ()) {
  auto a = *samples();
  const auto b = *samples();
  LatencyHistogram merged = of(a);
  merged.merge(of(b));
  const LatencyHistogram since = merged.since(of(a));
  a.insert(a.end(), b.begin(), b.end());
  const LatencyHistogram both = of(a);
  RC_ASSERT(merged.count() == both.count());
  RC_ASSERT(merged.max() == both.max());
  RC_ASSERT(since.count() == b.size());
  for (const double p : {0.1, 0.5, 0.99}) {
    RC_ASSERT(merged.quantile(p) == both.quantile(p));
    const auto exact = static_cast<double>(of(b).quantile(p).count());
    RC_ASSERT(std::abs(static_cast<double>(since.quantile(p).count()) - exact) <= 0.01 * exact);
  }
}

TEST(LatencyHistogram, IsEmptyAtFirstAndAfterReset) {
  LatencyHistogram h;
  EXPECT_EQ(h.quantile(0.5), Duration{0});
  h.record(Duration{-5});
  h.record(std::chrono::hours(1));
  EXPECT_EQ(h.count(), 2u);
  EXPECT_EQ(h.max(), std::chrono::hours(1));
  EXPECT_EQ(h.quantile(0.5), Duration{0});
  h.reset();
  EXPECT_EQ(h.count(), 0u);
  EXPECT_EQ(h.max(), Duration{0});
}

TEST(LatencyHistogram, CanBeReadWhileItIsWritten) {
  LatencyHistogram h;
  constexpr std::uint64_t kCount = 300'000;
  std::thread writer([&] {
    for (std::uint64_t i = 0; i < kCount; ++i)
      h.record(Duration(static_cast<std::int64_t>(i)));
  });
  std::uint64_t last = 0;
  bool rises = true;
  while (last < kCount && rises) {
    const LatencyHistogram copy = h;
    rises = copy.count() >= last;
    last = copy.count();
  }
  writer.join();
  EXPECT_TRUE(rises);
  EXPECT_EQ(h.count(), kCount);
}

}  // namespace
}  // namespace mechane::realtime
