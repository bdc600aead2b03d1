#include "server/content/importer/obj_text.hpp"

#include <algorithm>
#include <array>

namespace mechane::content {
namespace {

constexpr std::string_view kBlanks = " \t\r";

bool is_of_numbers(std::string_view line) {
  constexpr std::array<std::string_view, 4> kWords{"v", "vn", "vt", "f"};
  return std::find(kWords.begin(), kWords.end(), line.substr(0, line.find_first_of(kBlanks))) != kWords.end();
}

void append_numbers(std::string_view line, std::string& out) {
  bool begins = true;  // a word
  for (const char c : line.substr(0, line.find('#'))) {
    if (begins && c == '.') out += '0';
    out += c;
    begins = kBlanks.find(c) != std::string_view::npos;
  }
}

}  // namespace

std::string plain_obj(std::string_view text) {
  std::string out;
  out.reserve(text.size() + text.size() / 8);
  bool continued =
      false;  // the line before ended with a backslash: this one goes on with its numbers, or with its name
  bool numbers = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (!continued) line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    numbers = continued ? numbers : is_of_numbers(line);
    if (numbers) {
      append_numbers(line, out);
    } else {
      out += line;
    }
    const std::size_t last = line.find_last_not_of(kBlanks);
    continued = last != std::string_view::npos && line[last] == '\\';
    if (end < text.size()) out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

}  // namespace mechane::content
