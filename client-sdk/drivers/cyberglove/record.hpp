// What a CyberGlove sends and is told over its serial line. A record is 'S', a byte for each sensor, 1 .. 255, and a 0;
// between the last sensor and the 0 the box may put 'e' with a letter for what is wrong. Sources: Shadow Robot's
// cyberglove package, serial_glove; asr-ros/asr_cyberglove_lib, gloveDevice.cc; toon, Cyberglove.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace mechane::drivers {

inline constexpr std::size_t kGloveSensors = 22;

struct GloveRecord {
  std::array<std::uint8_t, kGloveSensors> sensors{};  ///< in the glove's order; as many as it has
  bool unplugged = false;                             ///< "eg": the box has no glove
};

/// Finds the records in bytes as they arrive. When a byte is lost or added, the record's 0 comes at the wrong place:
/// the record is skipped, and the next 'S' that fits begins a new one. One thread; allocates nothing.
class GloveRecords {
 public:
  /// `sensors`: 18 or 22.
  explicit GloveRecords(std::size_t sensors) noexcept : sensors_(sensors) {}

  void add(std::string_view bytes) noexcept;

  [[nodiscard]] const GloveRecord& newest() const noexcept { return newest_; }
  /// How many so far.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// Whether bytes that belong to no record came after the newest one.
  [[nodiscard]] bool noise() const noexcept { return noise_; }

 private:
  /// The length of the record at the front; 0 while it is incomplete; the largest number when the bytes are not a record.
  [[nodiscard]] std::size_t record_length() const noexcept;
  void drop(std::size_t bytes) noexcept;
  void take_record(std::size_t length) noexcept;

  std::size_t sensors_;
  std::array<std::uint8_t, 32> held_{};  // a record has 28 bytes at most
  std::size_t size_ = 0;
  GloveRecord newest_;
  std::uint64_t count_ = 0;
  bool noise_ = false;
};

/// Stops a stream, switches the filter and the status byte off and the light on, and starts a stream of 100 records a
/// second, or fewer on a slow line: they fill at most three quarters of it.
[[nodiscard]] std::string start_commands(int baud, std::size_t sensors);
/// Stops the stream and switches the light off.
inline constexpr std::string_view kStopCommands = "\x03l 0\r";

}  // namespace mechane::drivers
