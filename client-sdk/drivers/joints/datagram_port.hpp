// A place on this computer where other programs send datagrams to: a UDP port on the loopback interface, or a Unix
// datagram socket. No other interface is ever listened on.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include <sys/types.h>

namespace mechane::drivers {

/// Listens from one of the open functions on until its end. One thread. Functions return what went wrong, in words for a
/// person, or an empty text.
class DatagramPort {
 public:
  DatagramPort() = default;
  ~DatagramPort();
  DatagramPort(const DatagramPort&) = delete;
  DatagramPort& operator=(const DatagramPort&) = delete;

  /// UDP on 127.0.0.1. Fault: another program has the port.
  [[nodiscard]] std::string open_udp(std::uint16_t port);
  /// Makes the socket `file`, and deletes it at the end. A socket that an ended program left there is replaced. Who may
  /// send is up to the folder and the umask. Faults: the folder is missing or may not be written to, another program
  /// listens at the socket, or the file exists and is not a socket.
  [[nodiscard]] std::string open_socket(const std::string& file);

  /// Until a datagram is there, or `patience` has passed.
  void wait(std::chrono::milliseconds patience) const noexcept;
  /// Takes the next datagram. `length` is its whole length, even when it is longer than `into`; it is below 0 when no
  /// datagram has come. Fault: the socket does not work.
  [[nodiscard]] std::string receive(std::span<char> into, ssize_t& length) const;

 private:
  int socket_ = -1;
  std::string file_;
};

}  // namespace mechane::drivers
