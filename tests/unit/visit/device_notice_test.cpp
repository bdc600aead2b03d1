#include "client-sdk/visit/device_notice.hpp"

#include <set>

#include <gtest/gtest.h>

namespace mechane::visit {
namespace {

using client::DeviceReport;
using client::DeviceState;
using client::HandKind;

constexpr DeviceState kBad[] = {DeviceState::preparing,    DeviceState::let_go, DeviceState::not_ready,
                                DeviceState::uncalibrated, DeviceState::warm,   DeviceState::hot,
                                DeviceState::lost};

class DeviceNoticeTest : public testing::Test {
 protected:
  static TimePoint at(int ms) { return TimePoint(std::chrono::hours(3)) + std::chrono::milliseconds(ms); }
  void hear(int ms, DeviceState state) { notice_.hear({{.state = state}}, at(ms)); }
  [[nodiscard]] std::string text(int ms, const std::string& language = "en") const {
    const auto shown = notice_.at(at(ms), language);
    return shown ? shown->text : "";
  }
  /// What is said of these devices once it has lasted.
  [[nodiscard]] static std::string said(const std::vector<DeviceReport>& devices) {
    DeviceNotice notice;
    notice.hear(devices, at(0));
    const auto shown = notice.at(at(1000), "en");
    return shown ? shown->text : "";
  }

  DeviceNotice notice_;
};

TEST_F(DeviceNoticeTest, ComesAfterASecondAndGoesAtOnce) {
  for (int ms = 0; ms < 1000; ms += 20) {
    hear(ms, DeviceState::lost);
    ASSERT_EQ(text(ms), "") << ms;
  }
  hear(1000, DeviceState::lost);
  EXPECT_EQ(text(1000), "The handle is not connected");
  EXPECT_EQ(notice_.at(at(1000), "en")->more, "Please tell the staff.");
  hear(1020, DeviceState::ready);
  EXPECT_EQ(text(1020), "");
}

TEST_F(DeviceNoticeTest, AStateThatComesAndGoesIsNeverShown) {
  for (int ms = 0; ms < 10'000; ms += 20) {
    hear(ms, ms % 900 < 450 ? DeviceState::let_go : DeviceState::ready);
    ASSERT_EQ(text(ms), "") << ms;
  }
}

TEST_F(DeviceNoticeTest, AProgramThatEndedOrHasNoDeviceIsNotSpokenOf) {
  hear(0, DeviceState::lost);
  notice_.hear({}, at(2000));
  EXPECT_EQ(text(2000), "");
  hear(2020, DeviceState::none);
  EXPECT_EQ(text(9000), "");
}

TEST_F(DeviceNoticeTest, EachStateHasItsOwnWordsInBothLanguagesForHandleAndGlove) {
  std::set<std::string> texts;
  for (const DeviceState state : kBad) {
    for (const HandKind kind : {HandKind::one_point, HandKind::glove}) {
      notice_.hear({}, at(0));
      notice_.hear({{.state = state, .kind = kind}}, at(0));
      for (const char* language : {"el", "en"})
        texts.insert(text(1000, language));
    }
  }
  EXPECT_EQ(texts.size(), std::size(kBad) * 4);
  EXPECT_FALSE(texts.contains(""));
  EXPECT_EQ(text(1000, "fr"), text(1000, "en"));
}

TEST_F(DeviceNoticeTest, AGloveIsWornAndAHandleTaken) {
  using Sign = picture::OverlayNotice::Sign;
  hear(0, DeviceState::let_go);
  EXPECT_EQ(notice_.at(at(1000), "en")->sign, Sign::take);
  notice_.hear({{.state = DeviceState::let_go, .kind = HandKind::glove}}, at(2000));
  EXPECT_EQ(notice_.at(at(3000), "en")->sign, Sign::wear);
}

TEST_F(DeviceNoticeTest, OfSeveralDevicesTheMostSeriousStateIsTold) {
  EXPECT_EQ(said({{.state = DeviceState::let_go}, {.user = 1, .state = DeviceState::lost}}),
            "Handle 2 is not connected");
  EXPECT_EQ(said({{.state = DeviceState::hot}, {.user = 1, .state = DeviceState::warm}}), "Handle 1 is resting");
  EXPECT_EQ(said({{.state = DeviceState::ready}, {.user = 1, .state = DeviceState::hot}}), "Handle 2 is resting");
}

TEST_F(DeviceNoticeTest, OneOfTwoOfAKindIsCalledByItsNumber) {
  for (const DeviceState state : kBad) {
    if (state == DeviceState::let_go || state == DeviceState::not_ready) continue;  // not told beside one in use
    for (const HandKind kind : {HandKind::one_point, HandKind::glove}) {
      const DeviceReport bad{.user = 2, .state = state, .kind = kind};
      const DeviceReport good{.state = DeviceState::ready, .kind = kind};
      notice_.hear({good, bad}, at(0));
      for (const char* language : {"el", "en"}) {
        const auto shown = notice_.at(at(1000), language);
        ASSERT_TRUE(shown);
        EXPECT_NE(shown->text.find(" 3 "), std::string::npos) << shown->text;
      }
      const HandKind other = kind == HandKind::glove ? HandKind::one_point : HandKind::glove;
      for (const DeviceReport& beside : {DeviceReport{.state = DeviceState::ready, .kind = other},
                                         DeviceReport{.kind = kind}, DeviceReport{.state = state, .kind = kind}}) {
        notice_.hear({bad, beside}, at(0));
        EXPECT_EQ(text(1000).find('3'), std::string::npos) << text(1000);
      }
      notice_.hear({}, at(0));
    }
  }
  EXPECT_EQ(said({{.state = DeviceState::preparing}, {.user = 1, .state = DeviceState::let_go}}),
            "Handle 1 is being prepared");
}

TEST_F(DeviceNoticeTest, AHandleThatNobodyHoldsIsNotMissedWhileAnotherIsInUse) {
  for (const DeviceState free : {DeviceState::let_go, DeviceState::not_ready}) {
    EXPECT_NE(said({{.state = free}, {.user = 1, .state = free}}), "");
    EXPECT_EQ(said({{.state = free}, {.user = 1, .state = DeviceState::ready}}), "");
    EXPECT_EQ(said({{.state = free}, {.user = 1, .state = DeviceState::warm}}), "Handle 2 is warm");
  }
}

}  // namespace
}  // namespace mechane::visit
