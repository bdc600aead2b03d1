// What a technician at the command line reads of a hand's link to the server.
#pragma once

#include <optional>
#include <string>

#include "server/log/log.hpp"
#include <mechane/client/client.hpp>

namespace mechane::haptic {

/// A haptic program calls look() a few times a second, from one thread.
class LinkNews {
 public:
  /// How long a server may be looked for before that is worth a warning.
  static constexpr Duration kPatience = std::chrono::seconds(5);

  struct Line {
    log::Level level = log::Level::info;
    std::string text;
  };

  explicit LinkNews(const client::ClientConfig& config);

  /// None where nothing has changed since the last call. `refusal`: the client's, while it is refused.
  [[nodiscard]] std::optional<Line> look(client::LinkState state, const std::string& refusal, TimePoint now);

 private:
  std::string hand_, domain_;
  std::optional<client::LinkState> state_;
  std::string refusal_;
  TimePoint since_{};  // the state is what it is
  bool warned_ = false;
};

}  // namespace mechane::haptic
