// A serial line, as gloves have it: raw bytes, 8 data bits, no parity, one stop bit.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace mechane::drivers {

/// Open from open() until it goes. No call waits. One thread. Faults are in words for a person, empty when there is none.
class SerialPort {
 public:
  SerialPort() = default;
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// For this program alone. Faults: no such file, no right to it, in use, not a serial line, no such speed.
  [[nodiscard]] std::string open(const std::string& file, int baud);
  /// What has arrived, at most the size of `into`; `got` is 0 when nothing has. Fault: the line is gone.
  [[nodiscard]] std::string read(std::span<char> into, std::size_t& got);
  /// Whole texts in order; while the line has not taken all of one, those that follow are dropped. Fault: the line is gone.
  [[nodiscard]] std::string write(std::string_view text);

 private:
  int file_ = -1;
  std::string name_;
  std::string rest_;  // of a text that the line has not taken yet
};

}  // namespace mechane::drivers
