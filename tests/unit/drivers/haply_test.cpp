// The driver of Haply's Inverse3 against a service that misbehaves, and the messages of that service.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client-sdk/drivers/haply/force_watch.hpp"
#include "client-sdk/drivers/haply/protocol.hpp"
#include "tests/support/driver_under_test.hpp"
#include "tests/support/fake_haply.hpp"

namespace {

using mechane::drivers::HaplyForceWatch;
using mechane::drivers::HaplyFrame;
using mechane::drivers::HaplyKey;
using mechane::drivers::HaplyMessage;
using mechane::drivers::HaplyVector;
using mechane::test::DriverUnderTest;
using mechane::test::FakeHaply;
using HaplyJson = nlohmann::json;

constexpr const char* kHaplyNothing = "nothing came of it";

constexpr std::array<double, 3> kHaplyNoForce{};

bool haply_never() {
  return false;
}

/// Reads until `done` or a fault, which it returns; at most 5 s.
std::string haply_read(DriverUnderTest& driver, mechane_device_state& state, const std::function<bool()>& done) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (std::chrono::steady_clock::now() < deadline) {
    if (std::string fault = driver.read(state); !fault.empty()) return fault;
    if (done()) return {};
  }
  return kHaplyNothing;
}

/// Reads and writes in turn with the same force (N, in D) until `done` or a fault, which it returns; at most 5 s.
std::string haply_push(DriverUnderTest& driver, const std::array<double, 3>& force_n,
                       const std::function<bool()>& done) {
  mechane_device_state state{};
  mechane_device_force force{};
  std::copy(force_n.begin(), force_n.end(), force.force_n);
  std::string fault;
  return haply_read(driver, state, [&] { return !(fault = driver.write(force)).empty() || done(); }) + fault;
}

bool haply_wait(const std::function<bool()>& done) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (!done() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::yield();
  return done();
}

std::string haply_state(const std::string& state, const std::string& rest = "") {
  return R"({"inverse3": [{"device_id": "049D", "state": )" + state + "}]" + rest + "}";
}

constexpr const char* kHaplyWhole =
    R"({"cursor_position": {"x": 0.1, "y": -0.2, "z": 0.3}, "current_cursor_force": {"x": 1, "y": 2, "z": 3}})";

HaplyMessage haply_kind(const std::string& text, const std::string& device = "") {
  HaplyFrame frame;
  return mechane::drivers::parse_haply(text, device, frame).kind;
}

// --- messages

TEST(HaplyMessages, StateOfTheArmThatWasAskedFor) {
  HaplyFrame frame;
  const std::string text = R"({"inverse3": [{"device_id": "0001", "state": {}}, {"device_id": "049D",
      "config": {"basis": {"permutation": "XZY"}}, "status": {"calibrated": false}, "state": )" +
                           std::string(kHaplyWhole) + "}]}";
  ASSERT_EQ(mechane::drivers::parse_haply(text, "049D", frame).kind, HaplyMessage::state);
  EXPECT_EQ(frame.device_id, "049D");
  EXPECT_EQ(frame.cursor_position_m, (HaplyVector{0.1, -0.2, 0.3}));
  EXPECT_EQ(frame.cursor_force_n, (HaplyVector{1, 2, 3}));
  EXPECT_EQ(frame.basis, "XZY");
  EXPECT_FALSE(frame.ready);
  EXPECT_EQ(haply_kind(text, "0002"), HaplyMessage::no_device);
  EXPECT_EQ(haply_kind(text), HaplyMessage::malformed) << "without an id the first arm counts, which has no data";
  EXPECT_EQ(mechane::drivers::haply_devices(text), "0001, 049D");
}

