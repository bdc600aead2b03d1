// The driver of hand tracking against a program that sends hands to its socket; what it takes for a hand, and the angles
// that it finds, against the hand that the server touches with.
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <rapidcheck.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include "client-sdk/drivers/joints/hand_datagram.hpp"
#include "tests/support/driver_under_test.hpp"
#include "tests/support/property_draw.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_folder.hpp"
#include "tests/support/tracker_points.hpp"

namespace mechane::drivers {
namespace {

using namespace std::chrono_literals;
using haptic::SeenHand;
using test::DriverUnderTest;
using test::ScratchFolder;
using test::tracker_points;

constexpr double kJointsDegree = kPi / 180;
constexpr const char* kJointsFormatNames[] = {"openxr", "webxr", "mediapipe"};

std::string joints_list(const std::vector<Vec3>& points) {
  std::string list;
  for (const Vec3& p : points) {
    std::array<char, 100> text;
    std::snprintf(text.data(), text.size(), "%s[%.9f,%.9f,%.9f]", list.empty() ? "" : ",", p.x(), p.y(), p.z());
    list += text.data();
  }
  return "[" + list + "]";
}

std::string joints_text(const SeenHand& hand, const std::string& format = "openxr", const std::string& more = "") {
  return R"({"format":")" + format + R"(","hand":")" + (hand.left() ? "left" : "right") + R"(","joints":)" +
         joints_list(tracker_points(hand, format)) + more + "}";
}

std::string joints_without(const std::string& text, const std::string& part, const std::string& instead) {
  std::string changed = text;
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : changed.replace(at, part.size(), instead);
}

/// The program that tracks. Whatever nobody takes is lost.
class JointsSender {
 public:
  explicit JointsSender(const std::string& file) : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    unix_.sun_family = AF_UNIX;
    file.copy(unix_.sun_path, sizeof(unix_.sun_path) - 1);
  }
  explicit JointsSender(int port) : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    udp_.sin_family = AF_INET;
    udp_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    udp_.sin_port = htons(static_cast<std::uint16_t>(port));
  }
  ~JointsSender() { ::close(socket_); }
  JointsSender(const JointsSender&) = delete;
  JointsSender& operator=(const JointsSender&) = delete;

  bool send(const std::string& text) const {
    const bool udp = udp_.sin_family != 0;
    const auto* const to = udp ? reinterpret_cast<const sockaddr*>(&udp_) : reinterpret_cast<const sockaddr*>(&unix_);
    const auto size = static_cast<socklen_t>(udp ? sizeof(udp_) : sizeof(unix_));
    return ::sendto(socket_, text.data(), text.size(), 0, to, size) >= 0;
  }
  /// Sends again and again while `meanwhile` runs.
  std::string while_sending(const std::string& text, const std::function<std::string()>& meanwhile) const {
    std::atomic<bool> done{false};
    std::thread sender([&] {
      while (!done) {
        (void)send(text);
        ::poll(nullptr, 0, 1);
      }
    });
    std::string result = meanwhile();
    done = true;
    sender.join();
    return result;
  }

 private:
  int socket_;
  sockaddr_un unix_{};
  sockaddr_in udp_{};
};

double any_degrees(double least, double most) {
  return *test::between(least * kJointsDegree, most * kJointsDegree);
}

SeenHand hand_of(bool left) {
  SeenHand hand;
  if (left) hand.build.side = hand::HandSide::left;
  return hand;
}

SeenHand any_hand(bool left) {
  SeenHand hand = hand_of(left);
  hand.build.hand_scale = *test::between(0.6, 1.3);
  for (double& scale : hand.build.finger_scale)
    scale = *test::between(0.8, 1.2);
  hand.X_DH.p = Vec3(*test::between(-2, 2), *test::between(-2, 2), *test::between(-2, 2));
  hand.X_DH.R = Quat(Eigen::AngleAxisd(*test::between(-kPi, kPi), test::any_unit()));
  for (std::size_t f = 0; f < MECHANE_FINGERS; ++f) {
    double* const angles = &hand.joints_rad[4 * f];
    angles[0] = f == 0 ? any_degrees(-55, 55) : any_degrees(-40, 40);
    angles[1] = f == 0 ? any_degrees(-55, 65) : any_degrees(-40, 105);
    angles[2] = f == 0 ? any_degrees(-40, 85) : any_degrees(-15, 125);
    angles[3] = any_degrees(-40, 95);
  }
  return hand;
}

