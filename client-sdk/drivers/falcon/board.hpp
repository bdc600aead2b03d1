// The Falcon's board behind its USB bridge: loading its program, and exchanging frames with it. Source: libnifalcon,
// FalconCommLibUSB.cpp, FalconCommLibFTDI.cpp and FalconFirmware.cpp, and its issue 9 (clear to send).
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "client-sdk/drivers/falcon/frame.hpp"
#include "client-sdk/drivers/falcon/ftdi.hpp"

namespace mechane::drivers::falcon {

/// Open from open() until it goes. One thread. A call returns a fault in words for a person, or an empty text. send()
/// and receive() wait for USB, 0.1 s at most, and allocate nothing here; libusb allocates for every transfer.
class Board {
 public:
  using Clock = std::chrono::steady_clock;

  Board() = default;
  ~Board();
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  /// The Falcon of that index, by libftdi from `library` (empty: the installed one).
  [[nodiscard]] std::string open(const std::string& library, unsigned index);
  /// Whether the board's program runs already: it stays until the power goes. A command without force is all that is
  /// sent.
  [[nodiscard]] std::string look(bool& runs);
  /// Loads the program and starts it, with several tries, for uploads fail now and then for no known reason. 25 s at
  /// most.
  [[nodiscard]] std::string start(std::span<const std::uint8_t> image);

  [[nodiscard]] bool is_open() const noexcept { return open_; }
  [[nodiscard]] std::string send(const Command& command);
  /// Waits a little for an answer and adds what has come to `answers`; that may be nothing.
  [[nodiscard]] std::string receive(Answers& answers);

 private:
  std::string look(bool& runs, int looks);
  std::string upload(std::span<const std::uint8_t> image, Clock::time_point until);
  std::string greet();
  std::string transfer(std::span<const std::uint8_t> image, Clock::time_point until);
  std::string hear(std::string_view expected, std::chrono::milliseconds wait, bool& heard);
  void wait_until_clear() const;
  std::string write(std::span<const std::uint8_t> bytes);
  std::string read(std::span<std::uint8_t> into, std::size_t& got);
  [[nodiscard]] std::string failed(const std::string& what) const;

  Ftdi ftdi_;
  FtdiContext* context_ = nullptr;
  bool open_ = false;
  bool due_ = false;  // a command waits for its answer
  Clock::time_point drain_until_{};
};

}  // namespace mechane::drivers::falcon
