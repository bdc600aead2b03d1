// Makes texts from the network safe for a terminal: without control characters.
#pragma once

#include <algorithm>
#include <string>

#include "server/base/utf8.hpp"
#include <mechane/proto/names.hpp>

namespace mechane::client {

/// Line ends and tabs stay.
[[nodiscard]] inline std::string clean(std::string text) {
  std::erase_if(text, is_control_in_lines);
  return text;
}
[[nodiscard]] inline std::string clean_string(const char* text) {
  return clean(proto::string_of(text));
}
template <std::size_t N>
[[nodiscard]] std::string clean(const char (&text)[N]) {
  return clean(std::string(proto::text_of(text)));
}
/// Line ends and tabs become spaces, and what is longer than 500 bytes is cut: a status is one line on a technician's screen.
[[nodiscard]] inline std::string one_line(const char* text) {
  constexpr std::size_t kMostText = 500;
  std::string line = clean_string(text);
  std::ranges::replace_if(
      line, [](char c) { return is_control(c); }, ' ');
  line.resize(utf8_beginning(line, kMostText).size());
  return line;
}

}  // namespace mechane::client