/// How much of a finger lies along the palm: its abduction cannot be seen where that is little.
double joints_along_palm(const SeenHand& hand, std::size_t finger) {
  const hand::FingerSize size = hand::middle_sized_fingers()[finger];
  double angle = 0, squares = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    angle += hand.joints_rad[4 * finger + k + 1];
    squares += std::pow(hand.build.length_scale(hand::first_segment(finger)) * size.length_m[k] * std::cos(angle), 2);
  }
  return std::sqrt(squares);
}

/// Datagrams that are no hand: each has one thing wrong with it.
std::vector<std::string> joints_wrong(const SeenHand& hand, const std::string& whole) {
  const auto with = [&](const std::string& part, const std::string& instead) {
    return joints_without(whole, part, instead);
  };
  const auto all = tracker_points(hand, "openxr");
  auto no_bone = all, millimetres = all, no_plane = all;
  no_bone[8] = no_bone[7];
  for (Vec3& p : millimetres)
    p = 1000 * (p - hand.X_DH.p);
  no_plane[22] = no_plane[7] + Vec3(1e-5, 0, 0);  // two knuckles
  const std::string first = "[0.650000000";
  std::vector<std::string> wrong{"",
                                 "{}",
                                 "null",
                                 "[]",
                                 whole.substr(0, whole.size() / 2),
                                 whole + "x",
                                 with("openxr", "webxr"),
                                 with("openxr", "\xff"),
                                 with("\"openxr\"", "7"),
                                 with("right", "both"),
                                 with("\"right\"", "[]"),
                                 with("\"joints\"", "\"bones\""),
                                 with("\"pinch", "\"seq\":-1,\"pinch"),
                                 with("\"pinch", "\"seq\":1.5,\"pinch"),
                                 with("0.25", "1.1"),
                                 with("0.25", "\"0\""),
                                 with("true", "1"),
                                 with("true", "[true]"),
                                 with("true", std::string(8000, '[')),
                                 with("{", "{\"a\":" + std::string(90, '[') + std::string(90, ']') + ","),
                                 with("{", std::string(17 * 1024, ' ') + "{")};
  for (const char* number : {"NaN", "Infinity", "1e999", "null", "\"0\"", "0,0.65", "1e3", "-10.1", "[0]", "0x1"})
    wrong.push_back(with(first, std::string("[") + number));
  for (const auto& points : {no_bone, millimetres, no_plane})
    wrong.push_back(with(joints_list(all), joints_list(points)));
  return wrong;
}

class JointsTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string open(const std::string& more = "", const SeenHand& first = {}) {
    return sender_.while_sending(joints_text(first), [&] { return driver_.open("socket=" + file_ + more); });
  }
  /// What the driver makes of a datagram.
  [[nodiscard]] std::string take(const std::string& text) {
    // What was sent while the device opened may still fill the socket.
    while (!sender_.send(text)) {
      if (std::string fault = driver_.read(state_); !fault.empty()) return fault;
    }
    return driver_.read(state_);
  }
  [[nodiscard]] bool ready() const { return state_.flags == MECHANE_STATE_READY; }
  /// Reads until `done`, or a fault.
  [[nodiscard]] std::string serve(const std::function<bool()>& done) {
    const auto until = std::chrono::steady_clock::now() + 5s;
    while (std::chrono::steady_clock::now() < until) {
      if (std::string fault = driver_.read(state_); !fault.empty()) return fault;
      if (done()) return {};
    }
    return "it never came to this";
  }

  void check_any_hand(bool left) {
    const SeenHand hand = any_hand(left);
    const std::string format =
        *rc::gen::elementOf(std::vector<std::string>(kJointsFormatNames, kJointsFormatNames + 3));
    RC_ASSERT(take(joints_text(hand, format)) == "");
    RC_ASSERT(ready());
    SeenHand found = hand;
    found.X_DH.p = Vec3(state_.position_m[0], state_.position_m[1], state_.position_m[2]);
    const auto& q = state_.orientation_wxyz;
    found.X_DH.R = Quat(q[0], q[1], q[2], q[3]);
    std::copy(std::begin(state_.joints_rad), std::end(state_.joints_rad), found.joints_rad.begin());
    RC_ASSERT((found.X_DH.p - hand.X_DH.p).norm() < 1e-6);
    RC_ASSERT(found.X_DH.R.angularDistance(hand.X_DH.R) < 1e-5);
    for (std::size_t f = 0; f < MECHANE_FINGERS; ++f) {
      for (std::size_t j = 0; j < 4; ++j)
        RC_ASSERT((found.finger_D(f)[j] - hand.finger_D(f)[j]).norm() < 0.001);
      if (joints_along_palm(hand, f) < 0.02) continue;
      for (std::size_t j = 4 * f; j < 4 * (f + 1); ++j)
        RC_ASSERT(std::abs(found.joints_rad[j] - hand.joints_rad[j]) < 0.02);
    }
  }

  ScratchFolder folder_;
  std::string file_ = (folder_.path() / "hand").string();
  JointsSender sender_{file_};
  DriverUnderTest driver_{"joints"};
  mechane_device_state state_{};
};

TEST_F(JointsTest, AnyHandInAnyFormatGivesItsOwnAngles) {
  for (const bool left : {false, true}) {
    driver_.close();
    ASSERT_EQ(open(left ? ",hand=left" : "", hand_of(left)), "");
    mechane_device_info info{};
    ASSERT_EQ(driver_.describe(info), "");
    EXPECT_EQ(info.side, left ? MECHANE_HAND_LEFT : MECHANE_HAND_RIGHT);
    EXPECT_TRUE(rc::check([&] { check_any_hand(left); }));
  }
}

TEST_F(JointsTest, TheDeviceIsAGloveThatOnlyReads) {
  ASSERT_EQ(open(), "");
  mechane_device_info info;
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_EQ(info.hand, MECHANE_HAND_GLOVE);
  EXPECT_EQ(info.output, MECHANE_OUTPUT_NONE);
  ASSERT_EQ(take(joints_text({})), "");
  EXPECT_TRUE(ready());
  EXPECT_EQ(driver_.write({}), "");
}

TEST_F(JointsTest, WhatIsNotAHandIsSkipped) {
  SeenHand hand;
  hand.X_DH.p = Vec3(0.6, 0, 0);
  const std::string whole = joints_text(hand, "openxr", R"(,"pinch":0.25,"tracked":true)");
  const std::string good = joints_text({});
  ASSERT_EQ(open(), "");
  ASSERT_EQ(take(good), "");
  const mechane_device_state before = state_;
  for (const std::string& text : joints_wrong(hand, whole)) {
    EXPECT_TRUE(sender_.send(good));
    ASSERT_EQ(take(text), "");
    EXPECT_EQ(std::memcmp(&before, &state_, sizeof(before)), 0)
        << text.substr(0, 60) << " ... " << text.substr(text.size() - std::min<std::size_t>(text.size(), 60));
  }
  ASSERT_EQ(take(whole), "");
  EXPECT_EQ(state_.position_m[0], 0.6) << "nothing else was wrong with it";
  EXPECT_EQ(state_.grasp, 0.25);
}

TEST_F(JointsTest, ALongRowOfDatagramsThatAreNoHandIsAFault) {
  ASSERT_EQ(open(), "");
  EXPECT_NE(sender_.while_sending("{}", [&] { return serve([] { return false; }); }).find("format"), std::string::npos);
}

