// Orders about the pace of time, as lines from whoever started the server.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/app/tick_pace.hpp"
#include "server/base/error.hpp"

namespace mechane::app {

/// "pace 0.25" or "step 10". Errors: invalid_value, with what can be written.
[[nodiscard]] Expected<PaceOrder> parse_pace_order(std::string_view line);

/// The lines that come from a pipe, a socket or a terminal. One thread, which does not wait.
class OrderLines {
 public:
  static constexpr std::size_t kLongest = 200;  ///< bytes of a line; a longer one comes in pieces

  explicit OrderLines(int descriptor) : descriptor_(descriptor) {}
  /// Those that have come whole since the last call, without their ends.
  [[nodiscard]] std::vector<std::string> take();
  /// Whether nothing can come any more.
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  int descriptor_;
  bool ended_ = false;
  std::string begun_;
};

}  // namespace mechane::app
