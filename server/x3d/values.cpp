#include "server/x3d/values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace mechane::x3d {
namespace {

constexpr std::size_t kMostShown = 80;  // bytes of an author's text in a remedy
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

/// A word as a message shows it, cut to 40 bytes.
std::string shown(std::string_view word) {
  return std::string(word.substr(0, 40));
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// One comma with digits on both sides and nothing else in between: "12,5", not "1,2,3" or "1, 2".
bool is_decimal_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  return comma != std::string_view::npos && comma > 0 && comma + 1 < word.size() && is_digit(word[comma - 1]) &&
         is_digit(word[comma + 1]) && word.find(',', comma + 1) == std::string_view::npos;
}

constexpr std::string_view kQuotes[] = {"\"",     "'",      "\u201c", "\u201d", "\u201e", "\u201f",
                                        "\u2018", "\u2019", "\u201a", "\u201b", "\u00ab", "\u00bb"};

/// Removes quotes of any kind from both ends.
std::string_view without_quotes(std::string_view text) {
  for (bool found = true; found;) {
    found = false;
    for (const std::string_view quote : kQuotes) {
      const bool first = text.starts_with(quote);
      if (first) text.remove_prefix(quote.size());
      const bool last = text.ends_with(quote);
      if (last) text.remove_suffix(quote.size());
      found = found || first || last;
    }
  }
  return text;
}

bool has_quotes(std::string_view text) {
  return std::any_of(std::begin(kQuotes), std::end(kQuotes),
                     [&](std::string_view quote) { return text.find(quote) != std::string_view::npos; });
}

/// Writes each quote, of any kind, as a straight double one.
std::string with_straight_quotes(std::string_view text) {
  std::string straight;
  while (!text.empty()) {
    const auto* const quote =
        std::find_if(std::begin(kQuotes), std::end(kQuotes), [&](std::string_view q) { return text.starts_with(q); });
    const bool is_quote = quote != std::end(kQuotes);
    straight += is_quote ? '"' : text.front();
    text.remove_prefix(is_quote ? quote->size() : 1);
  }
  return straight;
}

/// Cuts blanks and then a string in straight quotes off the front. None where no such string is there: then only the blanks.
std::optional<std::string> take_string(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  if (text.empty() || text.front() != '"') return std::nullopt;
  std::string value;
  for (std::size_t at = 1; at < text.size(); ++at) {
    if (text[at] == '"') {
      text.remove_prefix(at + 1);
      return value;
    }
    if (text[at] == '\\' && at + 1 < text.size()) ++at;
    value += text[at];
  }
  return std::nullopt;
}

bool is_strings(std::string_view text) {
  while (take_string(text)) {
  }
  return text.empty();
}

}  // namespace

DecimalCommas decimal_commas(std::string_view text) {
  constexpr std::string_view kSpaces = " \t\r\n";
  DecimalCommas found;
  while (!text.empty()) {
    const std::size_t begin = std::min(text.find_first_not_of(kSpaces), text.size());
    const std::size_t end = std::min(text.find_first_of(kSpaces, begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    if (is_decimal_comma(word) && found.count++ == 0) found.first = shown(word);
  }
  return found;
}

std::optional<BadValue> comma_fault(const DecimalCommas& commas, std::size_t count, std::size_t wanted) {
  if (commas.count == 0 || count != wanted + commas.count) return std::nullopt;
  std::string point = commas.first;
  point[point.find(',')] = '.';
  return BadValue{fmt::format("'{}' is read as two numbers, because a comma separates numbers", commas.first),
                  fmt::format("write a decimal point: {}", point)};
}

std::string in_straight_quotes(std::string_view attribute, std::string_view text) {
  std::string_view rest = text;
  while (take_string(rest)) {
  }
  const std::string_view good = text.substr(0, text.size() - rest.size());
  const std::string_view bare = without_quotes(rest);
  std::string mended = has_quotes(bare) ? with_straight_quotes(rest) : fmt::format("\"{}\"", bare);
  if (good.size() + mended.size() > kMostShown || !is_strings(mended)) return fmt::format("{}='\"...\"'", attribute);
  return fmt::format("{}='{}{}'", attribute, good, mended);
}

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
      return bad(fmt::format("'{}' is not a finite number", shown(word)), "write a number between -1e300 and 1e300");
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
  const std::string_view whole = text;
  std::vector<std::string> values;
  while (auto value = take_string(text))
    values.push_back(std::move(*value));
  if (text.empty()) return values;
  const bool curly = static_cast<unsigned char>(text.front()) >= 0x80 && without_quotes(text).size() < text.size();
  return bad(text.front() == '"' ? "a string has no closing quote"
             : curly             ? "a string is in curly quotes, not in straight ones"
                                 : "a string is not in quotes",
             "write " + in_straight_quotes("value", whole));
}

}  // namespace mechane::x3d
