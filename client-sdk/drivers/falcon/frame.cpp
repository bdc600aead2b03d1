#include "client-sdk/drivers/falcon/frame.hpp"

#include <algorithm>

namespace mechane::drivers::falcon {
namespace {

constexpr unsigned kHoming = 1;
constexpr std::size_t kSwitches = 13;  // the byte with buttons and homed legs, or with lights and homing

}  // namespace

Command command(const std::array<int, 3>& motors, unsigned lights) noexcept {
  Command bytes;
  bytes.fill('A');
  bytes.front() = '<';
  bytes.back() = '>';
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const auto word = static_cast<unsigned>(std::clamp(motors[leg], -kMostMotor, kMostMotor));
    for (std::size_t nibble = 0; nibble < 4; ++nibble)
      bytes[1 + 4 * leg + nibble] = static_cast<std::uint8_t>('A' + ((word >> (4 * nibble)) & 0xFu));
  }
  bytes[kSwitches] = static_cast<std::uint8_t>('A' + ((lights & (kRed | kGreen | kBlue)) | kHoming));
  return bytes;
}

void Answers::add(std::span<const std::uint8_t> bytes) noexcept {
  for (const std::uint8_t byte : bytes) {
    if (byte == '<' || !fits(byte)) {  // '<' fits nowhere else: a new answer begins
      noise_ = noise_ || byte != '<' || size_ != 0;
      size_ = 0;
      if (byte != '<') continue;
    }
    held_[size_++] = byte;
    if (size_ == kFrameBytes) take();
  }
}

bool Answers::fits(std::uint8_t byte) const noexcept {
  if (size_ == 0) return byte == '<';
  if (size_ < kSwitches) return byte >= 'A' && byte <= 'P';
  if (size_ == kSwitches) return byte >= 'A' && byte <= 'A' + 0x7F;
  if (size_ == kSwitches + 1) return byte != '<' && byte != '>';  // nobody knows what it is for
  return byte == '>';
}

void Answers::take() noexcept {
  for (std::size_t leg = 0; leg < 3; ++leg) {
    unsigned word = 0;
    for (std::size_t nibble = 4; nibble-- > 0;)
      word = word << 4 | static_cast<unsigned>(held_[1 + 4 * leg + nibble] - 'A');
    newest_.counts[leg] = static_cast<std::int16_t>(word);
  }
  const auto switches = static_cast<unsigned>(held_[kSwitches] - 'A');
  newest_.buttons = switches & 0xFu;
  newest_.homed = switches >> 4 & 7u;
  size_ = 0;
  noise_ = false;
  ++count_;
}

}  // namespace mechane::drivers::falcon
