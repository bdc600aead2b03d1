#include "server/log/printable.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "server/base/utf8.hpp"

namespace mechane::log {
namespace {

constexpr std::string_view kIndent = "    ";

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    text.remove_prefix(character.size());
    if (character == "\n") {
      out += '\n';
      out += kIndent;
    } else if (length == 0 || (is_control(character) && character != "\t")) {
      for (const char byte : character)
        out += fmt::format("\\x{:02x}", static_cast<std::uint8_t>(byte));
    } else {
      out += character;
    }
  }
  return out;
}

}  // namespace mechane::log
