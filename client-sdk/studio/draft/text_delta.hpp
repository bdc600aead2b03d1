// What one edit changed of a text: one part of it, before and after.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mechane::studio {

struct TextDelta {
  std::size_t at = 0;  ///< bytes; begins a letter of UTF-8, and both texts end with a whole one
  std::string before;
  std::string after;

  [[nodiscard]] TextDelta reversed() const { return {at, after, before}; }
  [[nodiscard]] std::size_t bytes() const { return before.size() + after.size(); }
};

/// The smallest part that turns `from` into `to`, both well-formed UTF-8; where they are the same, both its texts are empty.
[[nodiscard]] TextDelta delta_between(std::string_view from, std::string_view to);

/// The text after the edit; none where `before` does not stand there.
[[nodiscard]] std::optional<std::string> applied(std::string_view text, const TextDelta& delta);

}  // namespace mechane::studio
