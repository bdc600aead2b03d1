#include "server/app/pace_orders.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

namespace mechane::app {
namespace {

template <class T>
std::optional<T> number_within(std::string_view text, T low, T high) {
  T value{};
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool right = read.ec == std::errc() && read.ptr == text.data() + text.size() && value >= low && value <= high;
  return right ? std::optional(value) : std::nullopt;
}

}  // namespace

Expected<PaceOrder> parse_pace_order(std::string_view line) {
  constexpr std::string_view kPace = "pace ", kStep = "step ";
  if (line.starts_with(kPace))
    if (const auto pace = number_within(line.substr(kPace.size()), 0.0, 1.0)) return PaceOrder{*pace, 0};
  if (line.starts_with(kStep))
    if (const auto ticks = number_within<std::uint32_t>(line.substr(kStep.size()), 1, kMostSteps))
      return PaceOrder{0, *ticks};
  return fail(ErrorCode::invalid_value, "'" + std::string(line) + "' is not an order", "standard input",
              fmt::format("write 'pace X' with X from 0 to 1, 'step N' with N from 1 to {}, or 'edit N'", kMostSteps));
}

std::vector<std::string> OrderLines::take() {
  std::vector<std::string> lines;
  pollfd looked{descriptor_, POLLIN, 0};
  while (!ended_ && poll(&looked, 1, 0) > 0) {
    std::array<char, 512> piece;
    const ssize_t size = read(descriptor_, piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    ended_ = size <= 0;
    for (const char c : std::string_view(piece.data(), ended_ ? 0 : static_cast<std::size_t>(size))) {
      if (c != '\n') begun_ += c;
      if (c == '\n' || begun_.size() >= kLongest) lines.push_back(std::exchange(begun_, {}));
    }
  }
  return lines;
}

}  // namespace mechane::app