TEST(HaplyMessages, MalformedOnesChangeNothing) {
  const std::string whole = haply_state(kHaplyWhole);
  HaplyFrame frame;
  ASSERT_EQ(mechane::drivers::parse_haply(whole, "", frame).kind, HaplyMessage::state);
  for (std::size_t cut = 0; cut < whole.size(); ++cut)
    EXPECT_EQ(mechane::drivers::parse_haply(whole.substr(0, cut), "", frame).kind, HaplyMessage::malformed) << cut;
  for (const char* const state :
       {"{}", "[]", "7", R"({"cursor_position": {"x": 0, "y": 0, "z": 0}})",
        R"({"current_cursor_force": {"x": 0, "y": 0, "z": 0}})",
        R"({"cursor_position": {"x": null, "y": 0, "z": 0}, "current_cursor_force": {"x": 0, "y": 0, "z": 0}})",
        R"({"cursor_position": {"x": NaN, "y": 0, "z": 0}, "current_cursor_force": {"x": 0, "y": 0, "z": 0}})",
        R"({"cursor_position": {"x": 1e999, "y": 0, "z": 0}, "current_cursor_force": {"x": 0, "y": 0, "z": 0}})",
        R"({"cursor_position": {"x": 120, "y": 0, "z": 0}, "current_cursor_force": {"x": 0, "y": 0, "z": 0}})",
        R"({"cursor_position": {"x": 0, "y": 0, "z": 0}, "current_cursor_force": {"x": 0, "y": "0", "z": 0}})"})
    EXPECT_EQ(mechane::drivers::parse_haply(haply_state(state), "", frame).kind, HaplyMessage::malformed) << state;
  EXPECT_EQ(frame.cursor_position_m, (HaplyVector{0.1, -0.2, 0.3}));
  EXPECT_EQ(frame.cursor_force_n, (HaplyVector{1, 2, 3}));
  EXPECT_EQ(haply_kind("{}"), HaplyMessage::no_device);
  EXPECT_EQ(haply_kind(R"({"inverse3": []})"), HaplyMessage::no_device);
  EXPECT_EQ(haply_kind(R"({"inverse3": [{"device_id": "a\"b", "state": {}}]})"), HaplyMessage::no_device);
}

TEST(HaplyMessages, ButtonsOfAllKindsOfGrips) {
  const auto buttons = [](const std::string& grip, const std::string& kind = "verse_grip") {
    HaplyFrame frame;
    const std::string rest = ",\"" + kind + R"(": [{"device_id": "1", "state": {"orientation": {"w": 1, "x": 0, "y": 0,
        "z": 0}, )" + grip + "}}]";
    EXPECT_EQ(mechane::drivers::parse_haply(haply_state(kHaplyWhole, rest), "", frame).kind, HaplyMessage::state);
    EXPECT_TRUE(frame.has_grip);
    return frame.grip_buttons;
  };
  EXPECT_EQ(buttons(R"("button": true, "hall": 3)"), 1U);
  EXPECT_EQ(buttons(R"("buttons": {"a": true, "b": false, "c": true})", "wireless_verse_grip"), 5U);
  EXPECT_EQ(buttons(R"("buttons": {"button_0": false, "button_1": true, "button_2": false, "button_3": true})"), 10U);
  EXPECT_EQ(buttons(R"("buttons": null)"), 0U);
}

TEST(HaplyMessages, GripThatSleepsKeepsItsOrientationAndLetsItsButtonsGo) {
  HaplyFrame frame;
  const auto rest = [](const char* w) {
    return R"(,"verse_grip": [{"state": {"button": true, "orientation": {"w": )" + std::string(w) +
           R"(, "x": 0.6, "y": 0, "z": 0}}}])";
  };
  ASSERT_EQ(mechane::drivers::parse_haply(haply_state(kHaplyWhole, rest("0.8")), "", frame).kind, HaplyMessage::state);
  EXPECT_EQ(frame.grip_buttons, 1U);
  for (const char* const w : {"0", "3", "null"}) {
    ASSERT_EQ(mechane::drivers::parse_haply(haply_state(kHaplyWhole, rest(w)), "", frame).kind, HaplyMessage::state);
    EXPECT_FALSE(frame.has_grip);
    EXPECT_NEAR(frame.grip_wxyz[1], 0.6, 1e-12);
    EXPECT_EQ(frame.grip_buttons, 0U);
  }
}

TEST(HaplyMessages, Versions) {
  using Version = std::pair<int, int>;
  const auto version = mechane::drivers::parse_haply_version;
  EXPECT_EQ(version(R"({"project_version": "3.1.1.0"})"), Version(3, 1));
  EXPECT_EQ(version(R"({"ok": true, "data": {"project_version": "3.10"}})"), Version(3, 10));
  for (const char* const text : {"", "{}", "not found", R"({"project_version": 3.5})", R"({"project_version": "3"})",
                                 R"({"project_version": "3."})", R"({"project_version": "v3.5"})"})
    EXPECT_FALSE(version(text)) << text;
}

