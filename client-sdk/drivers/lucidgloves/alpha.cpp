#include "client-sdk/drivers/lucidgloves/alpha.hpp"

#include <algorithm>
#include <bitset>
#include <charconv>
#include <cstdio>
#include <numbers>
#include <numeric>

namespace mechane::drivers {
namespace {

constexpr double kAlphaDegree = std::numbers::pi / 180;

// What a key stands for: the letters A .. Z, five splays, four joints of each finger, and all other keys.
constexpr std::size_t kSplays = 26;
constexpr std::size_t kJoints = kSplays + MECHANE_FINGERS;
constexpr std::size_t kOtherKey = kJoints + std::size_t{4} * MECHANE_FINGERS;
constexpr std::size_t kButtons = 'H' - 'A';
constexpr std::size_t kButtonCount = 8;
constexpr std::size_t kCalibrate = 7;  // the button O

struct Field {
  std::size_t slot = kOtherKey;
  bool has_value = false;
  int value = 0;
  bool is_info = false;
};

bool is_letter(char c) noexcept {
  return c >= 'A' && c <= 'Z';
}

/// A .. E are fingers: "(AB)" is the thumb's splay, "(BAC)" the index finger's third joint.
std::size_t slot_of(std::string_view key) noexcept {
  if (key.size() == 1) return static_cast<std::size_t>(key[0] - 'A');
  const auto finger = static_cast<std::size_t>(key[0] - 'A');
  if (finger >= MECHANE_FINGERS) return kOtherKey;
  if (key.size() == 2 && key[1] == 'B') return kSplays + finger;
  if (key.size() == 3 && key[1] == 'A' && key[2] <= 'D')
    return kJoints + 4 * finger + static_cast<std::size_t>(key[2] - 'A');
  return kOtherKey;
}

/// Takes a letter, or several in brackets, and the number behind from the front of `rest`. False: there is none.
bool take_field(std::string_view& rest, Field& field) noexcept {
  const bool bracket = rest.front() == '(';
  const std::size_t end = bracket ? rest.find(')') : 1;
  if (end == std::string_view::npos) return false;
  const std::string_view key = bracket ? rest.substr(1, end - 1) : rest.substr(0, 1);
  if (key.empty() || !std::all_of(key.begin(), key.end(), is_letter)) return false;
  field.slot = bracket && key.size() == 1 ? kOtherKey : slot_of(key);
  field.is_info = key.front() == 'Z';
  rest.remove_prefix(end + (bracket ? 1 : 0));
  unsigned short value = 0;  // no sign, at most 65535
  const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error == std::errc::result_out_of_range) return false;
  field.has_value = error == std::errc{};
  field.value = value;
  rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
  return true;
}

/// Whether a key has a number as it should: buttons are there or not, what is not known here is not judged.
bool is_whole(const Field& field) noexcept {
  if (field.slot >= kButtons && field.slot < kButtons + kButtonCount) return !field.has_value;
  const bool letter_with_value = field.slot <= 'G' - 'A' || field.slot == 'P' - 'A';
  return field.has_value || !(letter_with_value || (field.slot >= kSplays && field.slot < kOtherKey));
}

struct Draft {
  std::bitset<kOtherKey> seen;
  std::array<double, kOtherKey> share{};
};

double joint_share(const Draft& draft, std::size_t finger, std::size_t joint) noexcept {
  // Of four joints the thumb's last means nothing, and the fingers' first is inside the palm.
  const std::size_t slot = kJoints + 4 * finger + joint + (finger == 0 ? 0 : 1);
  return draft.share[draft.seen[slot] ? slot : finger];
}

AlphaHand hand_of(const Draft& draft, int full_scale) noexcept {
  AlphaHand hand;
  const int half_scale = full_scale / 2;  // as the firmware rounds it
  const double half = half_scale / static_cast<double>(full_scale);
  for (std::size_t f = 0; f < MECHANE_FINGERS; ++f) {
    hand.curl[f] = draft.share[f];
    hand.splay[f] = draft.seen[kSplays + f] ? 2 * draft.share[kSplays + f] - 1 : 0;
    for (std::size_t k = 0; k < 3; ++k)
      hand.flexion[f][k] = joint_share(draft, f, k);
  }
  for (std::size_t b = 0; b < kButtonCount; ++b)
    hand.buttons |= draft.seen[kButtons + b] ? 1u << b : 0u;
  hand.calibrated = (hand.buttons >> kCalibrate & 1u) == 0 &&
                    std::any_of(hand.curl.begin(), hand.curl.end(), [half](double curl) { return curl != half; });
  return hand;
}

}  // namespace

AlphaLine decode_alpha(std::string_view line, int full_scale, AlphaHand& hand) noexcept {
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (line.empty()) return AlphaLine::other;
  Draft draft;
  bool info = false;
  bool beyond = false;
  while (!line.empty()) {
    Field field;
    if (!take_field(line, field) || !is_whole(field)) return AlphaLine::malformed;
    info = info || field.is_info;
    if (field.slot == kOtherKey) continue;
    if (draft.seen[field.slot]) return AlphaLine::malformed;  // two lines in one: what was between them is lost
    draft.seen[field.slot] = true;
    draft.share[field.slot] = field.value / static_cast<double>(full_scale);
    beyond = beyond || field.value > full_scale;
  }
  if (info) return AlphaLine::other;
  for (std::size_t f = 0; f < MECHANE_FINGERS; ++f)
    if (!draft.seen[f]) return AlphaLine::malformed;
  if (beyond) return AlphaLine::beyond_range;
  hand = hand_of(draft, full_scale);
  return AlphaLine::hand;
}

void AlphaStream::add(std::string_view bytes) noexcept {
  for (const char c : bytes) {
    if (c == '\n')
      end_line();
    else if (size_ < line_.size())
      line_[size_++] = c;
    else
      size_ = line_.size() + 1;
  }
}

void AlphaStream::end_line() noexcept {
  const AlphaLine kind =
      size_ > line_.size() ? AlphaLine::malformed : decode_alpha({line_.data(), size_}, full_scale_, hand_);
  size_ = 0;
  if (kind == AlphaLine::hand) ++hands_;
  if (kind != AlphaLine::other) trouble_ = kind;
}

void place_joints(const AlphaHand& hand, double (&joints_rad)[MECHANE_HAND_JOINTS]) noexcept {
  constexpr std::array<double, 3> kThumb{15 * kAlphaDegree, 50 * kAlphaDegree, 80 * kAlphaDegree};
  constexpr std::array<double, 3> kFinger{90 * kAlphaDegree, 100 * kAlphaDegree, 90 * kAlphaDegree};
  constexpr double kSplay = 20 * kAlphaDegree;
  for (std::size_t f = 0; f < MECHANE_FINGERS; ++f) {
    const auto& range = f == 0 ? kThumb : kFinger;
    joints_rad[4 * f] = kSplay * hand.splay[f];
    for (std::size_t k = 0; k < 3; ++k)
      joints_rad[4 * f + 1 + k] = range[k] * hand.flexion[f][k];
  }
}

double grasp_of(const AlphaHand& hand) noexcept {
  return std::accumulate(hand.curl.begin() + 1, hand.curl.end(), 0.0) / (MECHANE_FINGERS - 1);
}

std::string_view encode_limits(const StringLimits& limits, AlphaText& text) noexcept {
  const int size = std::snprintf(text.data(), text.size(), "A%dB%dC%dD%dE%d\n", limits[0], limits[1], limits[2],
                                 limits[3], limits[4]);
  return {text.data(), std::min(static_cast<std::size_t>(size), text.size() - 1)};
}

}  // namespace mechane::drivers