TEST_F(JointsTest, AHandThatIsNotTrackedIsNotReadyAndStays) {
  SeenHand fist;
  for (std::size_t f = 1; f < MECHANE_FINGERS; ++f)
    fist.joints_rad[4 * f + 1] = 1.5;
  SeenHand elsewhere;
  elsewhere.X_DH.p = Vec3::Zero();
  std::string one_missing = "true";
  for (int i = 1; i < 26; ++i)
    one_missing += i == 14 ? ",false" : ",true";
  ASSERT_EQ(open(), "");
  for (const std::string& text : {joints_text(elsewhere, "openxr", R"(,"tracked":false)"),
                                  joints_text(elsewhere, "openxr", ",\"tracked\":[" + one_missing + "]"),
                                  std::string(R"({"format":"mediapipe","hand":"right","tracked":false})")}) {
    ASSERT_EQ(take(joints_text(fist)), "");
    ASSERT_TRUE(ready());
    ASSERT_EQ(take(text), "");
    EXPECT_FALSE(ready()) << text;
    EXPECT_EQ(state_.position_m[0], fist.X_DH.p.x());
    EXPECT_NEAR(state_.joints_rad[4 + 1], 1.5, 1e-6);
  }
  EXPECT_EQ(serve([&] {
              (void)sender_.send(R"({"format":"openxr","hand":"right","tracked":false})");
              return state_.joints_rad[4 + 1] == 0;
            }),
            "")
      << "at last it opens, so that it holds nothing";
  EXPECT_EQ(state_.grasp, 0);
  EXPECT_EQ(state_.position_m[0], fist.X_DH.p.x());
}

TEST_F(JointsTest, AHandThatNobodySendsIsNotReadyAndThenAFault) {
  ASSERT_EQ(open(",silence=0.4"), "");
  ASSERT_EQ(take(joints_text({})), "");
  const auto heard = std::chrono::steady_clock::now();
  ASSERT_EQ(serve([&] { return !ready(); }), "");
  EXPECT_GT(std::chrono::steady_clock::now() - heard, 90ms);
  EXPECT_EQ(state_.position_m[0], SeenHand().X_DH.p.x());
  EXPECT_NE(serve([] { return false; }), "it never came to this");
  EXPECT_GT(std::chrono::steady_clock::now() - heard, 400ms);
}

TEST_F(JointsTest, AnOvertakenHandIsDroppedAndANewSendersIsNot) {
  const auto hand_at = [](double x, int number) {
    SeenHand hand;
    hand.X_DH.p.x() = x;
    return joints_text(hand, "openxr", ",\"seq\":" + std::to_string(number));
  };
  ASSERT_EQ(open(), "");
  ASSERT_EQ(take(hand_at(0.5, 1000)), "");
  EXPECT_TRUE(sender_.send(hand_at(0.4, 999)));
  ASSERT_EQ(take(hand_at(0.3, 1000)), "");
  EXPECT_DOUBLE_EQ(state_.position_m[0], 0.5);
  ASSERT_EQ(serve([&] {
              EXPECT_TRUE(sender_.send(hand_at(0.2, 3)));
              return state_.position_m[0] != 0.5;
            }),
            "");
  EXPECT_DOUBLE_EQ(state_.position_m[0], 0.2);
}

TEST_F(JointsTest, TheOtherHandIsNotThisOne) {
  ASSERT_EQ(open(), "");
  SeenHand left = hand_of(true);
  left.X_DH.p.x() = 0.7;
  ASSERT_EQ(take(joints_text(left)), "");
  EXPECT_DOUBLE_EQ(state_.position_m[0], 0.1);
  driver_.close();
  EXPECT_NE(open(",wait=0.1", left).find("hand=left"), std::string::npos);
}

