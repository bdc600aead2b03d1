#include "client-sdk/drivers/playback/recording.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

namespace mechane::drivers {
namespace {

constexpr std::size_t kPointNumbers = 10;
constexpr std::size_t kGloveNumbers = kPointNumbers + MECHANE_HAND_JOINTS;
constexpr double kWorldReachM = 100;  // of a world
constexpr double kMostButtons = 4294967295.0;

/// The numbers of a line; false when there is something else in it, or more than fit.
bool read_numbers(std::string_view line, std::array<double, kGloveNumbers>& numbers, std::size_t& count) {
  count = 0;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty()) return true;
    if (count == numbers.size()) return false;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), numbers[count]);
    if (error != std::errc{} || !std::isfinite(numbers[count++])) return false;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  }
}

/// What is wrong with the numbers; empty: nothing.
const char* fault_of(std::span<const double> n) {
  const double squared = n[4] * n[4] + n[5] * n[5] + n[6] * n[6] + n[7] * n[7];
  if (!std::all_of(n.begin() + 1, n.begin() + 4, [](double p) { return std::abs(p) <= kWorldReachM; }))
    return "a position over 100 m";
  if (!(squared > 0.99 && squared < 1.01)) return "a rotation that is not a unit quaternion";
  if (n[8] < 0 || n[8] > 1) return "a grasp outside 0 to 1";
  if (n[9] < 0 || n[9] > kMostButtons || n[9] != std::floor(n[9]))
    return "buttons that are not a whole number, or out of range";
  return "";
}

RecordedHand hand_of(std::span<const double> n) {
  RecordedHand hand;
  hand.t_s = n[0];
  std::copy_n(&n[1], 3, hand.state.position_m);
  std::copy_n(&n[4], 4, hand.state.orientation_wxyz);
  hand.state.grasp = n[8];
  hand.state.buttons = static_cast<std::uint32_t>(n[9]);
  hand.state.temperature = -1;
  if (n.size() == kGloveNumbers) std::copy_n(&n[kPointNumbers], MECHANE_HAND_JOINTS, hand.state.joints_rad);
  return hand;
}

template <std::size_t n>
void mix(const double (&a)[n], const double (&b)[n], double share, double (&out)[n]) {
  for (std::size_t i = 0; i < n; ++i)
    out[i] = a[i] + share * (b[i] - a[i]);
}

/// The shorter way round, at a speed that is even enough for samples some milliseconds apart.
void turn(const double (&a)[4], const double (&b)[4], double share, double (&out)[4]) {
  const double same = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  double squared = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    out[i] = a[i] + share * ((same < 0 ? -b[i] : b[i]) - a[i]);
    squared += out[i] * out[i];
  }
  for (double& part : out)
    part /= std::sqrt(squared);
}

}  // namespace

std::string HandRecording::take_text(std::string_view text) {
  std::size_t columns = 0;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos || line.front() == '#') continue;
    if (line == "left" && hands.empty()) {
      is_left = true;
      continue;
    }
    const std::string where = "line " + std::to_string(number) + " ";
    std::array<double, kGloveNumbers> numbers{};
    std::size_t count = 0;
    if (!read_numbers(line, numbers, count) || (count != kPointNumbers && count != kGloveNumbers))
      return where + "is not 10 numbers, or 30 for a glove";
    if (columns != 0 && count != columns) return where + "has not as many numbers as the lines before";
    columns = count;
    const std::span<const double> row(numbers.data(), count);
    if (const char* fault = fault_of(row); *fault != 0) return where + "has " + fault;
    if (!hands.empty() && !(row[0] > hands.back().t_s)) return where + "is not later than the line before";
    hands.push_back(hand_of(row));
  }
  is_glove = columns == kGloveNumbers;
  return hands.empty() ? "there is no hand in it" : "";
}

mechane_device_state HandRecording::at(double t_s) const noexcept {
  const double t = hands.front().t_s + t_s;
  const auto after = std::upper_bound(hands.begin(), hands.end(), t,
                                      [](double time, const RecordedHand& hand) { return time < hand.t_s; });
  if (after == hands.begin()) return hands.front().state;
  const RecordedHand& a = *(after - 1);
  if (after == hands.end()) return a.state;
  const double share = (t - a.t_s) / (after->t_s - a.t_s);
  mechane_device_state state = a.state;
  mix(a.state.position_m, after->state.position_m, share, state.position_m);
  mix(a.state.joints_rad, after->state.joints_rad, share, state.joints_rad);
  turn(a.state.orientation_wxyz, after->state.orientation_wxyz, share, state.orientation_wxyz);
  state.grasp = a.state.grasp + share * (after->state.grasp - a.state.grasp);
  return state;
}

}  // namespace mechane::drivers
