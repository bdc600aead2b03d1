#include "server/x3d/values.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace mechane::x3d {
namespace {

constexpr std::string_view kBlanks = " \t\r\n,";

tl::unexpected<BadValue> bad(std::string what, std::string remedy) {
  return tl::unexpected<BadValue>(BadValue{std::move(what), std::move(remedy)});
}

/// Cuts the next word off the front; empty at the end.
std::string_view next_word(std::string_view& text) {
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

/// A word as it is shown to people: not longer than a line.
std::string shown(std::string_view word) {
  return std::string(word.substr(0, 40));
}

}  // namespace

bool is_relative_path(std::string_view url) {
  return !url.empty() && url.find("://") == std::string_view::npos && url.front() != '/' &&
         url.find('\\') == std::string_view::npos && !url.starts_with("urn:") && !url.starts_with("data:");
}

Value<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> values;
  for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
    const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
    double value = 0;
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (status == std::errc::result_out_of_range || (status == std::errc{} && !std::isfinite(value))) {
      return bad(fmt::format("'{}' is not a finite number", shown(word)), "write a number that a machine can have");
    }
    if (status != std::errc{} || end != digits.data() + digits.size()) {
      return bad(fmt::format("'{}' is not a number", shown(word)), "write digits with a point, like 0.25");
    }
    values.push_back(value);
  }
  return values;
}

Value<std::vector<double>> parse_integers(std::string_view text) {
  auto values = parse_numbers(text);
  if (!values) return values;
  for (const double value : *values) {
    if (value != std::trunc(value))
      return bad(fmt::format("{} is not a whole number", value),
                 "write a whole number; in metadata, MetadataDouble takes fractions");
  }
  return values;
}

Value<std::vector<bool>> parse_booleans(std::string_view text) {
  std::vector<bool> values;
  for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
    if (word != "true" && word != "false")
      return bad(fmt::format("'{}' is neither true nor false", shown(word)), "write true or false");
    values.push_back(word == "true");
  }
  return values;
}

Value<std::vector<std::string>> parse_strings(std::string_view text) {
  std::vector<std::string> values;
  for (;;) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return values;
    if (text[begin] != '"') {
      const bool plain = text.find('"') == std::string_view::npos && text.size() <= 40;
      return bad("a string is not in quotes", fmt::format("write value='\"{}\"'", plain ? text.substr(begin) : "..."));
    }
    text.remove_prefix(begin + 1);
    std::string value;
    while (!text.empty() && text.front() != '"') {
      if (text.front() == '\\' && text.size() > 1) text.remove_prefix(1);
      value += text.front();
      text.remove_prefix(1);
    }
    if (text.empty()) return bad("a string has no closing quote", "write value='\"...\"'");
    text.remove_prefix(1);
    values.push_back(std::move(value));
  }
}

}  // namespace mechane::x3d