TEST_F(JointsTest, ItMeasuresTheHandWhileItsFingersAreStraight) {
  SeenHand hand;
  hand.build = {.hand_scale = 0.7, .finger_scale = {0.9, 1.1, 1, 1, 1.2}};
  const auto length_m = [&](std::size_t f) {
    const auto& own = hand.sizes[f].length_m;
    return hand.build.length_scale(hand::first_segment(f)) * (own[0] + own[1] + own[2]);
  };
  SeenHand fist = hand;
  for (std::size_t f = 1; f < MECHANE_FINGERS; ++f)
    for (std::size_t j = 1; j < 4; ++j)
      fist.joints_rad[4 * f + j] = 1;
  ASSERT_EQ(open("", fist), "");
  ASSERT_EQ(take(joints_text(fist)), "");
  EXPECT_NEAR(state_.palm_m, 0.7 * 0.0945, 1e-6);
  EXPECT_NEAR(state_.finger_m[0], length_m(0), 1e-6) << "the thumb is straight";
  EXPECT_EQ(state_.finger_m[1], 0) << "a tracker guesses at what a fist hides";
  ASSERT_EQ(take(joints_text(hand)), "");
  for (std::size_t f = 0; f < MECHANE_FINGERS; ++f)
    EXPECT_NEAR(state_.finger_m[f], length_m(f), 1e-6) << f;
  // A picture in which the tracker was mistaken does not count for much.
  for (int i = 0; i < 3; ++i)
    ASSERT_EQ(take(joints_text(hand)), "");
  SeenHand mistaken = hand;
  mistaken.build.finger_scale[1] = 0.8;
  ASSERT_EQ(take(joints_text(mistaken)), "");
  EXPECT_NEAR(state_.finger_m[1], length_m(1), 1e-6);
}

TEST_F(JointsTest, TheTrackerStandsWhereTheOptionsSay) {
  SeenHand hand;  // fingers to the right
  hand.X_DH.p = Vec3(0.1, 0.2, 0.3);
  ASSERT_EQ(open(",origin=1/-0.5/0,yaw=90"), "");
  ASSERT_EQ(take(joints_text(hand)), "");
  EXPECT_NEAR(state_.position_m[0], 1.3, 1e-9);
  EXPECT_NEAR(state_.position_m[1], -0.3, 1e-9);
  EXPECT_NEAR(state_.position_m[2], -0.1, 1e-9);
  EXPECT_NEAR(state_.orientation_wxyz[0], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(std::abs(state_.orientation_wxyz[2]), std::sqrt(0.5), 1e-6) << "fingers away from the visitor";
}

TEST_F(JointsTest, AFistAndAPinchGrasp) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(take(joints_text({})), "");
  EXPECT_NEAR(state_.grasp, 0, 1e-6);
  SeenHand fist;
  for (std::size_t f = 1; f < MECHANE_FINGERS; ++f)
    for (std::size_t k = 1; k < 4; ++k)
      fist.joints_rad[4 * f + k] = 1.6;
  ASSERT_EQ(take(joints_text(fist)), "");
  EXPECT_GT(state_.grasp, 0.9);
  SeenHand pinch;
  pinch.joints_rad = {-8 * kJointsDegree, 18 * kJointsDegree, 40 * kJointsDegree, 30 * kJointsDegree, 0,
                      64 * kJointsDegree, 44 * kJointsDegree, 24 * kJointsDegree};
  ASSERT_EQ(take(joints_text(pinch)), "");
  EXPECT_GT(state_.grasp, 0.9);
  ASSERT_EQ(take(joints_text(pinch, "openxr", ",\"pinch\":0.5")), "");
  EXPECT_NEAR(state_.grasp, 0.5, 1e-9) << "the tracker knows it better";
}

