// A stub of libftdi with a Falcon behind it, written from the library's documentation and from what libnifalcon does. A
// test loads the same file and finds the fake_ftdi_* functions by name. No thread of its own.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <iterator>
#include <string>
#include <string_view>

#define FAKE_FTDI extern "C" __attribute__((visibility("default")))

struct ftdi_context {  // as the library begins it
  void* usb;
  void* device;
  int usb_read_timeout;
  int usb_write_timeout;
};

namespace {

using FtdiClock = std::chrono::steady_clock;

// What a test sets and reads, by name.
struct FtdiCell {
  const char* name;
  double fresh;  // after fake_ftdi_reset()
  double value = fresh;
};
std::array ftdi_cells = {
    // what is there
    FtdiCell{"absent", 0}, FtdiCell{"timeout", 5000}, FtdiCell{"running", 0}, FtdiCell{"image_size", 1000},
    // what goes wrong with an upload: how often a greeting is not heard, an echo is wrong or stops, and the
    // image does not start
    FtdiCell{"deaf", 0}, FtdiCell{"wrong_echoes", 0}, FtdiCell{"short_echoes", 0}, FtdiCell{"no_cts", 0},
    FtdiCell{"no_starts", 0},
    // the hand
    FtdiCell{"e0", 0}, FtdiCell{"e1", 0}, FtdiCell{"e2", 0}, FtdiCell{"buttons", 0}, FtdiCell{"homed", 7},
    // what goes wrong with answers: how many are torn, come behind other bytes, or have a count of 30000
    FtdiCell{"torn", 0}, FtdiCell{"garbage", 0}, FtdiCell{"wrong", 0}, FtdiCell{"late_ms", 0}, FtdiCell{"mute", 0},
    FtdiCell{"stuck", 0},
    // what it was told
    FtdiCell{"m0", 9}, FtdiCell{"m1", 9}, FtdiCell{"m2", 9}, FtdiCell{"lights", 0}, FtdiCell{"homing", 0},
    FtdiCell{"frames", 0}, FtdiCell{"uploads", 0}, FtdiCell{"index", -1}, FtdiCell{"open", 0}, FtdiCell{"contexts", 0},
    FtdiCell{"zeros", 0}, FtdiCell{"misuse", 0}};

double& ftdi_at(std::string_view name) {
  for (FtdiCell& cell : ftdi_cells)
    if (name == cell.name) return cell.value;
  std::abort();
}
/// Whether the next thing goes wrong, of as many as the test has set.
bool strikes(std::string_view name) {
  if (ftdi_at(name) <= 0) return false;
  --ftdi_at(name);
  return true;
}

struct FtdiSession {
  ftdi_context context{};
  int baud = 0, dtr = -1, latency = 0, bits = 0, flow = -1;
  bool greeted = false, loading = false, wrong = false, cut = false;
  double image = 0;  // bytes of it that have come
  struct Byte {
    std::uint8_t value;
    FtdiClock::time_point at;
  };
  std::deque<Byte> to_host;
} session;

void give(std::string_view bytes, double after_ms = 0) {
  const auto at = FtdiClock::now() + std::chrono::microseconds(static_cast<long>(after_ms * 1000));
  for (const char byte : bytes)
    session.to_host.push_back({static_cast<std::uint8_t>(byte), at});
}

int result(const ftdi_context* context) {
  if (context != &session.context || ftdi_at("open") == 0) ++ftdi_at("misuse");
  return ftdi_at("absent") != 0 ? -1 : 0;
}

std::string answer() {
  std::string bytes = "<";
  const bool wrong = strikes("wrong");
  for (const char* encoder : {"e0", "e1", "e2"}) {
    const auto count = static_cast<unsigned>(wrong ? 30000 : static_cast<int>(ftdi_at(encoder)));
    for (unsigned shift = 0; shift < 16; shift += 4)
      bytes += static_cast<char>('A' + (count >> shift & 15u));
  }
  const unsigned homed = ftdi_at("homing") != 0 ? static_cast<unsigned>(ftdi_at("homed")) : 0;
  bytes += static_cast<char>('A' + static_cast<int>(static_cast<unsigned>(ftdi_at("buttons")) | homed << 4));
  return bytes + "A>";
}

void run(std::string_view frame) {
  if (frame.size() != 16 || frame.front() != '<' || frame.back() != '>') {
    ++ftdi_at("misuse");
    return;
  }
  ++ftdi_at("frames");
  std::size_t at = 1;
  bool still = true;
  for (const char* motor : {"m0", "m1", "m2"}) {
    unsigned word = 0;
    for (unsigned shift = 0; shift < 16; shift += 4)
      word |= static_cast<unsigned>(frame[at++] - 'A') << shift;
    ftdi_at(motor) = static_cast<std::int16_t>(word);
    still = still && word == 0;
  }
  ftdi_at("zeros") = still ? ftdi_at("zeros") + 1 : 0;
  ftdi_at("lights") = (frame[13] - 'A') & 14;
  ftdi_at("homing") = (frame[13] - 'A') & 1;
  if (ftdi_at("mute") != 0) return;
  std::string bytes = answer();
  if (strikes("torn")) bytes.erase(5, 1);
  if (strikes("garbage")) bytes.insert(0, "x<AB");
  give(bytes, ftdi_at("late_ms"));
}

void load(std::string_view bytes) {
  session.image += static_cast<double>(bytes.size());
  std::string echo(bytes);
  if (session.wrong) echo.back() ^= 1;
  if (session.cut) echo.pop_back();
  session.wrong = session.cut = false;
  give(echo);
}

/// Bytes from the host, in the state that the board is in.
void hear(std::string_view bytes) {
  if (session.bits != 8 || session.flow != 0) ++ftdi_at("misuse");
  if (session.baud == 9600 && session.dtr == 1 && bytes == "\x0A\x43\x0D") {
    if (strikes("deaf")) return;
    session.greeted = true;
    give(std::string_view("\0\x0A\x44\x2C\x0D", 5));
  } else if (session.baud == 140000 && session.dtr == 0 && session.loading) {
    load(bytes);
  } else if (session.baud == 140000 && session.dtr == 0 && session.greeted && bytes == "A") {
    ++ftdi_at("uploads");
    session.loading = true;
    session.wrong = strikes("wrong_echoes");
    session.cut = strikes("short_echoes");
    give("A");
  } else if (session.baud == 1500000 && session.latency == 1 && ftdi_at("running") != 0) {
    run(bytes);
  }
}

}  // namespace

