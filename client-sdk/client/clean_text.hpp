// Makes texts from the network safe for a terminal: removes control characters except line ends and tabs.
#pragma once

#include <string>

#include "server/base/utf8.hpp"
#include <mechane/proto/names.hpp>

namespace mechane::client {

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

}  // namespace mechane::client
