#include "client-sdk/drivers/joints/datagram_port.hpp"

#include <cerrno>
#include <cstring>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace mechane::drivers {
namespace {

constexpr int kDatagramSocket = SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK;

/// A socket in the file system that its program left behind.
bool is_left_behind(const sockaddr_un& address) noexcept {
  struct stat what {};
  if (::lstat(address.sun_path, &what) != 0 || !S_ISSOCK(what.st_mode)) return false;
  const int probe = ::socket(AF_UNIX, kDatagramSocket, 0);
  const bool refused =
      ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 && errno == ECONNREFUSED;
  ::close(probe);
  return refused;
}

}  // namespace

DatagramPort::~DatagramPort() {
  if (socket_ >= 0) ::close(socket_);
  if (!file_.empty()) ::unlink(file_.c_str());
}

std::string DatagramPort::open_udp(std::uint16_t port) {
  socket_ = ::socket(AF_INET, kDatagramSocket, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) return {};
  return "cannot listen on UDP port " + std::to_string(port) + " of 127.0.0.1: " + std::strerror(errno) +
         (errno == EADDRINUSE ? "; another program has it: give another one with the option port" : "");
}

std::string DatagramPort::open_socket(const std::string& file) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (file.size() >= sizeof(address.sun_path))
    return "the name of the socket " + file + " is longer than " + std::to_string(sizeof(address.sun_path) - 1) +
           " bytes; give a shorter one with the option socket";
  file.copy(address.sun_path, file.size());
  if (is_left_behind(address)) ::unlink(file.c_str());
  socket_ = ::socket(AF_UNIX, kDatagramSocket, 0);
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) {
    file_ = file;
    return {};
  }
  return "cannot make the socket " + file + ": " + std::strerror(errno) +
         (errno == EADDRINUSE ? "; another program listens there, or it is a file" : "; is the option socket right?");
}

void DatagramPort::wait(std::chrono::milliseconds patience) const noexcept {
  pollfd event{socket_, POLLIN, 0};
  (void)::poll(&event, 1, static_cast<int>(patience.count()));
}

std::string DatagramPort::receive(std::span<char> into, ssize_t& length) const {
  length = ::recv(socket_, into.data(), into.size(), MSG_TRUNC);
  if (length >= 0 || errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return {};
  return std::string("receiving datagrams failed: ") + std::strerror(errno);
}

}  // namespace mechane::drivers
