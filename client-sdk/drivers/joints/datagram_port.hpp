// A place on this computer where other programs send datagrams to: a UDP port on the loopback interface, or a Unix
// datagram socket. No other interface is ever listened on.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include <sys/types.h>

namespace mechane::drivers {

/// Open from one of the open functions until it goes. One thread. Faults are in words for a person, empty when there is
/// none.
class DatagramPort {
 public:
  DatagramPort() = default;
  ~DatagramPort();
  DatagramPort(const DatagramPort&) = delete;
  DatagramPort& operator=(const DatagramPort&) = delete;

  /// UDP on 127.0.0.1. Fault: another program has the port.
  [[nodiscard]] std::string open_udp(std::uint16_t port);
  /// A new socket, which goes when this does; it replaces one that nobody listens at. Who may send is up to the folder
  /// and the umask. Faults: no such folder, no right to it, another program listens there, a file that is no socket.
  [[nodiscard]] std::string open_socket(const std::string& file);

  /// Until a datagram is there, or `patience` has passed.
  void wait(std::chrono::milliseconds patience) const noexcept;
  /// The next datagram that has come. `length` is its whole length, also where that is over the size of `into`; below 0:
  /// there is none. Fault: the socket failed.
  [[nodiscard]] std::string receive(std::span<char> into, ssize_t& length) const;

 private:
  int socket_ = -1;
  std::string file_;
};

}  // namespace mechane::drivers
