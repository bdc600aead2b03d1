#include "client-sdk/drivers/cyberglove/record.hpp"

#include <algorithm>

namespace mechane::drivers {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr std::size_t kWarnings = 2;  // sampling too fast, and no glove

}  // namespace

void GloveRecords::add(std::string_view bytes) noexcept {
  for (const char c : bytes) {
    held_[size_++] = static_cast<std::uint8_t>(c);
    for (std::size_t length = record_length(); size_ > 0 && length != 0; length = record_length()) {
      if (length == kNone) {
        noise_ = true;
        const auto* const next = std::find(held_.begin() + 1, held_.begin() + size_, 'S');
        drop(static_cast<std::size_t>(next - held_.begin()));
      } else {
        take_record(length);
      }
    }
  }
}

std::size_t GloveRecords::record_length() const noexcept {
  if (size_ > 0 && held_[0] != 'S') return kNone;
  const auto* const end = std::find(held_.begin(), held_.begin() + size_, 0);
  const auto length = static_cast<std::size_t>(end - held_.begin());
  if (length < size_ && length < 1 + sensors_) return kNone;  // the 0 comes too early
  for (std::size_t at = 1 + sensors_, warnings = 0; at < size_; at += 2, ++warnings) {
    if (held_[at] == 0) return at + 1;
    if (held_[at] != 'e' || warnings == kWarnings) return kNone;
    if (at + 1 < size_ && held_[at + 1] == 0) return kNone;
  }
  return 0;
}

void GloveRecords::drop(std::size_t bytes) noexcept {
  std::copy(held_.begin() + bytes, held_.begin() + size_, held_.begin());
  size_ -= bytes;
}

void GloveRecords::take_record(std::size_t length) noexcept {
  newest_ = {};
  std::copy_n(held_.begin() + 1, sensors_, newest_.sensors.begin());
  for (std::size_t at = 1 + sensors_; held_[at] == 'e'; at += 2)
    newest_.unplugged = newest_.unplugged || held_[at + 1] == 'g';
  ++count_;
  noise_ = false;
  drop(length);
}

std::string start_commands(int baud, std::size_t sensors) {
  constexpr int kTicks = 115200;  // a second in the glove's unit, whatever the baud
  const int bytes_per_second = baud / 10 * 3 / 4;
  const int rate_hz = std::min(100, bytes_per_second / static_cast<int>(sensors + 2));
  return "\x03"
         "f 0\ru 0\rl 1\rt " +
         std::to_string(kTicks / std::max(rate_hz, 1)) + " 1\rS";
}

}  // namespace mechane::drivers
