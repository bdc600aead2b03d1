#include "client-sdk/gateway/browsers/browser_message.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mechane::gateway {
namespace {

std::string pointer_message(const std::string& events, const std::string& more = "") {
  return R"({"type":"pointer","events":[)" + events +
         R"(],"picture":[1280,720],"camera":{"pose":[1,2,3,0,0,0,1],"fov":0.8,"aspect":1.7778)" + more + "}}";
}

TEST(BrowserMessages, APointersEventsAreRead) {
  const auto message = parse_browser_message(pointer_message(
      R"({"kind":"press","x":10,"y":20.5,"finger":3,"pick":{"object":7,"p":[1,2,-3],"n":[0,1,0]}},{"kind":"wheel","amount":-2})"));
  ASSERT_TRUE(message) << message.error().to_string();
  const auto& pointer = std::get<PointerMessage>(*message);
  ASSERT_EQ(pointer.events.size(), 2U);
  EXPECT_EQ(pointer.events[0].event.kind, pointer::PointerEvent::Kind::press);
  EXPECT_EQ(pointer.events[0].event.finger, 3);
  EXPECT_EQ(pointer.events[0].event.y, 20.5);
  EXPECT_EQ(pointer.events[0].pick->object, 7U);
  EXPECT_EQ(pointer.events[0].pick->p_WT, Vec3(1, 2, -3));
  EXPECT_EQ(pointer.events[1].event.amount, -2);
  EXPECT_FALSE(pointer.events[1].pick);
}

TEST(BrowserMessages, ACameraSeesAsADisplaysDoes) {
  picture::Camera camera;
  camera.p_WC = Vec3(1, 2, 3);
  camera.p_WT = Vec3(1, 2, 0);
  camera.field_of_view_rad = 0.8;
  const double aspect = 1280.0 / 720;
  const picture::Sight wanted{picture::eye_view(camera, picture::Eye::middle, aspect), {1280, 720}};
  const auto message = parse_browser_message(pointer_message(R"({"kind":"move","x":1,"y":1})"));
  ASSERT_TRUE(message);
  const picture::Sight& sight = std::get<PointerMessage>(*message).sight;
  for (const picture::PixelPlace place : {picture::PixelPlace{0, 0}, {1280, 720}, {300, 500}}) {
    const picture::SightRay is = picture::ray_through(sight, place), should = picture::ray_through(wanted, place);
    EXPECT_LT((is.p_W - should.p_W).norm(), 1e-5);
    EXPECT_LT((is.d_W - should.d_W).norm(), 1e-4);
  }
}

TEST(BrowserMessages, AnOffsetMovesTheMiddle) {
  const auto message = parse_browser_message(pointer_message("", R"(,"offset":[0,-0.25])"));
  ASSERT_TRUE(message);
  const picture::Sight& sight = std::get<PointerMessage>(*message).sight;
  const auto at = picture::pixel_of(sight, Vec3(1, 2, 0));
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->x, 640, 1e-3);
  EXPECT_NEAR(at->y, 360 * (1 - 0.25), 1e-2);
}

TEST(BrowserMessages, TheOthersAreRead) {
  EXPECT_EQ(std::get<PressMessage>(*parse_browser_message(R"({"type":"press","action":"language:en"})")).action,
            (picture::OverlayAction{picture::OverlayAction::Kind::language, "en"}));
  EXPECT_EQ(std::get<ClickMessage>(*parse_browser_message(R"({"type":"click","object":4})")).object, 4U);
  const auto settings = std::get<SettingsMessage>(*parse_browser_message(R"({"type":"settings","largeText":true})"));
  EXPECT_EQ(settings.large_text, true);
  EXPECT_FALSE(settings.high_contrast);
  const auto status = std::get<StatusMessage>(*parse_browser_message(
      R"({"type":"status","picturesPerS":30,"pictureMsMedian":8,"pictureMsP99":20,"width":480,"height":270,"missing":["a"]})"));
  EXPECT_EQ(status.missing, std::vector<std::string>{"a"});
  EXPECT_TRUE(std::holds_alternative<TouchMessage>(*parse_browser_message(R"({"type":"touch"})")));
}

TEST(BrowserMessages, WhatIsWrongIsNamed) {
  const auto place_of = [](const std::string& text) {
    const auto message = parse_browser_message(text);
    return message ? std::string("nothing is wrong") : message.error().where;
  };
  EXPECT_EQ(place_of(pointer_message(R"({"kind":"stroke","x":1,"y":1})")), "events.kind");
  EXPECT_EQ(place_of(pointer_message(R"({"kind":"move","x":"1"})")), "events.x");
  EXPECT_EQ(place_of(pointer_message(R"({"kind":"move","x":1e300})")), "events.x");
  EXPECT_EQ(place_of(pointer_message(R"({"kind":"press","pick":{"object":-1,"p":[0,0,0]}})")), "events.pick.object");
  EXPECT_EQ(place_of(pointer_message(R"({"kind":"press","pick":{"object":1,"p":[0,0]}})")), "events.pick.p");
  EXPECT_EQ(place_of(pointer_message("", R"(,"offset":[0])")), "camera.offset");
  EXPECT_EQ(place_of(R"({"type":"pointer","events":[]})"), "camera");
  EXPECT_EQ(place_of(R"({"type":"press","action":"explode"})"), "action");
  EXPECT_EQ(place_of(R"({"type":"status"})"), "picturesPerS");
  EXPECT_EQ(place_of(R"({"type":7})"), "type");
  EXPECT_EQ(parse_browser_message(R"({"type":"stroke"})").error().code, ErrorCode::unknown_name);
  for (const char* text : {"", "[", "[]", "7", "\"touch\"", "{\"type\":\"touch\"", "\xff"})
    EXPECT_EQ(parse_browser_message(text).error().code, ErrorCode::damaged) << text;
  std::string many;
  for (std::size_t k = 0; k <= kMostEvents; ++k)
    many += std::string(k == 0 ? "" : ",") + R"({"kind":"left"})";
  EXPECT_EQ(parse_browser_message(pointer_message(many)).error().code, ErrorCode::too_large);
}

TEST(BrowserMessages, ActionsComeBackAsTheyWere) {
  using Action = picture::OverlayAction;
  for (const Action& action :
       {Action{Action::Kind::home, ""}, Action{Action::Kind::answer, "a:b"}, Action{Action::Kind::skip, ""},
        Action{Action::Kind::close, ""}, Action{Action::Kind::activity, "use"}})
    EXPECT_EQ(action_of(action_text(action)), action);
}

}  // namespace
}  // namespace mechane::gateway
