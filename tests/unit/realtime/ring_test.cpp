#include "server/realtime/ring.hpp"

#include <cstdint>
#include <cstring>
#include <deque>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/realtime/byte_ring.hpp"

namespace mechane::realtime {
namespace {

TEST(Ring, RefusesWhenFullAndGoesOnWhenDrained) {
  Ring<int> ring(4);
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(ring.push(i));
  EXPECT_FALSE(ring.push(99));
  int out = -1;
  ASSERT_TRUE(ring.pop(out));
  EXPECT_EQ(out, 0);
  EXPECT_TRUE(ring.push(4));
  for (int expected = 1; expected <= 4; ++expected) {
    ASSERT_TRUE(ring.pop(out));
    EXPECT_EQ(out, expected);
  }
  EXPECT_FALSE(ring.pop(out));
  EXPECT_EQ(ring.front(), nullptr);
}

TEST(RingDeathTest, AsksForAPowerOfTwo) {
  EXPECT_DEATH(Ring<int>(3), "broken invariant");
}

TEST(Ring, LosesAndRepeatsNothingBetweenThreads) {
  Ring<std::uint64_t> ring(64);
  constexpr std::uint64_t kCount = 1'000'000;
  std::uint64_t refused = 0;
  std::thread producer([&] {
    for (std::uint64_t n = 0; n < kCount;) {
      if (ring.push(n)) {
        ++n;
      } else {
        ++refused;
        std::this_thread::yield();
      }
    }
  });
  std::uint64_t expected = 0;
  bool in_order = true;
  while (expected < kCount && in_order) {
    std::uint64_t out = 0;
    if (ring.pop(out)) {
      in_order = out == expected++;
    } else {
      std::this_thread::yield();
    }
  }
  std::uint64_t rest = 0;
  while (!in_order && expected < kCount)
    expected += ring.pop(rest) ? 1 : 0;  // let the producer end before the test fails
  producer.join();
  EXPECT_TRUE(in_order) << "wrong number at " << expected;
  EXPECT_FALSE(ring.pop(rest));
}

std::vector<std::byte> bytes_of(std::size_t size, std::uint8_t seed) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::byte>(seed + 31 * i);
  return bytes;
}

// Against a plain queue: what comes out is what went in, in order; only a full ring refuses.
RC_GTEST_PROP(ByteRing, BehavesAsAQueue, (const std::vector<std::pair<bool, std::uint8_t>>& steps)) {
  ByteRing ring(1024);
  std::deque<std::vector<std::byte>> model;
  std::size_t used = 0;
  for (const auto& [push, size] : steps) {
    if (push) {
      const auto record = bytes_of(size, static_cast<std::uint8_t>(used));
      const bool taken = ring.push(record);
      const std::size_t need = 4 + (record.size() + 3) / 4 * 4;
      if (need > 256) RC_ASSERT(!taken);
      // One skip at the end of the buffer may lie between the records; it is smaller than the largest record.
      if (need <= 256 && used + need + 256 <= 1024) RC_ASSERT(taken);
      if (taken) {
        model.push_back(record);
        used += need;
      }
    } else {
      const auto front = ring.front();
      RC_ASSERT(front.found == !model.empty());
      if (!front.found) continue;
      RC_ASSERT(std::vector(front.record.begin(), front.record.end()) == model.front());
      ring.pop();
      used -= 4 + (model.front().size() + 3) / 4 * 4;
      model.pop_front();
    }
  }
}

TEST(ByteRing, LosesAndRepeatsNothingBetweenThreads) {
  ByteRing ring(4096);
  constexpr std::uint64_t kCount = 300'000;
  const auto size_of = [](std::uint64_t n) { return 8 + n * 7919 % 300; };
  std::thread producer([&] {
    std::vector<std::byte> record;
    for (std::uint64_t n = 0; n < kCount; ++n) {
      record.assign(size_of(n), static_cast<std::byte>(n));
      std::memcpy(record.data(), &n, sizeof n);
      while (!ring.push(record))
        std::this_thread::yield();
    }
  });
  std::uint64_t wrong = 0;
  for (std::uint64_t expected = 0; expected < kCount;) {
    const auto front = ring.front();
    if (!front.found) {
      std::this_thread::yield();
      continue;
    }
    std::uint64_t n = 0;
    std::memcpy(&n, front.record.data(), sizeof n);
    const bool right = n == expected && front.record.size() == size_of(n) &&
                       (front.record.size() == 8 || front.record.back() == static_cast<std::byte>(n));
    wrong += right ? 0 : 1;
    ring.pop();
    ++expected;
  }
  producer.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_FALSE(ring.front().found);
}

}  // namespace
}  // namespace mechane::realtime