TEST(HaplyMessages, CommandsInBothFormats) {
  std::string text;
  for (const auto& [key, name] : {std::pair(HaplyKey::values, "values"), std::pair(HaplyKey::vector, "vector")}) {
    mechane::drivers::write_haply_force(text, "049D", key, {1.5, -2.25, 1e-9});
    const HaplyJson command = HaplyJson::parse(text);
    EXPECT_EQ(command["inverse3"][0]["device_id"], "049D");
    const HaplyJson& force = command["inverse3"][0]["commands"]["set_cursor_force"][name];
    EXPECT_EQ(force["x"], 1.5);
    EXPECT_EQ(force["y"], -2.25);
    EXPECT_EQ(force["z"], 0);
  }
}

// --- the watch over forces

TEST(HaplyForces, WeakerLaterAndSmootherThanAskedIsFine) {
  HaplyForceWatch watch;
  double smooth = 0;
  for (int i = 0; i < 5000; ++i) {
    const double asked = i % 1000 < 500 ? 8 + std::sin(i * 1.2) : 0;  // 200 Hz on a wall that comes and goes
    watch.asked({0, 0, asked});
    ASSERT_EQ(watch.rendered({0, 0, smooth}), HaplyForceWatch::Verdict::fine) << i;
    smooth += 0.3 * (0.8 * asked - smooth);
  }
}

TEST(HaplyForces, AnotherSessionsForceIsFoundEvenIfItComesAndGoes) {
  HaplyForceWatch watch;
  int fine = 0;
  for (int i = 0; i < 1000; ++i) {
    watch.asked({2, 0, 0});
    if (watch.rendered({2, 0, i % 2 == 0 ? 3.0 : 0.0}) == HaplyForceWatch::Verdict::fine) fine = i;
  }
  EXPECT_GT(fine, 200);
  EXPECT_LT(fine, 400);
}

// --- the driver

TEST(HaplyDriver, DescribesTheArm) {
  FakeHaply service;
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(service.options()), "");
  mechane_device_info info{};
  ASSERT_EQ(driver.describe(info), "");
  EXPECT_STREQ(info.name, "Haply Inverse3 049D");
  EXPECT_EQ(info.hand, MECHANE_HAND_POINT);
  EXPECT_EQ(info.output, MECHANE_OUTPUT_FORCE);
  EXPECT_EQ(info.peak_force_n, 10);
  EXPECT_LT(info.continuous_force_n, info.peak_force_n);
  EXPECT_EQ(info.rate_hz, 1000);
}

TEST(HaplyDriver, ReadsTheHandInFrameD) {
  FakeHaply service;
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(service.options()), "");
  mechane_device_state state{};
  ASSERT_EQ(haply_read(driver, state, [&] { return state.flags == MECHANE_STATE_READY; }), "");
  EXPECT_EQ(state.position_m[0], 0.01);
  EXPECT_EQ(state.position_m[1], 0.03);
  EXPECT_EQ(state.position_m[2], -0.02);
  EXPECT_EQ(state.orientation_wxyz[0], 0.5);
  EXPECT_EQ(state.orientation_wxyz[1], 0.5);
  EXPECT_EQ(state.orientation_wxyz[2], 0.5);
  EXPECT_EQ(state.orientation_wxyz[3], -0.5);
  EXPECT_EQ(state.buttons, 2U);
  service.change([](HaplyJson& frame) { frame["inverse3"][0]["status"]["calibrated"] = false; });
  EXPECT_EQ(haply_read(driver, state, [&] { return state.flags == MECHANE_STATE_UNCALIBRATED; }), "");
  service.change([](HaplyJson& frame) {
    frame["inverse3"][0]["status"]["calibrated"] = true;
    frame["inverse3"][0]["status"]["power_supply"] = false;
  });
  EXPECT_EQ(haply_read(driver, state, [&] { return state.flags == 0; }), "");
}

