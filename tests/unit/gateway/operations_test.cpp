// What operators order: stored, read again, ended in time; and waking a machine.
#include "client-sdk/gateway/operations/operations.hpp"

#include <array>
#include <fstream>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "client-sdk/gateway/operations/wake_on_lan.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::gateway {
namespace {

using test::is_error;

constexpr std::int64_t kNow = 1'800'000'000;

template <class T>
Error error_of(const Expected<T>& made) {
  return made ? Error{} : made.error();
}

OperationsState busy_state() {
  OperationsState state;
  state.next_id = 9;
  state.hours =
      *parse_hours(R"({"museum":{"week":{"monday":["10:00-18:00"]}},"wake":{"kiosk-1":"02:00:5e:10:00:01"}})");
  state.messages.push_back({3, {"kiosk-1"}, {{"el", "Γεια"}, {"en", "Hello"}}, kNow + 60});
  state.maintenance = {{"kiosk-1", std::nullopt}, {"kiosk-2", kNow + 5}};
  state.changes.push_back({4, "kiosk-1", "volume", "0.2", {{"wall", "0.8"}}, kNow + 5});
  return state;
}

TEST(OperationsFile, IsReadAsItWasWrittenAfterARestart) {
  const test::ScratchFolder folder;
  auto first = Operations::open(folder.path());
  ASSERT_TRUE(first);
  EXPECT_EQ(first->state(), OperationsState{});
  ASSERT_TRUE(first->change(busy_state()));
  const auto again = Operations::open(folder.path());
  ASSERT_TRUE(again) << again.error().to_string();
  EXPECT_EQ(again->state(), busy_state());
}

TEST(OperationsFile, WhatIsDamagedIsNotTakenForNone) {
  const test::ScratchFolder folder;
  std::ofstream(folder.path() / "operations.json")
      << R"({"nextId":1,"hours":{},"messages":[3],"changes":[],"maintenance":{}})";
  EXPECT_THAT(error_of(Operations::open(folder.path())), is_error(ErrorCode::damaged, 0, {}));
  EXPECT_THAT(error_of(parse_operations("")), is_error(ErrorCode::damaged, 0, {}));
}

TEST(OperationsFile, AFailedWriteChangesNothing) {
  const test::ScratchFolder folder;
  auto store = Operations::open(folder.path());
  ASSERT_TRUE(store);
  std::filesystem::create_directory(folder.path() / "operations.json");  // cannot be replaced by a file
  EXPECT_FALSE(store->change(busy_state()));
  EXPECT_EQ(store->state(), OperationsState{});
}

TEST(KioskTargets, MaintenanceGoesBeforeHoursAndEndsInTime) {
  OperationsState state = busy_state();
  EXPECT_EQ(target_of(state, "kiosk-1", kNow).sign, "maintenance") << "until somebody ends it";
  EXPECT_EQ(target_of(state, "kiosk-2", kNow + 4).sign, "maintenance");
  state.hours = {};
  EXPECT_EQ(target_of(state, "kiosk-2", kNow + 5).sign, "none");
  EXPECT_EQ(target_of(state, "kiosk-3", kNow).sign, "none");
  const OperationsState later = without_ended(state, kNow + 60);
  EXPECT_EQ(later.maintenance.size(), 1U);
  EXPECT_TRUE(later.messages.empty());
  EXPECT_EQ(later.changes, state.changes) << "these must first be taken back";
}

TEST(KioskTargets, TheNewestMessageForAKioskCountsUntilItEnds) {
  OperationsState state = busy_state();
  state.hours = {};
  state.messages.push_back({5, {}, {{"en", "To all"}}, kNow + 10});
  EXPECT_EQ(target_of(state, "kiosk-1", kNow).message_en, "To all");
  EXPECT_EQ(target_of(state, "kiosk-1", kNow).message_el, "") << "never two messages at a time";
  EXPECT_EQ(target_of(state, "kiosk-1", kNow + 10).message_el, "Γεια");
  EXPECT_EQ(target_of(state, "kiosk-2", kNow + 10).message_en, "");
}

TEST(KioskTargets, VisitorsAreToldBeforeItCloses) {
  OperationsState state;
  HoursPlan plan;
  plan.week.fill({{0, 1440}});
  state.hours.museum = plan;
  EXPECT_EQ(target_of(state, "k", kNow), KioskTarget{});
  const std::int64_t midnight = next_at(1440, kNow);
  state.hours.museum->week.fill({{0, 1430}});
  EXPECT_NE(target_of(state, "k", midnight - 15 * 60).message_en, "");
  EXPECT_EQ(target_of(state, "k", midnight - 25 * 60).message_en, "");
  EXPECT_EQ(target_of(state, "k", midnight - 10 * 60).sign, "closed");
}

TEST(TimedChanges, ASecondOneKeepsWhatWasBeforeTheFirst) {
  OperationsState state = busy_state();
  ASSERT_TRUE(add_change(state, {0, "kiosk-1", "volume", "0.5", {{"wall", "0.2"}, {"web-1", "1"}}, kNow + 99}));
  ASSERT_EQ(state.changes.size(), 1U);
  EXPECT_EQ(state.changes[0].before, (std::map<std::string, std::string>{{"wall", "0.8"}, {"web-1", "1"}}));
  EXPECT_EQ(state.changes[0].until, kNow + 99);
  ASSERT_TRUE(add_change(state, {0, "kiosk-1", "language", "en", {}, kNow}));
  EXPECT_EQ(state.changes[1].id, 9U);
}

TEST(Orders, SayWhatIsWrong) {
  EXPECT_EQ(**parse_end(R"({"minutes":2})", kNow), kNow + 120);
  EXPECT_EQ(*parse_end("{}", kNow), std::nullopt);
  EXPECT_GT(**parse_end(R"({"until":"18:30"})", kNow), kNow);
  for (const char* wrong : {R"({"minutes":0})", R"({"minutes":"2"})", R"({"minutes":1e9})", R"({"until":"25:00"})",
                            R"({"until":7})", R"({"minutes":1,"until":"10:00"})", "7"})
    EXPECT_THAT(error_of(parse_end(wrong, kNow)), is_error(ErrorCode::invalid_value, 0, {})) << wrong;
  const auto message = [](const std::string& json) { return error_of(parse_visitor_message(json, kNow)); };
  EXPECT_THAT(message(R"({"texts":{"en":"x"}})"), is_error(ErrorCode::invalid_value, 0, {"end"}));
  EXPECT_THAT(message(R"({"texts":{"en":""},"minutes":1})"), is_error(ErrorCode::invalid_value, 0, {"empty"}));
  EXPECT_THAT(message(R"({"texts":{"fr":"x"},"minutes":1})"), is_error(ErrorCode::invalid_value, 0, {"el or en"}));
  EXPECT_THAT(message(R"({"texts":{"en":")" + std::string(241, 'x') + R"("},"minutes":1})"),
              is_error(ErrorCode::invalid_value, 0, {"240 bytes"}));
  EXPECT_THAT(message(R"({"texts":{"en":"a\nb"},"minutes":1})"), is_error(ErrorCode::invalid_value, 0, {"one line"}));
  EXPECT_THAT(message(R"({"texts":{"en":"x"},"kiosks":["../x"],"minutes":1})"),
              is_error(ErrorCode::invalid_value, 0, {}));
}

TEST(WakeOnLan, SendsTheMagicPacket) {
  EXPECT_EQ(parse_mac("02:00:5e:10:00"), std::nullopt);
  EXPECT_EQ(parse_mac("02:00:5e:10:00:0g"), std::nullopt);
  EXPECT_EQ(parse_mac("02 00 5e 10 00 01"), std::nullopt);
  EXPECT_EQ(mac_text(*parse_mac("02-00-5E-10-00-FF")), "02:00:5e:10:00:ff");
  const int listener = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof here;
  ASSERT_EQ(::bind(listener, reinterpret_cast<const sockaddr*>(&here), size), 0);
  ASSERT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&here), &size), 0);
  ASSERT_TRUE(wake(*parse_mac("02:00:5e:10:00:01"), "127.0.0.1:" + std::to_string(ntohs(here.sin_port))));
  std::array<std::uint8_t, 200> packet{};
  ASSERT_EQ(::recv(listener, packet.data(), packet.size(), 0), 102);
  ::close(listener);
  EXPECT_EQ(packet[5], 0xFF);
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_EQ((MacAddress{packet[6 + 6 * i], packet[7 + 6 * i], packet[8 + 6 * i], packet[9 + 6 * i],
                          packet[10 + 6 * i], packet[11 + 6 * i]}),
              *parse_mac("02:00:5e:10:00:01"));
  EXPECT_THAT(error_of(wake({}, "somewhere:9")), is_error(ErrorCode::invalid_value, 0, {"--wake-to"}));
}

}  // namespace
}  // namespace mechane::gateway
