#include "server/transport/sent_times.hpp"

#include <gtest/gtest.h>

namespace mechane::transport {
namespace {

using namespace std::chrono_literals;

/// Outputs 1 to `last`, one a millisecond.
void send(SentTimes& times, std::uint64_t last) {
  for (std::uint64_t i = 1; i <= last; ++i)
    times.note(i, TimePoint{1h} + i * 1ms);
}

TEST(SentTimes, TellHowLongAgoTheFirstUnseenOutputWasSent) {
  SentTimes times;
  send(times, 300);
  EXPECT_EQ(times.age_of(100, TimePoint{1h} + 300ms), Duration(199ms));
  EXPECT_EQ(times.age_of(299, TimePoint{1h} + 300ms), Duration(0ms));
}

TEST(SentTimes, OfASenderThatHasSeenAllOrNothingNothingIsKnown) {
  SentTimes times;
  EXPECT_EQ(times.age_of(0, TimePoint{2h}), Duration(0ms));
  send(times, 5);
  EXPECT_EQ(times.age_of(5, TimePoint{2h}), Duration(0ms)) << "a hand that comes back after a pause";
  EXPECT_EQ(times.age_of(0, TimePoint{2h}), Duration(0ms));
}

TEST(SentTimes, KnowWhatWasNeverSentAndWhatIsLongPast) {
  SentTimes times;
  send(times, 5000);
  EXPECT_EQ(times.age_of(5001, TimePoint{2h}), std::nullopt);
  EXPECT_EQ(times.age_of(7, TimePoint{2h}), Duration::max());
}

}  // namespace
}  // namespace mechane::transport
