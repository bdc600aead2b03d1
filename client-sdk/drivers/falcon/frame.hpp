// What the Falcon's own program is told and answers: 16 bytes each way, '<', 14 bytes, '>'. A number of 16 bits is four
// bytes, 'A' plus a nibble, the lowest first. Source: libnifalcon, FalconFirmwareNovintSDK.h and .cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace mechane::drivers::falcon {

inline constexpr std::size_t kFrameBytes = 16;
inline constexpr int kMostMotor = 4095;  // Novint's own program sends no more

using Command = std::array<std::uint8_t, kFrameBytes>;

enum Light : unsigned { kRed = 2, kGreen = 4, kBlue = 8 };

/// Motors in the order of the legs, limited to kMostMotor. It also asks the board to look for the ends of the legs,
/// which public programs keep asking for: without it the board reports no leg as homed.
[[nodiscard]] Command command(const std::array<int, 3>& motors, unsigned lights) noexcept;

struct Answer {
  std::array<int, 3> counts{};  ///< of the legs' encoders
  unsigned buttons = 0;         ///< four
  unsigned homed = 0;           ///< a bit for each leg
  [[nodiscard]] bool all_homed() const noexcept { return homed == 7; }
};

/// Finds answers in bytes as they arrive. What does not fit is skipped to the next '<'. One thread; allocates nothing.
class Answers {
 public:
  void add(std::span<const std::uint8_t> bytes) noexcept;
  [[nodiscard]] const Answer& newest() const noexcept { return newest_; }
  /// How many so far.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// Whether bytes that belong to no answer came after the newest one.
  [[nodiscard]] bool noise() const noexcept { return noise_; }

 private:
  [[nodiscard]] bool fits(std::uint8_t byte) const noexcept;
  void take() noexcept;

  Command held_{};
  std::size_t size_ = 0;
  Answer newest_;
  std::uint64_t count_ = 0;
  bool noise_ = false;
};

}  // namespace mechane::drivers::falcon
