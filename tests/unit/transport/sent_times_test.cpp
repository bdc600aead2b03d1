#include "server/transport/sent_times.hpp"

#include <gtest/gtest.h>

namespace mechane::transport {
namespace {

using namespace std::chrono_literals;

constexpr TimePoint kStart{1h};

/// Outputs 1 to `last`, one a millisecond.
void send(SentTimes& times, std::uint64_t last) {
  for (std::uint64_t i = 1; i <= last; ++i)
    times.note(i, kStart + i * 1ms);
}

TEST(SentTimes, MeasureTheRoundTripWithoutTheTimeAtTheSender) {
  SentTimes times;
  send(times, 300);
  EXPECT_EQ(times.round_trip_of(100, 30ms, kStart + 300ms), Duration(170ms));
  EXPECT_EQ(times.round_trip_of(300, 5ms, kStart + 306ms), Duration(1ms));
}

TEST(SentTimes, WhatWasLostOnTheWayToTheSenderDoesNotCount) {
  SentTimes times;
  send(times, 800);
  EXPECT_EQ(times.round_trip_of(300, 499ms, kStart + 801ms), Duration(2ms));
}

TEST(SentTimes, AHandThatComesBackAfterASilenceIsNotLate) {
  SentTimes times;
  send(times, 5000);
  EXPECT_EQ(times.round_trip_of(7, 1h, kStart + 1h), Duration(0ms)) << "whatever was sent meanwhile, to whom ever";
  EXPECT_EQ(times.round_trip_of(5000, 1h, kStart + 1h + 6s), Duration(0ms)) << "and however the clocks drift";
}

TEST(SentTimes, OfASenderWithoutAnOutputNothingIsKnown) {
  SentTimes times;
  EXPECT_EQ(times.round_trip_of(0, 0ms, TimePoint{2h}), Duration(0ms));
  send(times, 5);
  EXPECT_EQ(times.round_trip_of(0, 0ms, TimePoint{2h}), Duration(0ms));
}

TEST(SentTimes, KnowWhatWasNeverSentAndWhatIsLongPast) {
  SentTimes times;
  send(times, 5000);
  EXPECT_EQ(times.round_trip_of(5001, 0ms, kStart + 5s), std::nullopt);
  EXPECT_GT(times.round_trip_of(7, 10ms, kStart + 5s), Duration(900ms)) << "the least that it can be";
}

}  // namespace
}  // namespace mechane::transport
