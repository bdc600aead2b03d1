// The driver of the CyberGlove against its box at the other end of a pseudo-terminal, its records and its calibration.
#include <chrono>
#include <fstream>
#include <functional>
#include <mutex>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <poll.h>

#include "client-sdk/drivers/cyberglove/calibration.hpp"
#include "client-sdk/drivers/cyberglove/record.hpp"
#include "tests/support/driver_under_test.hpp"
#include "tests/support/fake_serial_glove.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::drivers {
namespace {

using namespace std::chrono_literals;
using test::DriverUnderTest;

constexpr double kCyberDegree = std::numbers::pi / 180;
constexpr char kCyberFlat = 70;
constexpr char kCyberTogether = 100;  // neighbours that are not spread

/// A flat hand, by nominal gains.
std::string cyber_flat(std::size_t sensors) {
  std::string hand(sensors, kCyberFlat);
  for (const std::size_t at :
       sensors == 22 ? std::vector<std::size_t>{3, 10, 14, 18} : std::vector<std::size_t>{3, 8, 11, 14})
    hand[at] = kCyberTogether;
  return hand;
}

std::string cyber_record(const std::string& sensors, const std::string& tail = "") {
  return "S" + sensors + tail + std::string(1, '\0');
}

/// The box: echoes commands that are text, and streams while it has been told to.
class CyberBox {
 public:
  explicit CyberBox(std::string sensors, int deaf_to_starts = 0)
      : sensors_(std::move(sensors)), deaf_to_starts_(deaf_to_starts) {}

  [[nodiscard]] const std::string& port() const { return line_.port(); }
  void unplug() { line_.unplug(); }
  void sends(const std::string& sensors, const std::string& tail = "") {
    const std::lock_guard lock(mutex_);
    sensors_ = sensors;
    tail_ = tail;
  }
  /// From now on each so many-th byte is lost on the way.
  void loses_one_in(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    loses_one_in_ = bytes;
  }
  [[nodiscard]] bool heard(const std::string& text) const {
    const std::lock_guard lock(mutex_);
    return heard_.find(text) != std::string::npos;
  }
  [[nodiscard]] bool streams() const {
    const std::lock_guard lock(mutex_);
    return streams_;
  }
  [[nodiscard]] int records() const {
    const std::lock_guard lock(mutex_);
    return records_;
  }

 private:
  std::string step(std::string_view heard) {
    const std::lock_guard lock(mutex_);
    heard_ += heard;
    std::string out;
    for (const char c : heard) {
      if (c == '\x03')
        streams_ = false;
      else if (c == 'S')
        streams_ = deaf_to_starts_-- <= 0;
      else
        out += c;
    }
    if (!streams_ || sensors_.empty()) return out;
    ++records_;
    return lossy(out + cyber_record(sensors_, tail_));
  }
  std::string lossy(const std::string& out) {
    if (loses_one_in_ == 0) return out;
    std::string rest;
    for (const char c : out)
      if (++sent_ % loses_one_in_ != 0) rest += c;
    return rest;
  }

  mutable std::mutex mutex_;  // the box's thread and the test's
  std::string sensors_;
  std::string tail_;
  std::string heard_;
  int deaf_to_starts_;
  bool streams_ = false;
  int records_ = 0;
  std::size_t loses_one_in_ = 0;
  std::size_t sent_ = 0;
  test::FakeSerialGlove line_{[this](std::string_view heard) { return step(heard); }};  // last: it calls the others
};

class CyberGloveTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string open(const CyberBox& box, const std::string& more = "", const char* wait_s = "1") {
    return driver_.open("port=" + box.port() + ",wait=" + wait_s + more);
  }
  /// Reads and writes in turn until `done`, or a fault.
  [[nodiscard]] std::string serve(const std::function<bool()>& done) {
    const auto until = std::chrono::steady_clock::now() + 5s;
    while (!done()) {
      if (std::chrono::steady_clock::now() > until) return "it never came to this";
      if (std::string fault = driver_.read(state_); !fault.empty()) return fault;
      if (std::string fault = driver_.write({}); !fault.empty()) return fault;
      ::poll(nullptr, 0, 1);
    }
    return {};
  }

  DriverUnderTest driver_{"cyberglove"};
  mechane_device_state state_{};
};

TEST_F(CyberGloveTest, TheDeviceIsAGloveThatOnlyReads) {
  const CyberBox box(cyber_flat(22));
  ASSERT_EQ(open(box), "");
  mechane_device_info info;
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_EQ(info.hand, MECHANE_HAND_GLOVE);
  EXPECT_EQ(info.output, MECHANE_OUTPUT_NONE);
  EXPECT_NE(std::string(info.name).find("not calibrated"), std::string::npos);
  EXPECT_TRUE(box.heard("t 1152 1\r")) << "100 a second";
  ASSERT_EQ(driver_.read(state_), "");
  EXPECT_EQ(state_.flags, MECHANE_STATE_READY);
  for (const double angle : state_.joints_rad)
    EXPECT_NEAR(angle, 0, 1e-9);
  EXPECT_EQ(state_.grasp, 0);
}

