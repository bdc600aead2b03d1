// The connection to Haply's local service: a WebSocket, and one HTTP question about its version.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace mechane::drivers {

/// Sends and receives whole text messages, in order. Every call has a deadline. All calls come from one thread; nothing
/// runs in the background. A call returns a fault in words for a person, or an empty text; after a fault the link cannot
/// be used any more. Asio keeps the memory of its operations and uses it again; Beast may allocate for a long message.
class HaplyLink {
 public:
  /// Up to 5 s for each of the calls that connect.
  HaplyLink(std::string host, std::uint16_t port);
  ~HaplyLink();
  HaplyLink(const HaplyLink&) = delete;
  HaplyLink& operator=(const HaplyLink&) = delete;

  /// What GET /version answers, over a connection of its own. Faults: no service, no such page.
  [[nodiscard]] std::string ask_version(std::string& body);
  /// Faults: no service, or something else answers at this port.
  [[nodiscard]] std::string open();
  /// Faults: the service is gone, or takes nothing.
  [[nodiscard]] std::string send(std::string_view text);
  /// The next message, valid until the next call; empty when none comes in time, and what has come of it is kept.
  /// Fault: the service is gone.
  [[nodiscard]] std::string receive(std::chrono::milliseconds patience, std::string_view& message);

 private:
  struct Wire;
  std::unique_ptr<Wire> wire_;
};

}  // namespace mechane::drivers