TEST_F(JointsTest, ASocketIsOneDriversAlone) {
  ASSERT_EQ(open(), "");
  DriverUnderTest second("joints");
  EXPECT_NE(second.open("socket=" + file_ + ",wait=0.1"), "");
  ASSERT_EQ(take(joints_text({})), "") << "the first one still has it";
  EXPECT_TRUE(ready());
  driver_.close();
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(JointsTest, ASocketThatWasLeftBehindIsReplacedAndAFileIsNot) {
  {
    const int dead = ::socket(AF_UNIX, SOCK_DGRAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    file_.copy(address.sun_path, sizeof(address.sun_path) - 1);
    ASSERT_EQ(::bind(dead, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    ::close(dead);
  }
  EXPECT_EQ(open(), "");
  const std::string kept = folder_.write("kept", "a text").string();
  DriverUnderTest second("joints");
  EXPECT_NE(second.open("socket=" + kept + ",wait=0.1"), "");
  EXPECT_TRUE(std::filesystem::is_regular_file(kept));
}

TEST_F(JointsTest, OptionsThatAreNotRightSaySo) {
  for (const char* options : {"wait=0.1", "origin=1/2", "origin=1/2/3/4", "origin=1/2/nan", "origin=1/2/1e9",
                              "origin=a/b/c", "hand=both", "port=0", "yaw=x"})
    EXPECT_NE(driver_.open(std::string(options) + ",socket=" + file_), "") << options;
  EXPECT_NE(driver_.open("port=9680,socket=" + file_), "");
  EXPECT_NE(driver_.open("socket=/no/such/folder/hand"), "");
  EXPECT_NE(driver_.open("socket=/" + std::string(200, 'a')), "");
}

/// A UDP port of an address that nobody has now.
class JointsPort {
 public:
  explicit JointsPort(const char* address, int port = 0) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = ::inet_addr(address);
    place.sin_port = htons(static_cast<std::uint16_t>(port));
    bound_ = ::bind(socket_, reinterpret_cast<const sockaddr*>(&place), sizeof(place)) == 0;
    socklen_t size = sizeof(place);
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&place), &size);
    number_ = ntohs(place.sin_port);
  }
  ~JointsPort() { ::close(socket_); }
  JointsPort(const JointsPort&) = delete;
  JointsPort& operator=(const JointsPort&) = delete;
  [[nodiscard]] bool bound() const { return bound_; }
  [[nodiscard]] int number() const { return number_; }

 private:
  int socket_;
  bool bound_ = false;
  int number_ = 0;
};

int free_joints_port() {
  return JointsPort("127.0.0.1").number();
}

TEST_F(JointsTest, AUdpPortIsOfTheLoopbackInterfaceAlone) {
  const int port = free_joints_port();
  const std::string options = "port=" + std::to_string(port);
  const JointsSender sender(port);
  ASSERT_EQ(sender.while_sending(joints_text({}), [&] { return driver_.open(options); }), "");
  ASSERT_TRUE(sender.send(joints_text({})));
  ASSERT_EQ(driver_.read(state_), "");
  EXPECT_TRUE(ready());
  EXPECT_TRUE(JointsPort("127.0.0.2", port).bound()) << "it listens at another address too";
  DriverUnderTest second("joints");
  EXPECT_NE(second.open(options).find("port"), std::string::npos);
}

/// A program that ends with its owner.
class JointsProgram {
 public:
  explicit JointsProgram(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    EXPECT_EQ(::posix_spawnp(&process_, arguments[0], nullptr, nullptr, arguments.data(), environ), 0);
  }
  ~JointsProgram() {
    if (process_ <= 0) return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }
  JointsProgram(const JointsProgram&) = delete;
  JointsProgram& operator=(const JointsProgram&) = delete;

 private:
  pid_t process_ = -1;
};

TEST_F(JointsTest, TheExampleSendsAHandThatOpensAndCloses) {
  const std::string port = std::to_string(free_joints_port());
  const std::string script = test::source_folder() / "client-sdk/examples/send_joints.py";
  const JointsProgram sender(
      {"python3", "-B", script, "--port", port, "--format", "mediapipe", "--hand", "left", "--rate", "100"});
  ASSERT_EQ(driver_.open("port=" + port + ",hand=left,wait=20"), "");
  double least = 1, most = 0;
  EXPECT_EQ(serve([&] {
              least = std::min(least, state_.grasp);
              most = std::max(most, state_.grasp);
              return least < 0.1 && most > 0.15;
            }),
            "");
  EXPECT_NEAR(state_.joints_rad[4], 0, 0.01);
  EXPECT_GT(state_.joints_rad[4 + 1], 0);
  EXPECT_GT(state_.joints_rad[3], 0);
  const auto& q = state_.orientation_wxyz;
  EXPECT_GT((Quat(q[0], q[1], q[2], q[3]) * Vec3::UnitY()).y(), 0.99) << "it lies palm down";
  EXPECT_LT((Quat(q[0], q[1], q[2], q[3]) * Vec3::UnitX()).z(), -0.99) << "its fingers point away from the visitor";
}

}  // namespace
}  // namespace mechane::drivers
