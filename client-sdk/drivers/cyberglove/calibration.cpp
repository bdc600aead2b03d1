#include "client-sdk/drivers/cyberglove/calibration.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace mechane::drivers {
namespace {

constexpr double kGloveDegree = std::numbers::pi / 180;
constexpr double kMostGain = 0.2;  // radians a step: full bend within ten steps
constexpr double kMostOffset = 1000;

// The record begins with the thumb; then the index finger.
constexpr std::size_t kThumbRoll = 0;
constexpr std::size_t kThumbMiddle = 1;
constexpr std::size_t kThumbOuter = 2;
constexpr std::size_t kThumbAbduction = 3;
constexpr std::size_t kIndex = 4;

/// With 18 sensors the fingers' outer joints have none.
std::size_t flexions(std::size_t sensors) noexcept {
  return sensors == kGloveSensors ? 3 : 2;
}

/// A finger's knuckle; its other joints follow, and then the abduction from the finger before. The index finger has no
/// abduction.
std::size_t first_sensor(std::size_t finger, std::size_t sensors) noexcept {
  const std::size_t joints = flexions(sensors);
  return finger == 1 ? kIndex : kIndex + joints + (finger - 2) * (joints + 1);
}

SensorGain nominal(double range_degrees, double offset) noexcept {
  return {range_degrees * kGloveDegree / 120, offset};
}

/// The line at the front of `text`, without its comment and its blanks.
std::string_view take_line(std::string_view& text) noexcept {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, std::min(text.find('#'), end));
  text.remove_prefix(std::min(end + 1, text.size()));
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
}

bool take_number(std::string_view& line, double most, double& number) noexcept {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  return error == std::errc{} && std::abs(number) <= most;  // false for what is not a number, too
}

}  // namespace

GloveCalibration::GloveCalibration(std::size_t sensors) noexcept : sensors_(sensors) {
  constexpr double kFlat = 70;
  constexpr double kSpread = 100;
  constexpr std::array<double, 3> kFinger{90, 100, 90};
  gains_.fill(nominal(45, kSpread));
  gains_[kThumbRoll] = nominal(45, kFlat);
  gains_[kThumbMiddle] = nominal(50, kFlat);
  gains_[kThumbOuter] = nominal(80, kFlat);
  for (std::size_t f = 1; f < MECHANE_FINGERS; ++f)
    for (std::size_t k = 0; k < flexions(sensors); ++k)
      gains_[first_sensor(f, sensors) + k] = nominal(kFinger[k], kFlat);
}

std::string GloveCalibration::take_text(std::string_view text) {
  std::array<SensorGain, kGloveSensors> gains{};
  std::size_t count = 0;
  for (int number = 1; !text.empty(); ++number) {
    std::string_view line = take_line(text);
    if (line.empty()) continue;
    if (count == sensors_)
      return "line " + std::to_string(number) + " is one more than the " + std::to_string(sensors_) + " sensors";
    SensorGain& gain = gains[count++];
    if (!take_number(line, kMostGain, gain.gain_rad) || line.empty() || !take_number(line, kMostOffset, gain.offset) ||
        !line.empty())
      return "line " + std::to_string(number) + " is not GAIN OFFSET, as in: 0.0131 70";
  }
  if (count < sensors_)
    return "it has lines for " + std::to_string(count) + " of " + std::to_string(sensors_) + " sensors";
  gains_ = gains;
  return {};
}

double GloveCalibration::angle(const GloveRecord& record, std::size_t sensor) const noexcept {
  return gains_[sensor].gain_rad * (record.sensors[sensor] - gains_[sensor].offset);
}

void GloveCalibration::place_joints(const GloveRecord& record,
                                    double (&joints_rad)[MECHANE_HAND_JOINTS]) const noexcept {
  const auto bend = [&](std::size_t sensor) {
    return std::clamp(angle(record, sensor), -45 * kGloveDegree, 135 * kGloveDegree);
  };
  const auto spread = [&](std::size_t sensor) {
    return std::clamp(angle(record, sensor), -90 * kGloveDegree, 90 * kGloveDegree);
  };
  joints_rad[0] = spread(kThumbAbduction);
  joints_rad[1] = bend(kThumbRoll);
  joints_rad[2] = bend(kThumbMiddle);
  joints_rad[3] = bend(kThumbOuter);
  for (std::size_t f = 1; f < MECHANE_FINGERS; ++f) {
    const std::size_t knuckle = first_sensor(f, sensors_);
    double* const joints = &joints_rad[4 * f];
    joints[1] = bend(knuckle);
    joints[2] = bend(knuckle + 1);
    joints[3] = flexions(sensors_) == 3 ? bend(knuckle + 2) : joints[2] * 2 / 3;
  }
  const auto from_neighbour = [&](std::size_t finger) {
    return spread(first_sensor(finger, sensors_) + flexions(sensors_));
  };
  joints_rad[4] = from_neighbour(2);
  joints_rad[8] = 0;
  joints_rad[12] = -from_neighbour(3);
  joints_rad[16] = joints_rad[12] - from_neighbour(4);
}

double grasp_of(const double (&joints_rad)[MECHANE_HAND_JOINTS]) noexcept {
  constexpr double kFist = (90 + 100 + 90) * kGloveDegree;
  double sum = 0;
  for (std::size_t f = 1; f < MECHANE_FINGERS; ++f)
    for (std::size_t k = 1; k < 4; ++k)
      sum += joints_rad[4 * f + k];
  return std::clamp(sum / (MECHANE_FINGERS - 1) / kFist, 0.0, 1.0);
}

}  // namespace mechane::drivers
