// The limits of the schema's keys: in words, and checked against values.
#include <algorithm>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/scenario/schema.hpp"

namespace mechane::scenario {
using enum ValueKind;

namespace {

bool has_min(const Key& key) {
  return key.min > -std::numeric_limits<double>::infinity();
}
bool has_max(const Key& key) {
  return key.max < std::numeric_limits<double>::infinity();
}

std::string range_of(const Key& key) {
  if (has_min(key) && has_max(key)) return fmt::format("{} to {}", key.min, key.max);
  if (has_min(key)) return fmt::format("{} or more", key.min);
  return has_max(key) ? fmt::format("{} or less", key.max) : std::string();
}

}  // namespace

bool one_of(std::string_view word, std::string_view choices) {
  const std::vector<std::string> words = words_of(choices);
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool matches(std::string_view pattern, std::string_view name) {
  if (!pattern.ends_with('*')) return pattern == name;
  return name.starts_with(pattern.substr(0, pattern.size() - 1));
}

std::vector<std::string> words_of(std::string_view list) {
  std::vector<std::string> words;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    words.emplace_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return words;
}

std::string limits_of(const Key& key) {
  std::string words(key.unit);
  for (const std::string& more : {range_of(key), std::string(key.choices)}) {
    if (!more.empty()) words += (words.empty() ? "" : ", ") + more;
  }
  return words;
}

std::optional<x3d::BadValue> range_fault(const Key& key, std::span<const double> numbers, const std::string* text) {
  const std::string example = key.example.empty() ? std::string() : fmt::format(", like {}", key.example);
  if (text != nullptr && !key.choices.empty() && !one_of(*text, key.choices)) {
    const std::string near = text->size() < 3 ? std::string() : nearest(*text, words_of(key.choices));
    return x3d::BadValue{fmt::format("'{}' is not one of: {}", text->substr(0, 80), key.choices),
                         near.empty() ? "write one of them" + example : fmt::format("did you mean '{}'?", near)};
  }
  for (const double value : numbers) {
    if (value >= key.min && value <= key.max) continue;
    const std::string unit = key.unit.empty() ? "" : fmt::format(" {}", key.unit);
    return x3d::BadValue{fmt::format("{}{} is out of its range", value, unit),
                         fmt::format("write {}{}", range_of(key), example)};
  }
  if (key.kind == rotation && numbers.size() == 4 && numbers[3] != 0 &&
      numbers[0] * numbers[0] + numbers[1] * numbers[1] + numbers[2] * numbers[2] < 1e-18) {
    return x3d::BadValue{"the axis of the rotation has no length",
                         "write axis x y z and an angle in radians" + example};
  }
  return std::nullopt;
}

std::string_view kind_in_words(ValueKind kind) {
  switch (kind) {
    case string:
      return "MetadataString with one string";
    case strings:
      return "MetadataString";
    case number:
      return "MetadataDouble with one number";
    case numbers:
      return "MetadataDouble with numbers";
    case vector:
      return "MetadataDouble with 3 numbers";
    case rotation:
      return "MetadataDouble with 4 numbers: axis x y z, angle in radians";
    case matrix:
      return "MetadataDouble with 9 numbers";
    case boolean:
      return "MetadataBoolean with true or false";
    case set:
      return "MetadataSet";
  }
  return "";
}

}  // namespace mechane::scenario
