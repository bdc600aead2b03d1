// What all connections of the web server share, and a place among them. On the loop's thread.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "client-sdk/gateway/http/rate_limit.hpp"
#include "client-sdk/gateway/http/web_server.hpp"

namespace mechane::gateway {

/// A WebSocket that is open.
class LiveSocket {
 public:
  virtual ~LiveSocket() = default;
  virtual void end() = 0;
};

/// What all connections share.
struct WebHall {
  explicit WebHall(WebServerOptions chosen) : options(std::move(chosen)) {}
  WebServerOptions options;
  Site* site = nullptr;
  RateLimits requests{50, 300};
  std::map<std::string, std::size_t> by_address;
  WebServer::Traffic traffic;
  std::size_t refusals = 0;  // that linger now
  std::set<LiveSocket*> sockets;
};

/// A place among the connections, as long as it lives.
class WebPlace {
 public:
  WebPlace(std::shared_ptr<WebHall> hall, std::string address) : hall_(std::move(hall)), address_(std::move(address)) {
    ++hall_->traffic.connections;
    ++hall_->by_address[address_];
  }
  WebPlace(WebPlace&& other) noexcept = default;
  WebPlace& operator=(WebPlace&&) = delete;
  ~WebPlace() {
    if (!hall_) return;
    --hall_->traffic.connections;
    if (--hall_->by_address[address_] == 0) hall_->by_address.erase(address_);
  }
  [[nodiscard]] WebHall& hall() const { return *hall_; }
  [[nodiscard]] const std::string& address() const { return address_; }

 private:
  std::shared_ptr<WebHall> hall_;
  std::string address_;
};

}  // namespace mechane::gateway
