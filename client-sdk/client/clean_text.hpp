// Texts from the network, as they may stand on a terminal: line ends and tabs stay, other control characters go.
#pragma once

#include <string>

#include <mechane/proto/names.hpp>

namespace mechane::client {

[[nodiscard]] inline std::string clean(std::string text) {
  std::erase_if(text, [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return (u < 0x20 && c != '\n' && c != '\t') || u == 0x7f;
  });
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
