#include "server/realtime/mailbox.hpp"

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/allocation_guard.hpp"
#include "tests/support/sanitizers.hpp"

namespace mechane::realtime {
namespace {

TEST(Mailbox, GivesNothingBeforeTheFirstValue) {
  Mailbox<int> box;
  int out = 7;
  EXPECT_EQ(box.take(), nullptr);
  EXPECT_EQ(box.newest(), nullptr);
  EXPECT_FALSE(box.take_newest(out));
  EXPECT_EQ(out, 7);
}

TEST(Mailbox, GivesTheNewestOnceAndKeepsIt) {
  Mailbox<int> box;
  box.publish(1);
  box.publish(2);
  int out = 0;
  ASSERT_TRUE(box.take_newest(out));
  EXPECT_EQ(out, 2);
  EXPECT_FALSE(box.take_newest(out));
  ASSERT_NE(box.newest(), nullptr);
  EXPECT_EQ(*box.newest(), 2);
}

TEST(Mailbox, SlotsKeepTheirReservedBuffers) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  Mailbox<std::vector<int>> box([] {
    std::vector<int> v;
    v.reserve(100);
    return v;
  });
  const test::AllocationGuard guard;
  for (int round = 0; round < 10; ++round) {
    std::vector<int>& v = box.writable();
    v.assign(100, round);
    box.commit();
    const std::vector<int>* newest = box.take();
    if (newest == nullptr || newest->back() != round) FAIL() << "round " << round;
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

// A value that shows when it is torn: every word says the same number. Words are relaxed atomics, so that even a mailbox that is wrong
// has no data race in the sense of the language, and a thread sanitizer stays quiet about the deliberately wrong one below.
struct Wide {
  static constexpr std::size_t kWords = 64;
  std::atomic<std::uint64_t> words[kWords];

  Wide() { set(0); }
  Wide(const Wide& other) { *this = other; }
  Wide& operator=(const Wide& other) {
    for (std::size_t i = 0; i < kWords; ++i) {
      words[i].store(other.words[i].load(std::memory_order_relaxed), std::memory_order_relaxed);
    }
    return *this;
  }
  void set(std::uint64_t n) {
    for (auto& word : words)
      word.store(n, std::memory_order_relaxed);
  }
};

// The same as plain memory, for the right mailbox only: here a thread sanitizer would see a memory order that is too weak.
struct PlainWide {
  std::uint64_t words[Wide::kWords] = {};

  void set(std::uint64_t n) {
    for (auto& word : words)
      word = n;
  }
};

std::uint64_t read(const std::atomic<std::uint64_t>& word) {
  return word.load(std::memory_order_relaxed);
}
std::uint64_t read(std::uint64_t word) {
  return word;
}

struct Faults {
  std::uint64_t torn = 0;
  std::uint64_t backwards = 0;
  std::uint64_t taken = 0;
  std::uint64_t last = 0;
  std::uint64_t published = 0;

  template <class Value>
  void look_at(const Value& value) {
    const std::uint64_t first = read(value.words[0]);
    for (std::size_t i = 0; i < Wide::kWords; ++i) {
      // Every other look gives the producer time to write what must not change now: else two threads hardly meet on a busy machine.
      if (i == Wide::kWords / 2 && taken % 2 == 1) std::this_thread::yield();
      if (read(value.words[i]) != first) {
        ++torn;
        break;
      }
    }
    if (first < last) ++backwards;
    last = first;
    ++taken;
  }
};

// One thread publishes 1 .. count, and on until some have been taken; this one reads until it has seen the last, or `stop_early(faults)`.
template <class Value, class Box, class StopEarly>
Faults race(Box& box, std::uint64_t count, StopEarly stop_early) {
  constexpr std::uint64_t kFewestTaken = 4;
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> taken{0};
  std::uint64_t published = 0;
  std::thread producer([&] {
    Value value;
    while ((published < count || taken.load(std::memory_order_relaxed) < kFewestTaken) &&
           !done.load(std::memory_order_relaxed)) {
      value.set(++published);
      box.publish(value);
    }
    done.store(true, std::memory_order_release);
  });
  Faults faults;
  for (bool last_look = false; !last_look;) {
    last_look = done.load(std::memory_order_acquire);
    if (const Value* value = box.take(); value != nullptr) faults.look_at(*value);
    taken.store(faults.taken, std::memory_order_relaxed);
    if (stop_early(faults)) done.store(true, std::memory_order_relaxed);
  }
  producer.join();
  faults.published = published;
  return faults;
}

template <class Value>
void expect_right() {
  Mailbox<Value> box;
  constexpr std::uint64_t kCount = 200'000;
  const Faults faults = race<Value>(box, kCount, [](const Faults&) { return false; });
  EXPECT_EQ(faults.torn, 0u);
  EXPECT_EQ(faults.backwards, 0u);
  EXPECT_GE(faults.published, kCount);
  EXPECT_EQ(faults.last, faults.published) << "the last value published must arrive";
}

TEST(Mailbox, IsNeverTornAndNeverGoesBackwards) {
  expect_right<Wide>();
  expect_right<PlainWide>();
}

// The same with two slots: the producer may write the slot that the consumer reads. The race above must be able to see that.
class WrongMailbox {
 public:
  void publish(const Wide& value) {
    const std::uint32_t back = 1 - front_.load(std::memory_order_relaxed);
    slots_[back] = value;
    front_.store(back, std::memory_order_release);
    count_.fetch_add(1, std::memory_order_release);
  }
  const Wide* take() {
    const std::uint64_t count = count_.load(std::memory_order_acquire);
    if (count == seen_) return nullptr;
    seen_ = count;
    return &slots_[front_.load(std::memory_order_acquire)];
  }

 private:
  Wide slots_[2];
  std::atomic<std::uint32_t> front_{0};
  std::atomic<std::uint64_t> count_{0};
  std::uint64_t seen_ = 0;
};

TEST(Mailbox, TheRaceCatchesAWrongMailbox) {
  WrongMailbox box;
  const Faults faults = race<Wide>(box, 50'000'000, [](const Faults& f) { return f.torn + f.backwards > 0; });
  EXPECT_GT(faults.torn + faults.backwards, 0u);
}

}  // namespace
}  // namespace mechane::realtime
