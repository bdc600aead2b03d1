// What the driver calls of libftdi 1, declared anew from its documentation: the Falcon's USB bridge is of FTDI's make.
// Results below 0 are failures, which ftdi_get_error_string() explains.
#pragma once

#include <string>

namespace mechane::drivers::falcon {

/// The first members of ftdi_context. The library has no function that sets the limits of time, which are 5 s.
struct FtdiContext {
  void* usb;
  void* device;
  int read_timeout_ms;
  int write_timeout_ms;
};

/// The library's functions by their names.
struct Ftdi {
  FtdiContext* (*make)() = nullptr;
  void (*free)(FtdiContext*) = nullptr;
  int (*open)(FtdiContext*, int vendor, int product, const char* description, const char* serial,
              unsigned int index) = nullptr;
  int (*close)(FtdiContext*) = nullptr;
  int (*reset)(FtdiContext*) = nullptr;
  int (*flush)(FtdiContext*) = nullptr;  // forgets what has not been sent and not been read
  int (*baud_rate)(FtdiContext*, int baud) = nullptr;
  int (*line)(FtdiContext*, int bits, int stop_bits, int parity) = nullptr;  // 8, 0, 0: eight, one, none
  int (*flow_control)(FtdiContext*, int) = nullptr;                          // 0: none
  int (*dtr)(FtdiContext*, int) = nullptr;
  int (*rts)(FtdiContext*, int) = nullptr;
  int (*latency)(FtdiContext*, unsigned char ms) = nullptr;  // how long the chip waits for more to send
  int (*modem)(FtdiContext*, unsigned short* status) = nullptr;
  int (*read)(FtdiContext*, unsigned char*, int size) = nullptr;  // at most a latency; fewer bytes: no more have come
  int (*write)(FtdiContext*, const unsigned char*, int size) = nullptr;
  const char* (*error)(FtdiContext*) = nullptr;
};

inline constexpr unsigned kClearToSend = 0x10;  // of the modem's status

/// Loads `file`, or where that is empty the names under which the library is installed. Returns a fault for a person;
/// empty: loaded.
[[nodiscard]] std::string load(Ftdi& ftdi, const std::string& file);

}  // namespace mechane::drivers::falcon
