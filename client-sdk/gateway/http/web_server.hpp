// The web server: HTTP and WebSocket, with TLS or without, all sockets on one thread. Nothing here waits for a slow
// browser: what it has not read is replaced by what is newer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "client-sdk/gateway/http/http_types.hpp"
#include "server/base/clock.hpp"

namespace mechane::gateway {

struct ListenAddress {
  std::string address = "127.0.0.1";  ///< in digits, IPv4 or IPv6
  std::uint16_t port = 8480;          ///< 0: the system chooses one
  bool loopback = true;               ///< only this machine reaches it
};
/// Reads "127.0.0.1:8480", "[::1]:8480", "localhost:8480". Errors: invalid_value.
[[nodiscard]] Expected<ListenAddress> parse_listen_address(const std::string& text);

struct WebServerOptions {
  ListenAddress listen;
  std::filesystem::path certificate{};  ///< PEM; empty: no TLS
  std::filesystem::path key{};
  std::size_t most_sockets = 400;  ///< at a time; further ones are told to come back later
  std::size_t most_of_address = 100;
  std::size_t header_bytes = std::size_t{16} << 10U;
  std::size_t body_bytes = std::size_t{64} << 10U;
  std::uint16_t hand_program = 0;                      ///< pages may talk to this port of their own machine; 0: to none
  std::size_t message_bytes = std::size_t{64} << 10U;  ///< from a browser, over its WebSocket
};

/// post() may be called from any thread, all else by the one that calls run().
class WebServer {
 public:
  /// Listens. Errors: the address is in use or not of this machine, a certificate that cannot be used.
  [[nodiscard]] static Expected<std::unique_ptr<WebServer>> open(const WebServerOptions& options);
  virtual ~WebServer() = default;

  /// Serves `site` until SIGINT or SIGTERM, or stop().
  virtual void run(Site& site) = 0;
  virtual void stop() = 0;
  [[nodiscard]] virtual std::uint16_t port() const = 0;
  /// Runs `job` on the loop's thread.
  virtual void post(std::function<void()> job) = 0;
  /// Runs `job` on the loop's thread again and again, while run() runs.
  virtual void every(Duration period, std::function<void()> job) = 0;
  /// WebSockets and connections now, and refused since the start for want of room.
  struct Traffic {
    std::size_t connections = 0;
    std::uint64_t refused = 0;
    std::uint64_t frames_skipped = 0;
  };
  [[nodiscard]] virtual Traffic traffic() const = 0;
};

}  // namespace mechane::gateway
