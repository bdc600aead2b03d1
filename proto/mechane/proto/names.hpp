// Names on the wire: kiosks and worlds, the partitions named after them, and the fixed char arrays that hold them.
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "server/base/error.hpp"
#include "server/base/utf8.hpp"

namespace mechane::proto {

inline constexpr std::size_t kNameSize = 32;  ///< with the closing zero

/// Whether this can be the name of a kiosk, world or server: 1 to 31 characters of A-Z a-z 0-9 - _ (in a partition, others are wildcards).
[[nodiscard]] bool is_name(std::string_view name);
/// Errors: invalid_value, which says what kind of name is wrong (`what`: "kiosk") and what is allowed.
[[nodiscard]] Expected<void> check_name(std::string_view name, const std::string& what);

[[nodiscard]] std::string kiosk_partition(std::string_view kiosk);  ///< kiosk/<name>
[[nodiscard]] std::string world_partition(std::string_view world);  ///< world/<id>

/// The text in a char array: up to its first zero, or all of it. Never reads further.
template <std::size_t N>
[[nodiscard]] std::string_view text_of(const char (&chars)[N]) noexcept {
  return {chars, ::strnlen(chars, N)};
}

/// Fills a char array, zeros behind the text; a text that is too long is cut at a UTF-8 character. Always ends in a zero.
template <std::size_t N>
void set_text(char (&chars)[N], std::string_view text) noexcept {
  const std::size_t n = utf8_beginning(text, N - 1).size();
  std::memset(chars, 0, N);
  if (n > 0) std::memcpy(chars, text.data(), n);
}

/// Text of a wire string, which may be null. Not an overload of text_of: that would be chosen for char arrays too, and read past one that
/// has no closing zero.
[[nodiscard]] inline std::string string_of(const char* text) {
  return text == nullptr ? std::string() : std::string(text);
}

}  // namespace mechane::proto