TEST(HaplyDriver, OriginIsInTheMiddleOfTheWorkspaceInBothFormats) {
  FakeHaply old("3.1.1.0");
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(old.options()), "");
  mechane_device_state state{};
  ASSERT_EQ(driver.read(state), "");
  EXPECT_NEAR(state.position_m[0], 0.01, 1e-12);
  EXPECT_NEAR(state.position_m[1], 0.03 - 0.15, 1e-12);
  EXPECT_NEAR(state.position_m[2], -0.02 - 0.12, 1e-12);

  FakeHaply recent;
  DriverUnderTest other("haply");
  ASSERT_EQ(other.open(recent.options()), "");
  const HaplyJson first = HaplyJson::parse(recent.first_command());
  EXPECT_EQ(first["inverse3"][0]["configure"]["preset"], "arm_front_centered");
  EXPECT_TRUE(first["session"]["configure"]["profile"]["name"].is_string());
}

TEST(HaplyDriver, RendersForcesInBothFormatsAndNoneInTheEnd) {
  for (const auto& [version, more] :
       {std::pair("3.1.1.0", ""), std::pair("3.5.0.0", ""), std::pair("3.1.1.0", "key=values"),
        std::pair("3.5.0.0", "key=vector,device=049D")}) {
    FakeHaply service(version);
    DriverUnderTest driver("haply");
    ASSERT_EQ(driver.open(service.options(more)), "");
    EXPECT_EQ(service.force(), kHaplyNoForce) << "no force may flow after open()";
    const std::array<double, 3> expected{1, -3, 2};
    EXPECT_EQ(haply_push(driver, {1, 2, 3}, [&] { return service.force() == expected; }), "") << version;
    driver.close();
    EXPECT_TRUE(haply_wait([&] { return service.ended() == 1; }));
    EXPECT_EQ(service.force(), kHaplyNoForce);
  }
}

TEST(HaplyDriver, ClampsForcesAndReplacesWhatIsNoNumber) {
  FakeHaply service;
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(service.options()), "");
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInfinity}) {
    const std::array<double, 3> clamped{6, 0, 8};
    EXPECT_EQ(haply_push(driver, {30, 40, 0}, [&] { return service.force() == clamped; }), "");
    EXPECT_EQ(haply_push(driver, {1, bad, 1}, [&] { return service.force() == kHaplyNoForce; }), "");
  }
}

TEST(HaplyDriver, ReadsWithoutWritesHaveNoForce) {
  FakeHaply service;
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(service.options()), "");
  ASSERT_EQ(haply_push(driver, {1, 0, 0}, [&] { return service.force() != kHaplyNoForce; }), "");
  mechane_device_state state{};
  EXPECT_EQ(haply_read(driver, state, [&] { return service.force() == kHaplyNoForce; }), "");
}

TEST(HaplyDriver, RefusesWhatItCannotServe) {
  FakeHaply service;
  const auto fault = [](const std::string& options) { return DriverUnderTest("haply").open(options); };
  EXPECT_NE(fault(service.options("device=0001")).find("049D"), std::string::npos) << "it tells which arms there are";
  EXPECT_NE(fault(service.options("device=\"")), "");
  EXPECT_NE(fault(service.options("key=other")), "");
  EXPECT_NE(fault("port=0"), "");
  EXPECT_NE(fault(FakeHaply("3.0.5.0").options()), "") << "another format";
  EXPECT_NE(fault(FakeHaply("unknown").options()), "") << "no version";
  service.change([](HaplyJson& frame) { frame["inverse3"][0]["config"]["basis"]["permutation"] = "XZY"; });
  EXPECT_NE(fault(service.options()), "") << "axes permuted";
  service.change([](HaplyJson& frame) { frame["inverse3"] = HaplyJson::array(); });
  EXPECT_NE(fault(service.options()), "") << "no arm";
  service.change([](HaplyJson& frame) { frame = "hello"; });
  EXPECT_NE(fault(service.options()), "") << "something else";
}

TEST(HaplyDriver, SaysThatThereIsNoService) {
  std::string options;
  {
    const FakeHaply service;
    options = service.options();
  }
  EXPECT_NE(DriverUnderTest("haply").open(options), "");
  EXPECT_NE(DriverUnderTest("haply").open(options + ",key=vector"), "");
}