TEST_F(CyberGloveTest, AFistIsClosedWithEitherNumberOfSensors) {
  for (const std::size_t sensors : {std::size_t{22}, std::size_t{18}}) {
    std::string fist = cyber_flat(sensors);
    for (char& c : fist)
      if (c == kCyberFlat) c = static_cast<char>(190);
    const CyberBox box(fist);
    DriverUnderTest driver("cyberglove");
    ASSERT_EQ(driver.open("port=" + box.port() + ",sensors=" + std::to_string(sensors)), "");
    ASSERT_EQ(driver.read(state_), "");
    EXPECT_NEAR(state_.joints_rad[4 + 1], 90 * kCyberDegree, 1e-9);
    EXPECT_NEAR(state_.joints_rad[16 + 2], 100 * kCyberDegree, 1e-9);
    EXPECT_NEAR(state_.joints_rad[16 + 3], (sensors == 22 ? 90 : 200.0 / 3) * kCyberDegree, 1e-9);
    EXPECT_NEAR(state_.joints_rad[2], 50 * kCyberDegree, 1e-9);
    EXPECT_GT(state_.grasp, 0.9);
  }
}

TEST_F(CyberGloveTest, ACalibrationIsTakenFromAFile) {
  const test::ScratchFolder folder;
  const std::string file = (folder.path() / "visitor.txt").string();
  const CyberBox box(cyber_flat(18));
  std::ofstream(file) << "# roll\n"
                      << "0.01 20\r\n";
  EXPECT_NE(open(box, ",sensors=18,calibration=" + file), "") << "one line of 18";
  std::ofstream text(file);
  for (int sensor = 0; sensor < 18; ++sensor)
    text << "0.01 20   # of sensor " << sensor << "\n\n";
  text.close();
  ASSERT_EQ(open(box, ",sensors=18,hand=left,calibration=" + file), "");
  ASSERT_EQ(driver_.read(state_), "");
  EXPECT_NEAR(state_.joints_rad[5], 0.01 * (70 - 20), 1e-9);
  mechane_device_info info;
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_EQ(info.side, MECHANE_HAND_LEFT);
  EXPECT_EQ(std::string(info.name).find("not calibrated"), std::string::npos);
}

TEST_F(CyberGloveTest, ClosingStopsTheStream) {
  const CyberBox box(cyber_flat(22));
  ASSERT_EQ(open(box), "");
  EXPECT_TRUE(box.streams());
  driver_.close();
  const auto until = std::chrono::steady_clock::now() + 5s;
  while (box.streams() && std::chrono::steady_clock::now() < until)
    ::poll(nullptr, 0, 1);
  EXPECT_FALSE(box.streams());
}

TEST_F(CyberGloveTest, ABoxThatWasBusyIsToldAgain) {
  const CyberBox box(cyber_flat(22), 1);
  EXPECT_EQ(open(box), "");
}

TEST_F(CyberGloveTest, TornRecordsAreLeftOut) {
  std::string hand(22, 'S');  // each byte looks like the beginning of a record
  for (std::size_t sensor = 0; sensor < hand.size(); sensor += 2)
    hand[sensor] = static_cast<char>(75 + sensor);
  CyberBox box(hand);
  ASSERT_EQ(open(box), "");
  ASSERT_EQ(driver_.read(state_), "");
  const mechane_device_state whole = state_;
  for (const std::size_t bytes : {std::size_t{40}, std::size_t{50}}) {
    box.loses_one_in(bytes);
    const int before = box.records();
    EXPECT_EQ(serve([&] {
                for (std::size_t k = 0; k < MECHANE_HAND_JOINTS; ++k)
                  EXPECT_EQ(state_.joints_rad[k], whole.joints_rad[k]) << k;
                return HasFailure() || box.records() > before + 30;
              }),
              "");
  }
}

TEST_F(CyberGloveTest, AGloveThatFallsSilentIsAFault) {
  CyberBox box(cyber_flat(22));
  ASSERT_EQ(open(box), "");
  box.sends("");
  const auto silent = std::chrono::steady_clock::now();
  EXPECT_NE(serve([] { return false; }).find("sends nothing"), std::string::npos);
  EXPECT_GT(std::chrono::steady_clock::now() - silent, 50ms);
  EXPECT_LT(std::chrono::steady_clock::now() - silent, 2s);
}

TEST_F(CyberGloveTest, ABoxWithoutItsGloveIsAFault) {
  CyberBox box(cyber_flat(22));
  ASSERT_EQ(open(box), "");
  box.sends(cyber_flat(22), "eseg");
  EXPECT_NE(serve([] { return false; }).find("no glove"), std::string::npos);
}

TEST_F(CyberGloveTest, ABoxThatIsPulledOutIsAFault) {
  CyberBox box(cyber_flat(22));
  ASSERT_EQ(open(box), "");
  box.unplug();
  EXPECT_NE(serve([] { return false; }), "it never came to this");
}

