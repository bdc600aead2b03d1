#include "client-sdk/drivers/falcon/board.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace mechane::drivers::falcon {
namespace {

using namespace std::chrono_literals;

constexpr int kFtdiVendor = 0x0403, kFalcon = 0xCB48;
constexpr int kFreshTimeout_ms = 5000, kTimeout_ms = 100;  // of libftdi, and ours
constexpr int kRunBaud = 1'500'000, kGreetBaud = 9600, kLoadBaud = 140'000;
constexpr unsigned char kRunLatency_ms = 1, kLoadLatency_ms = 16;  // with a shorter one the greeting fails
constexpr std::string_view kGreeting = "\x0A\x43\x0D", kGreetingBack = "\x0A\x44\x2C\x0D", kReady = "A";
constexpr std::size_t kPiece = 62;  // a USB packet of the bridge, less its two bytes of modem status
constexpr int kLooks = 3, kLooksAfterUpload = 10, kGreetings = 8, kUploads = 5;
constexpr auto kLookWait = 20ms, kGreetingWait = 40ms, kReadyWait = 100ms, kPieceWait = 100ms;
constexpr auto kClearWait = 50ms, kAnswerWait = 5ms, kDrain = 100ms;
constexpr auto kUploadTime = 22s;  // driver.h gives open() 30 s
constexpr const char* kCheckPlug =
    ". Check its power and cable, that no other program uses it, and this user's right to the USB device 0403:cb48";

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

Board::~Board() {
  if (open_) (void)ftdi_.close(context_);
  if (context_ != nullptr) ftdi_.free(context_);
}

std::string Board::open(const std::string& library, unsigned index) {
  if (std::string fault = load(ftdi_, library); !fault.empty()) return fault;
  context_ = ftdi_.make();
  if (context_ == nullptr)
    return "libftdi does not start; is USB switched on in this computer, and is there memory left?";
  if (context_->read_timeout_ms != kFreshTimeout_ms || context_->write_timeout_ms != kFreshTimeout_ms)
    return "libftdi is of a version that this driver does not know. Give libftdi 1.5 as library=PATH";
  context_->read_timeout_ms = context_->write_timeout_ms = kTimeout_ms;
  if (ftdi_.open(context_, kFtdiVendor, kFalcon, nullptr, nullptr, index) < 0)
    return failed("Falcon " + std::to_string(index) + " does not open") + kCheckPlug;
  open_ = true;
  return {};
}

std::string Board::look(bool& runs) {
  return look(runs, kLooks);
}

std::string Board::look(bool& runs, int looks) {
  runs = false;
  if (ftdi_.latency(context_, kRunLatency_ms) < 0 || ftdi_.line(context_, 8, 0, 0) < 0 ||
      ftdi_.flow_control(context_, 0) < 0 || ftdi_.baud_rate(context_, kRunBaud) < 0 || ftdi_.flush(context_) < 0)
    return failed("the Falcon's USB bridge does not take its settings") + kCheckPlug;
  Answers answers;
  for (int look = 0; look < looks && !runs; ++look) {
    if (std::string fault = send(command({}, kRed)); !fault.empty()) return fault;
    const auto until = Clock::now() + kLookWait;
    do {
      if (std::string fault = receive(answers); !fault.empty()) return fault;
      runs = answers.count() > 0;
    } while (!runs && Clock::now() < until);
  }
  return {};
}

std::string Board::start(std::span<const std::uint8_t> image) {
  const auto until = Clock::now() + kUploadTime;
  std::string fault = "there was no time";
  int tries = 0;
  while (tries < kUploads && Clock::now() < until) {
    ++tries;
    fault = upload(image, until);
    if (fault.empty()) return {};
  }
  return "the Falcon did not take its firmware in " + std::to_string(tries) + " tries. In the last one " + fault +
         ". Plug it into another USB socket, without a hub or with one, switch it off and on, and start again";
}

std::string Board::upload(std::span<const std::uint8_t> image, Clock::time_point until) {
  if (std::string fault = greet(); !fault.empty()) return fault;
  if (std::string fault = transfer(image, until); !fault.empty()) return fault;
  bool runs = false;
  if (std::string fault = look(runs, kLooksAfterUpload); !fault.empty()) return fault;
  return runs ? "" : "it took the whole file and does not run it: is the option firmware right?";
}

/// Stops what runs on the board, and has it wait for a program.
std::string Board::greet() {
  if (ftdi_.reset(context_) < 0 || ftdi_.flush(context_) < 0 || ftdi_.latency(context_, kLoadLatency_ms) < 0 ||
      ftdi_.baud_rate(context_, kGreetBaud) < 0 || ftdi_.line(context_, 8, 0, 0) < 0 ||
      ftdi_.flow_control(context_, 0) < 0 || ftdi_.rts(context_, 0) < 0 || ftdi_.dtr(context_, 0) < 0 ||
      ftdi_.dtr(context_, 1) < 0)
    return failed("the USB bridge did not take its settings");
  bool heard = false;
  for (int greeting = 0; greeting < kGreetings && !heard; ++greeting) {
    if (std::string fault = write(bytes_of(kGreeting)); !fault.empty()) return fault;
    if (std::string fault = hear(kGreetingBack, kGreetingWait, heard); !fault.empty()) return fault;
  }
  if (!heard) return "the board did not answer: is its power supply plugged in?";
  if (ftdi_.dtr(context_, 0) < 0 || ftdi_.baud_rate(context_, kLoadBaud) < 0)
    return failed("the USB bridge did not take its settings");
  wait_until_clear();
  if (std::string fault = write(bytes_of(kReady)); !fault.empty()) return fault;
  if (std::string fault = hear(kReady, kReadyWait, heard); !fault.empty()) return fault;
  return heard ? "" : "the board was not ready for the file";
}

/// A board that is ready says so by the line CTS. Public programs do without, so a board that does not say it is tried
/// all the same.
void Board::wait_until_clear() const {
  const auto until = Clock::now() + kClearWait;
  unsigned short status = 0;
  while (ftdi_.modem(context_, &status) >= 0 && (status & kClearToSend) == 0 && Clock::now() < until)
    ;
}

/// The board sends every byte back.
std::string Board::transfer(std::span<const std::uint8_t> image, Clock::time_point until) {
  for (std::size_t at = 0; at < image.size(); at += kPiece) {
    const auto piece = image.subspan(at, std::min(kPiece, image.size() - at));
    if (std::string fault = write(piece); !fault.empty()) return fault;
    std::array<std::uint8_t, kPiece> echo{};
    std::size_t size = 0;
    const auto patience = std::min(until, Clock::now() + kPieceWait);
    while (size < piece.size()) {
      std::size_t got = 0;
      if (std::string fault = read(std::span(echo).subspan(size, piece.size() - size), got); !fault.empty())
        return fault;
      size += got;
      if (size < piece.size() && Clock::now() >= patience)
        return "the board stopped at byte " + std::to_string(at + size) + " of " + std::to_string(image.size());
    }
    if (!std::equal(piece.begin(), piece.end(), echo.begin()))
      return "bytes from " + std::to_string(at) + " on came back changed";
  }
  return {};
}

std::string Board::hear(std::string_view expected, std::chrono::milliseconds wait, bool& heard) {
  const auto until = Clock::now() + wait;
  std::string text;
  heard = false;
  do {
    std::array<std::uint8_t, 16> bytes{};
    std::size_t got = 0;
    if (std::string fault = read(std::span(bytes).first(expected.size()), got); !fault.empty()) return fault;
    text.append(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(got));
    heard = text.find(expected) != std::string::npos;
  } while (!heard && Clock::now() < until);
  return {};
}

std::string Board::send(const Command& command) {
  if (due_) drain_until_ = Clock::now() + kDrain;
  due_ = true;
  const std::string why = write(command);
  return why.empty() ? why : "the Falcon is lost: " + why + kCheckPlug;
}

/// As many bytes are asked for as one answer has, for the library waits for more when they are fewer. Where a command
/// was sent before the answer to the last one had come, all is taken for a while, or every answer would be one behind.
std::string Board::receive(Answers& answers) {
  const auto until = Clock::now() + kAnswerWait;
  const std::uint64_t before = answers.count();
  std::array<std::uint8_t, 8 * kFrameBytes> bytes{};
  const std::size_t ask = Clock::now() < drain_until_ ? bytes.size() : kFrameBytes;
  do {
    std::size_t got = 0;
    const std::string why = read(std::span(bytes).first(ask), got);
    if (!why.empty()) return "the Falcon is lost: " + why + kCheckPlug;
    answers.add(std::span(bytes).first(got));
    due_ = due_ && answers.count() == before;
  } while (answers.count() == before && Clock::now() < until);
  return {};
}

std::string Board::write(std::span<const std::uint8_t> bytes) {
  const int size = static_cast<int>(bytes.size());
  return ftdi_.write(context_, bytes.data(), size) == size ? "" : failed("USB takes no bytes");
}

std::string Board::read(std::span<std::uint8_t> into, std::size_t& got) {
  const int size = ftdi_.read(context_, into.data(), static_cast<int>(into.size()));
  if (size < 0) return failed("USB gives no bytes");
  got = std::min(static_cast<std::size_t>(size), into.size());
  return {};
}

std::string Board::failed(const std::string& what) const {
  const char* why = ftdi_.error(context_);
  return what + ": '" + (why == nullptr ? "unknown error" : why) + "'";
}

}  // namespace mechane::drivers::falcon