TEST(HaplyDriver, FaultsWhenTheServiceOrTheArmGoesAndOpensAgain) {
  FakeHaply service;
  mechane_device_state state{};
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(service.options()), "");
  service.hang_up();
  EXPECT_NE(haply_read(driver, state, haply_never), kHaplyNothing);
  driver.close();
  ASSERT_EQ(driver.open(service.options()), "");
  const HaplyJson arms = [&] {
    HaplyJson kept;
    service.change([&](HaplyJson& frame) { kept = std::exchange(frame["inverse3"], HaplyJson::array()); });
    return kept;
  }();
  EXPECT_NE(haply_read(driver, state, haply_never).find("049D is gone"), std::string::npos);
  driver.close();
  service.change([&](HaplyJson& frame) { frame["inverse3"] = arms; });
  ASSERT_EQ(driver.open(service.options()), "");
  EXPECT_EQ(driver.read(state), "");
}

TEST(HaplyDriver, FaultsWhenAnswersStop) {
  FakeHaply service;
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(service.options()), "");
  service.answer_with([](HaplyJson&) { return std::string(); });
  const int before = service.commands();
  const auto start = std::chrono::steady_clock::now();
  mechane_device_state state{};
  EXPECT_EQ(haply_read(driver, state, [&] { return state.flags == 0; }), "") << "first it is not ready";
  EXPECT_NE(haply_push(driver, {}, haply_never), kHaplyNothing);
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(900));
  EXPECT_LE(service.commands(), before + 1) << "no commands pile up while an answer is due";
}

TEST(HaplyDriver, BearsALateAnswer) {
  std::atomic<bool> late = true;
  FakeHaply service;
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(service.options()), "");
  service.answer_with([&late](HaplyJson& frame) {
    late.wait(true);
    frame["inverse3"][0]["state"]["cursor_position"]["x"] = 0.02;
    return frame.dump();
  });
  mechane_device_state state{};
  EXPECT_EQ(driver.read(state), "");
  EXPECT_EQ(state.position_m[0], 0.01) << "what it last knew";
  late = false;
  late.notify_all();
  EXPECT_EQ(haply_read(driver, state, [&] { return state.position_m[0] == 0.02; }), "");
}

TEST(HaplyDriver, SkipsTornMessagesButNotForEver) {
  FakeHaply service;
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(service.options()), "");
  mechane_device_state state{};
  service.answer_with([count = 0](HaplyJson& frame) mutable {
    frame["inverse3"][0]["state"]["cursor_position"]["x"] = 0.05;
    const std::string text = frame.dump();
    return ++count % 4 == 0 ? text : text.substr(0, text.size() / 2);
  });
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(driver.read(state), "") << i;
    EXPECT_TRUE(state.position_m[0] == 0.01 || state.position_m[0] == 0.05);
  }
  EXPECT_EQ(state.position_m[0], 0.05);
  service.answer_with([](HaplyJson&) { return std::string("so sorry"); });
  EXPECT_NE(haply_read(driver, state, haply_never).find("in a row"), std::string::npos);
}

TEST(HaplyDriver, FaultsOnDataThatAreNoneOrInOtherUnits) {
  for (const HaplyJson& x : {HaplyJson(), HaplyJson(73.5), HaplyJson("0.1")}) {
    FakeHaply service;
    DriverUnderTest driver("haply");
    ASSERT_EQ(driver.open(service.options()), "");
    mechane_device_state state{};
    service.change([&](HaplyJson& frame) { frame["inverse3"][0]["state"]["cursor_position"]["x"] = x; });
    EXPECT_NE(haply_read(driver, state, haply_never), kHaplyNothing) << x;
  }
  FakeHaply service;
  service.change([](HaplyJson& frame) { frame["inverse3"][0]["state"].erase("current_cursor_force"); });
  EXPECT_NE(DriverUnderTest("haply").open(service.options()), "") << "the watch over forces would be blind";
}

TEST(HaplyDriver, RefusesASecondSessionThatAddsForce) {
  FakeHaply service;
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(service.options()), "");
  ASSERT_EQ(haply_push(driver, {2, 0, 0}, [&] { return service.commands() > 600; }), "");
  service.add_force(-3);
  EXPECT_NE(haply_push(driver, {2, 0, 0}, haply_never).find("another program"), std::string::npos);
}

TEST(HaplyDriver, SaysThatTheServiceReadsTheOtherFormat) {
  FakeHaply service("3.1.1.0");
  DriverUnderTest driver("haply");
  ASSERT_EQ(driver.open(service.options("key=vector")), "");
  EXPECT_NE(haply_push(driver, {2, 0, 0}, haply_never).find("key=values"), std::string::npos);
}

}  // namespace
