#include "server/transport/session_table.hpp"

#include <gtest/gtest.h>

namespace mechane::transport {
namespace {

using namespace std::chrono_literals;

Session hand(std::uint64_t id, std::uint32_t user = 0) {
  Session s;
  s.id = id;
  s.kiosk = "k";
  s.user = user;
  s.role = Role::hand;
  return s;
}
TimePoint at(Duration d) {
  return TimePoint{} + 1h + d;
}

TEST(SessionTable, TheFirstSessionKeepsTheHandWhileItSends) {
  SessionTable table;
  table.appeared(hand(1));
  table.appeared(hand(2));
  ASSERT_EQ(table.decide(at(0s)).size(), 1u);
  for (int ms = 0; ms < 5000; ms += 400) {
    table.heard(1, at(std::chrono::milliseconds(ms)));
    EXPECT_TRUE(table.decide(at(std::chrono::milliseconds(ms + 399))).empty());
    EXPECT_EQ(table.owner("k", 0)->id, 1u);
  }
}

TEST(SessionTable, ASilentOwnerGivesWayOnlyToOneThatWaitsAndGoesToTheEndOfTheLine) {
  SessionTable table;
  table.appeared(hand(1));
  (void)table.decide(at(0s));
  table.heard(1, at(1s));
  EXPECT_TRUE(table.decide(at(60s)).empty());
  table.appeared(hand(2));
  const auto changes = table.decide(at(60s));
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_FALSE(changes[0].granted);
  EXPECT_EQ(changes[0].session.id, 1u);
  EXPECT_TRUE(changes[1].granted);
  EXPECT_EQ(changes[1].session.id, 2u);
  EXPECT_TRUE(table.decide(at(60s + SessionTable::kFirstInputGrace - 1ms)).empty());
  (void)table.decide(at(60s + SessionTable::kFirstInputGrace));
  EXPECT_EQ(table.owner("k", 0)->id, 1u);
}

TEST(SessionTable, WhoLeavesIsFollowedByTheNextAndOtherHandsDoNotNotice) {
  SessionTable table;
  for (const Session& s : {hand(1), hand(2), hand(3, 1)})
    table.appeared(s);
  (void)table.decide(at(0s));
  EXPECT_TRUE(table.left(1));
  EXPECT_FALSE(table.left(1));
  EXPECT_EQ(table.decide(at(1ms)).size(), 2u);
  EXPECT_EQ(table.owner("k", 0)->id, 2u);
  EXPECT_EQ(table.owner("k", 1)->id, 3u);
  EXPECT_EQ(table.sessions_at("k"), 2u);
}

TEST(SessionTable, IsBounded) {
  SessionTable table;
  for (std::uint64_t i = 1; i <= SessionTable::kMaxSessions; ++i)
    EXPECT_TRUE(table.appeared(hand(i)));
  EXPECT_FALSE(table.appeared(hand(1'000'000)));
}

}  // namespace
}  // namespace mechane::transport
