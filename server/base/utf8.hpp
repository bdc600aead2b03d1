// UTF-8: checked in captions on their way to displays and in unknown texts on their way to the log; counted, cut, lower case.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mechane {

/// How many bytes the first character takes; 0 where it is not well-formed, is the byte 0, or the text is empty.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

/// Whether the byte begins a letter, and does not continue one. A letter here is a code point. Any thread, as all here.
[[nodiscard]] constexpr bool begins_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0u) != 0x80u;
}

/// How many letters the text has.
[[nodiscard]] std::size_t utf8_letters(std::string_view text);

/// The longest beginning of at most `bytes` bytes that cuts no letter.
[[nodiscard]] std::string_view utf8_beginning(std::string_view text, std::size_t bytes);

/// Whether a well-formed character is a control character, which a terminal may obey instead of showing it: C0 with tab and line
/// break, DEL, C1.
[[nodiscard]] bool is_control(std::string_view character);

/// The same of a byte in a text that nobody checked: C0 or DEL.
[[nodiscard]] constexpr bool is_control(char byte) {
  return static_cast<unsigned char>(byte) < 0x20 || byte == 0x7F;
}

/// The same in a text of several lines, which may contain tabs and line breaks.
[[nodiscard]] constexpr bool is_control_in_lines(char byte) {
  return is_control(byte) && byte != '\n' && byte != '\t';
}

/// For a terminal: '?' in place of each C0 and DEL.
[[nodiscard]] std::string without_controls(std::string_view text);

/// The position of the first byte that is not part of well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates), or is 0.
[[nodiscard]] std::optional<std::size_t> first_bad_utf8(std::string_view text);

/// The text with 'a' to 'z' for 'A' to 'Z', whatever the locale; all other characters stay.
[[nodiscard]] std::string lower_case(std::string text);

}  // namespace mechane