TEST_F(CyberGloveTest, AnotherNumberOfSensorsIsNoticed) {
  const CyberBox box(cyber_flat(18));
  EXPECT_NE(open(box, "", "0.2").find("sensors"), std::string::npos);
}

TEST_F(CyberGloveTest, WhatCannotBeOpenedSaysSo) {
  const CyberBox mute("");
  const std::string port = "port=" + mute.port();
  EXPECT_NE(driver_.open(port + ",wait=0.1"), "");
  EXPECT_NE(driver_.open(port + ",sensors=20"), "");
  EXPECT_NE(driver_.open(port + ",calibration=/no/such/file"), "");
  EXPECT_NE(driver_.open(port + ",calibration=/"), "");
  EXPECT_NE(driver_.open("port=/dev/no-such-port"), "");
}

TEST_F(CyberGloveTest, OneGloveIsOneProgramsAlone) {
  const CyberBox box(cyber_flat(22));
  ASSERT_EQ(open(box), "");
  DriverUnderTest second("cyberglove");
  EXPECT_NE(second.open("port=" + box.port()), "");
}

TEST(CyberRecords, AreTheSameHoweverTheirBytesArrive) {
  const std::string hand = cyber_flat(18);
  std::string bad_sensor = hand;
  bad_sensor[7] = '\0';
  const std::string bytes = "t 1152 1\r\nS" + cyber_record(hand) + cyber_record(hand.substr(1)) + std::string(2, '\0') +
                            cyber_record(hand, "es") + cyber_record(bad_sensor) + cyber_record(hand, "e") +
                            cyber_record(hand, "eg") + cyber_record(hand, "esesesg") + cyber_record(hand + "x") + "S" +
                            hand;
  for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
    GloveRecords records(18);
    for (std::size_t at = 0; at < bytes.size(); at += piece)
      records.add(std::string_view(bytes).substr(at, piece));
    EXPECT_EQ(records.count(), 3u) << piece;
    EXPECT_TRUE(records.newest().unplugged);
    EXPECT_TRUE(records.noise());
    records.add(std::string(1, '\0'));
    EXPECT_EQ(records.count(), 4u) << piece;
    EXPECT_FALSE(records.newest().unplugged);
    EXPECT_FALSE(records.noise());
  }
}

TEST(CyberRecords, TheStreamFitsIntoTheLine) {
  EXPECT_NE(start_commands(115200, 22).find("t 1152 1\r"), std::string::npos);
  EXPECT_NE(start_commands(9600, 22).find("t 3840 1\r"), std::string::npos) << "30 records of 24 bytes in 960";
}

TEST(CyberCalibration, EachSensorMovesItsOwnJoint) {
  // Thumb: roll, middle, outer, abduction; then each finger's joints, and its abduction from the finger before.
  const std::vector<int> joints = {1, 2, 3, 0, 5, 6, 7, 9, 10, 11, 4, 13, 14, 15, 12, 17, 18, 19, 16, -1, -1, -1};
  const GloveCalibration calibration(22);
  GloveRecord flat;
  const std::string bytes = cyber_flat(22);
  std::copy(bytes.begin(), bytes.end(), flat.sensors.begin());
  for (std::size_t sensor = 0; sensor < 22; ++sensor) {
    GloveRecord bent = flat;
    bent.sensors[sensor] = static_cast<std::uint8_t>(bent.sensors[sensor] + 60);
    double angles[MECHANE_HAND_JOINTS] = {};
    calibration.place_joints(bent, angles);
    for (int joint = 0; joint < MECHANE_HAND_JOINTS; ++joint) {
      const bool little_goes_with_ring = sensor == 14 && joint == 16;
      if (joint != joints[sensor] && !little_goes_with_ring)
        EXPECT_NEAR(angles[joint], 0, 1e-12) << sensor;
      else if (sensor == 14 || sensor == 18)
        EXPECT_LT(angles[joint], -0.3) << "away from the thumb";
      else
        EXPECT_GT(angles[joint], 0.3) << sensor;
    }
  }
}

TEST(CyberCalibration, AFileThatIsNotRightChangesNothing) {
  GloveCalibration calibration(18);
  std::string lines;
  for (int sensor = 0; sensor < 17; ++sensor)
    lines += "-0.02 100\n";
  for (const char* last :
       {"", "0.01", "0.01 70 3", "nan 70", "0.01 inf", "0.3 70", "0.01 1e9", "x 70", "0.01 70\n0.01 70"})
    EXPECT_NE(calibration.take_text(lines + last), "") << last;
  GloveRecord record;
  record.sensors.fill(70);
  double angles[MECHANE_HAND_JOINTS] = {};
  calibration.place_joints(record, angles);
  EXPECT_NEAR(angles[5], 0, 1e-12);
  EXPECT_EQ(calibration.take_text(lines + "\t0.2 -1000"), "");
  calibration.place_joints(record, angles);
  EXPECT_NEAR(angles[5], 0.6, 1e-12);
}

}  // namespace
}  // namespace mechane::drivers