FAKE_FTDI void fake_ftdi_set(const char* name, double value) {
  ftdi_at(name) = value;
}
FAKE_FTDI double fake_ftdi_get(const char* name) {
  return ftdi_at(name);
}
FAKE_FTDI void fake_ftdi_reset() {
  for (FtdiCell& cell : ftdi_cells)
    cell.value = cell.fresh;
  session = {};
}

FAKE_FTDI ftdi_context* ftdi_new() {
  ++ftdi_at("contexts");
  session.context.usb_read_timeout = session.context.usb_write_timeout = static_cast<int>(ftdi_at("timeout"));
  return &session.context;
}
FAKE_FTDI void ftdi_free(ftdi_context*) {
  --ftdi_at("contexts");
}
FAKE_FTDI int ftdi_usb_open_desc_index(ftdi_context*, int vendor, int product, const char*, const char*,
                                       unsigned index) {
  if (vendor != 0x0403 || product != 0xCB48) ++ftdi_at("misuse");
  ftdi_at("index") = index;
  if (ftdi_at("absent") != 0 || index > 1) return -3;
  ++ftdi_at("open");
  session.baud = 9600;
  return 0;
}
FAKE_FTDI int ftdi_usb_close(ftdi_context* context) {
  const int failed = result(context);
  --ftdi_at("open");
  return failed;
}
FAKE_FTDI int ftdi_usb_reset(ftdi_context* context) {
  return result(context);
}
FAKE_FTDI int ftdi_tcioflush(ftdi_context* context) {
  session.to_host.clear();
  return result(context);
}
FAKE_FTDI int ftdi_set_baudrate(ftdi_context* context, int baud) {
  session.baud = baud;
  if (baud == 1500000 && session.loading && session.image == ftdi_at("image_size")) {
    ftdi_at("running") = strikes("no_starts") ? 0 : 1;
    session.loading = false;
  }
  return result(context);
}
FAKE_FTDI int ftdi_set_line_property(ftdi_context* context, int bits, int stop, int parity) {
  session.bits = stop == 0 && parity == 0 ? bits : 0;
  return result(context);
}
FAKE_FTDI int ftdi_setflowctrl(ftdi_context* context, int flow) {
  session.flow = flow;
  return result(context);
}
FAKE_FTDI int ftdi_setdtr(ftdi_context* context, int on) {
  if (on == 1 && session.dtr == 0 && session.baud == 9600) {  // the board starts anew
    ftdi_at("running") = 0;
    session.greeted = session.loading = false;
    session.image = 0;
  }
  session.dtr = on;
  return result(context);
}
FAKE_FTDI int ftdi_setrts(ftdi_context* context, int) {
  return result(context);
}
FAKE_FTDI int ftdi_set_latency_timer(ftdi_context* context, unsigned char ms) {
  session.latency = ms;
  return result(context);
}
FAKE_FTDI int ftdi_poll_modem_status(ftdi_context* context, unsigned short* status) {
  *status = session.greeted && session.baud == 140000 && ftdi_at("no_cts") == 0 ? 0x10 : 0;
  return result(context);
}
FAKE_FTDI int ftdi_read_data(ftdi_context* context, unsigned char* into, int size) {
  if (const int failed = result(context); failed < 0) return failed;
  if (context->usb_read_timeout > 500) ++ftdi_at("misuse");  // what is stuck holds up the program
  if (ftdi_at("stuck") != 0) return -7;
  int got = 0;
  const auto now = FtdiClock::now();
  while (got < size && !session.to_host.empty() && session.to_host.front().at <= now) {
    into[got++] = session.to_host.front().value;
    session.to_host.pop_front();
  }
  return got;
}
FAKE_FTDI int ftdi_write_data(ftdi_context* context, const unsigned char* bytes, int size) {
  if (const int failed = result(context); failed < 0) return failed;
  hear({reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size)});
  return size;
}
FAKE_FTDI const char* ftdi_get_error_string(ftdi_context*) {
  return ftdi_at("absent") != 0 ? "fake: no device" : nullptr;
}
