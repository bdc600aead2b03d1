#include "client-sdk/display/phone_code.hpp"

#include <gtest/gtest.h>

namespace mechane::display {
namespace {

constexpr TimePoint kTold{std::chrono::seconds(1000)};

client::DisplaySettings phone_settings(const std::string& token) {
  client::DisplaySettings settings;
  settings.phone_address = "https://museum:8480";
  settings.phone_code = token;
  return settings;
}

bool alike(const picture::OverlayCode& code, const std::string& text) {
  const auto other = qr_code(text);
  return other && code.side == other->side && code.dark == other->dark;
}

TEST(PhoneCode, LeadsToTheKiosksPage) {
  PhoneCode code("kiosk-1");
  EXPECT_FALSE(code.at(kTold, "en"));
  code.hear(phone_settings("a-token"), 1, kTold);
  const auto shown = code.at(kTold, "en");
  ASSERT_TRUE(shown);
  EXPECT_TRUE(alike(*shown, "https://museum:8480/kiosk/kiosk-1?token=a-token"));
  EXPECT_EQ(shown->text, "On your phone");
  EXPECT_NE(code.at(kTold, "el")->text, shown->text);
}

TEST(PhoneCode, GoesWhenItsGatewayTellsItNoMore) {
  PhoneCode code("kiosk-1");
  code.hear(phone_settings("a-token"), 1, kTold);
  const TimePoint later = kTold + PhoneCode::kStays;
  code.hear(phone_settings("a-token"), 1, later);  // other settings were changed
  EXPECT_TRUE(code.at(later, "en"));
  EXPECT_FALSE(code.at(later + std::chrono::seconds(1), "en"));
  code.hear(phone_settings("a-token"), 2, later);
  EXPECT_TRUE(code.at(later + std::chrono::seconds(1), "en"));
}

TEST(PhoneCode, FollowsTheTokenAndGoesWithIt) {
  PhoneCode code("kiosk-1");
  code.hear(phone_settings("first"), 1, kTold);
  code.hear(phone_settings("second"), 2, kTold);
  EXPECT_TRUE(alike(*code.at(kTold, "en"), "https://museum:8480/kiosk/kiosk-1?token=second"));
  code.hear(phone_settings(""), 3, kTold);
  EXPECT_FALSE(code.at(kTold, "en"));
  EXPECT_FALSE(qr_code(std::string(5000, 'a'))) << "no code is so large";
}

}  // namespace
}  // namespace mechane::display
