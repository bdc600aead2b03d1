// An HTTP server for tests, on a free port of this machine, that can also do what no server should: break off, stall, send too much.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace mechane::test {

struct HttpReply {
  int status = 200;
  std::string body{};
  std::string headers{};      ///< each line ends with \r\n
  std::size_t cut_at = ~0UL;  ///< so many bytes of the body are sent, then the connection ends
  bool stall = false;         ///< after what is sent nothing comes, and the connection stays
  bool says_length = true;
  std::size_t said_length = ~0UL;  ///< Content-Length, where it is not the body's
};

class SmallHttpServer {
 public:
  /// `head` is the request line and the header, as they came.
  using Answer = std::function<HttpReply(const std::string& path, const std::string& head)>;

  /// `port` 0: any free one.
  explicit SmallHttpServer(Answer answer, std::uint16_t port = 0) : answer_(std::move(answer)) {
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    ::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    at.sin_port = htons(port);
    bound_ = ::bind(socket_, reinterpret_cast<sockaddr*>(&at), sizeof at) == 0 && ::listen(socket_, 16) == 0;
    socklen_t size = sizeof at;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&at), &size);
    port_ = ntohs(at.sin_port);
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  ~SmallHttpServer() {
    thread_.request_stop();
    thread_.join();
    for (const int held : held_)
      ::close(held);
    ::close(socket_);
  }
  SmallHttpServer(const SmallHttpServer&) = delete;
  SmallHttpServer& operator=(const SmallHttpServer&) = delete;

  [[nodiscard]] bool bound() const { return bound_; }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] std::string address(const std::string& path) const {
    return fmt::format("http://127.0.0.1:{}{}", port_, path);
  }
  /// How often a path was asked for.
  [[nodiscard]] int asked(const std::string& path) const {
    const std::lock_guard lock(mutex_);
    const auto at = asked_.find(path);
    return at == asked_.end() ? 0 : at->second;
  }

 private:
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      pollfd ready{socket_, POLLIN, 0};
      if (::poll(&ready, 1, 20) <= 0) continue;
      const int fd = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
      if (fd >= 0) serve(fd);
    }
  }

  void serve(int fd) {
    std::string head;
    char piece[2048];
    while (head.find("\r\n\r\n") == std::string::npos) {
      const ssize_t got = ::recv(fd, piece, sizeof piece, 0);
      if (got <= 0) break;
      head.append(piece, static_cast<std::size_t>(got));
    }
    const std::size_t begin = head.find(' ') + 1;
    const std::string path = head.substr(begin, head.find(' ', begin) - begin);
    {
      const std::lock_guard lock(mutex_);
      ++asked_[path];
    }
    const HttpReply reply = answer_(path, head);
    const std::size_t length = reply.said_length == ~0UL ? reply.body.size() : reply.said_length;
    const std::string told = reply.says_length ? fmt::format("Content-Length: {}\r\n", length) : "";
    send_all(fd, fmt::format("HTTP/1.1 {} told\r\nConnection: close\r\n{}{}\r\n", reply.status, told, reply.headers));
    send_all(fd, reply.body.substr(0, reply.cut_at));
    if (reply.stall) {
      held_.push_back(fd);
    } else {
      ::close(fd);
    }
  }

  static void send_all(int fd, const std::string& text) {
    for (std::size_t sent = 0; sent < text.size();) {
      const ssize_t n = ::send(fd, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) return;
      sent += static_cast<std::size_t>(n);
    }
  }

  Answer answer_;
  int socket_ = -1;
  bool bound_ = false;
  std::uint16_t port_ = 0;
  std::vector<int> held_;
  mutable std::mutex mutex_;
  std::map<std::string, int> asked_;
  std::jthread thread_;
};

}  // namespace mechane::test
