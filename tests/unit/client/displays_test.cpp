#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client-sdk/client/parse.hpp"
#include "tests/support/error_like.hpp"
#include <mechane/client/displays.hpp>
#include <mechane/proto/convert.hpp>

namespace mechane::client {
namespace {

using test::is_error;

Error refusal_of(const std::string& name, const std::string& value) {
  DisplaySettings settings;
  const auto applied = client::apply(DisplaySetting{name, value}, settings);
  EXPECT_EQ(settings, DisplaySettings{}) << name << "=" << value << " changed something";
  EXPECT_FALSE(applied.has_value()) << name << "=" << value;
  return applied ? Error{} : applied.error();
}

TEST(DisplaySettings, each_is_read_as_it_is_written) {
  DisplaySettings all{0.25, true,     "en",   true,     true,   "both",  90,         false,
                      33,   "cached", "dark", "closed", "Γεια", "Hello", "http://a", ""};
  DisplaySettings read;
  ASSERT_TRUE(client::apply(settings_of(all), read).has_value());
  EXPECT_EQ(read, all);
  EXPECT_EQ(settings_of(all).size(), display_settings().size());
}

TEST(DisplaySettings, a_phones_code_is_not_told_to_who_asks) {
  DisplaySettings settings;
  ASSERT_TRUE(client::apply(DisplaySetting{"phone-address", "https://[fe80::1]:8480"}, settings).has_value());
  ASSERT_TRUE(client::apply(DisplaySetting{"phone-code", "aB3-_"}, settings).has_value());
  EXPECT_EQ(settings.phone_code, "aB3-_");
  for (const DisplaySetting& told : settings_of(settings))
    EXPECT_EQ(told.value.find("aB3"), std::string::npos) << told.name;
  const std::string long_one = "https://" + std::string(60, 'a');
  for (const std::string value :
       {"museum:8480", "ftp://museum", "https://", "https://a/b", "https://a b", "https://a?x", long_one.c_str()})
    EXPECT_THAT(refusal_of("phone-address", value), is_error(ErrorCode::invalid_value, 0, {"http"})) << value;
  EXPECT_THAT(refusal_of("phone-code", "a&b"), is_error(ErrorCode::invalid_value, 0, {"letters"}));
}

TEST(DisplaySettings, what_is_out_of_its_range_is_refused_with_the_range) {
  for (const std::string value : {"1.01", "-0.1", "nan", "inf", "1e300", "", " 0.5", "0.5 ", "0,5", "half"})
    EXPECT_THAT(refusal_of("volume", value), is_error(ErrorCode::invalid_value, 0, {"0 to 1"})) << value;
  EXPECT_THAT(refusal_of("language", "de"), is_error(ErrorCode::invalid_value, 0, {"el, en"}));
  EXPECT_THAT(refusal_of("language", ""), is_error(ErrorCode::invalid_value, 0, {"el, en"}));
  EXPECT_THAT(refusal_of("mute", "yes"), is_error(ErrorCode::invalid_value, 0, {"on, off"}));
  EXPECT_THAT(refusal_of("ask", "always"), is_error(ErrorCode::invalid_value, 0, {"none, after, both"}));
  EXPECT_THAT(refusal_of("home-after", "86401"), is_error(ErrorCode::invalid_value, 0, {"86400"}));
  EXPECT_THAT(refusal_of("attract-after", "4"), is_error(ErrorCode::invalid_value, 0, {"5 to 86400"}));
  EXPECT_THAT(refusal_of("quality", "best"),
              is_error(ErrorCode::invalid_value, 0, {"auto, high, medium, low, cached"}));
  EXPECT_THAT(refusal_of("hand", "green"), is_error(ErrorCode::invalid_value, 0, {"light, medium, dark, glove"}));
  EXPECT_THAT(refusal_of("sign", "open"), is_error(ErrorCode::invalid_value, 0, {"none, closed, maintenance"}));
  for (const std::string& message : {std::string(241, 'x'), std::string("a\nb"), std::string("\xff")})
    EXPECT_THAT(refusal_of("message-el", message), is_error(ErrorCode::invalid_value, 0, {"240 bytes"})) << message;
  EXPECT_THAT(refusal_of("colour", "red"), is_error(ErrorCode::unknown_name, 0, {"\'colour\'", "volume, mute"}));
  EXPECT_EQ(refusal_of("\x1b[2J", "1").to_string().find('\x1b'), std::string::npos) << "it may stand on a terminal";
}

TEST(DisplaySettings, of_several_all_are_taken_or_none) {
  DisplaySettings settings;
  EXPECT_FALSE(client::apply(std::vector<DisplaySetting>{{"volume", "0.1"}, {"language", "xx"}}, settings).has_value());
  EXPECT_EQ(settings, DisplaySettings{});
  EXPECT_TRUE(
      client::apply(std::vector<DisplaySetting>{{"volume", "0.1"}, {"language", "en"}, {"volume", "0.2"}}, settings)
          .has_value());
  EXPECT_EQ(settings.volume, 0.2) << "the last one counts";
}

TEST(DisplaySettings, a_word_without_a_value_sets_nothing) {
  EXPECT_EQ(*read_setting("volume=0.5"), (DisplaySetting{"volume", "0.5"}));
  EXPECT_EQ(*read_setting("language=a=b"), (DisplaySetting{"language", "a=b"}));
  for (const char* text : {"volume", "", "=0.5"})
    EXPECT_EQ(read_setting(text).error().code, ErrorCode::invalid_value) << text;
}

/// A status that is well, for tests that spoil one thing of it.
proto::DisplayStatus good_status() {
  proto::DisplayStatus wire{};
  proto::set_text(wire.kiosk, "kiosk-1");
  proto::set_text(wire.display, "wall");
  wire.protocol = proto::kProtocol;
  return wire;
}

TEST(DisplayStatus, one_that_cannot_be_is_refused_as_a_whole) {
  DisplayStatus out;
  ASSERT_TRUE(parse(good_status(), out));
  EXPECT_EQ(out.display, "wall");
  const auto refused = [](auto spoil) {
    proto::DisplayStatus wire = good_status();
    spoil(wire);
    DisplayStatus ignored;
    return !parse(wire, ignored);
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(refused([](auto& w) { w.protocol = 1; }));
  EXPECT_TRUE(refused([](auto& w) { w.link = 4; }));
  EXPECT_TRUE(refused([](auto& w) { w.kiosk[0] = '\0'; }));
  EXPECT_TRUE(refused([](auto& w) { std::memset(w.display, '*', sizeof(w.display)); }));
  EXPECT_TRUE(refused([](auto& w) { w.picture_ms_p99 = kNan; }));
  EXPECT_TRUE(refused([](auto& w) { w.frames_lost = 1.5F; }));
  EXPECT_TRUE(refused([](auto& w) { w.pictures_per_s = -1; }));
}

TEST(DisplayStatus, texts_are_one_line_of_bearable_length) {
  proto::DisplayStatus wire = good_status();
  const std::string text = "first\nsecond\t\x1b[31mred " + std::string(2000, 'x');
  wire.last_warning = proto::look_into(text);
  std::string greek;
  for (int i = 0; i < 300; ++i)
    greek += "ά";
  wire.sound = proto::look_into(greek);
  DisplayStatus out;
  ASSERT_TRUE(parse(wire, out));
  EXPECT_THAT(out.last_warning, testing::StartsWith("first second [31mred xxx"));
  EXPECT_EQ(out.last_warning.size(), 500U);
  EXPECT_EQ(out.sound.size() % 2, 0U) << "no half of a letter";
}

TEST(DisplayRequest, one_that_nobody_can_answer_or_with_too_much_is_no_request) {
  proto::DisplayRequest wire{};
  wire.protocol = proto::kProtocol;
  wire.id = 7;
  std::vector<proto::WireSetting> settings(kMaxSettings);
  proto::look_into(wire.settings, settings);
  DisplayRequest out;
  EXPECT_TRUE(parse(wire, out));
  settings.resize(kMaxSettings + 1);
  proto::look_into(wire.settings, settings);
  EXPECT_FALSE(parse(wire, out));
  settings.clear();
  proto::look_into(wire.settings, settings);
  wire.id = 0;
  EXPECT_FALSE(parse(wire, out));
}

TEST(DeviceReport, is_taken_from_a_hands_session_and_from_no_other) {
  proto::KioskStatus wire{};
  proto::set_text(wire.kiosk, "kiosk-1");
  proto::set_text(wire.device_name, "Touch \x1b[31mX");
  wire.protocol = proto::kProtocol;
  wire.user = 3;
  wire.role = mechane_role_hand;
  wire.device = mechane_device_lost;
  wire.device_kind = mechane_hand_glove;
  wire.device_side = mechane_hand_left;
  wire.calibration = mechane_calibration_pinch;
  wire.calibration_held = 0.5F;
  wire.calibration_refusal = mechane_refusal_moved;
  DeviceReport out;
  ASSERT_TRUE(parse(wire, out));
  EXPECT_EQ(out, (DeviceReport{3,
                               DeviceState::lost,
                               HandKind::glove,
                               HandSide::left,
                               "Touch [31mX",
                               {CalibrationStep::pinch, 0.5F, PoseRefusal::moved}}));
  const auto refused = [&wire](auto spoil) {
    proto::KioskStatus spoilt = wire;
    spoil(spoilt);
    DeviceReport ignored;
    return !parse(spoilt, ignored);
  };
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { s.protocol += 1; }));
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { proto::set_text(s.kiosk, "kiosk 1"); }));
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { s.role = mechane_role_watcher; }));
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { s.user = hand::kMaxUsers; }));
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { s.device = mechane_device_lost + 1; }));
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { s.device_kind = 99; }));
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { s.device_side = mechane_hand_left + 1; }));
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { s.calibration = mechane_calibration_done + 1; }));
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { s.calibration_held = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { s.calibration_held = 1.5F; }));
  EXPECT_TRUE(refused([](proto::KioskStatus& s) { s.calibration_refusal = mechane_refusal_unseen + 1; }));
}

}  // namespace
}  // namespace mechane::client
