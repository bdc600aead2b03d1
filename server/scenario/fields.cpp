#include "server/scenario/fields.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "server/base/assert.hpp"
#include "server/base/suggestion.hpp"

namespace mechane::scenario {
namespace {

bool is_number(const x3d::Metadata& m) {
  return m.kind == x3d::MetadataKind::numbers || m.kind == x3d::MetadataKind::integers;
}

/// A value's kind and count: "2 numbers".
std::string value_in_words(const x3d::Metadata& m) {
  const auto count = [](std::size_t n, const char* word) { return fmt::format("{} {}{}", n, word, n == 1 ? "" : "s"); };
  switch (m.kind) {
    case x3d::MetadataKind::set:
      return "a set";
    case x3d::MetadataKind::strings:
      return count(m.strings.size(), "string");
    case x3d::MetadataKind::booleans:
      return count(m.booleans.size(), "boolean");
    case x3d::MetadataKind::numbers:
    case x3d::MetadataKind::integers:
    case x3d::MetadataKind::unreadable:
      break;
  }
  return count(m.numbers.size(), "number");
}

/// How many numbers a kind has; 0 for kinds without numbers.
std::size_t count_of(ValueKind kind) {
  switch (kind) {
    case ValueKind::number:
      return 1;
    case ValueKind::vector:
      return 3;
    case ValueKind::rotation:
      return 4;
    case ValueKind::matrix:
      return 9;
    case ValueKind::string:
    case ValueKind::strings:
    case ValueKind::numbers:
    case ValueKind::boolean:
    case ValueKind::set:
      break;
  }
  return 0;
}

/// Whether a value is of a kind.
bool is_of_kind(ValueKind kind, const x3d::Metadata& m) {
  switch (kind) {
    case ValueKind::string:
      return m.kind == x3d::MetadataKind::strings && m.strings.size() == 1;
    case ValueKind::strings:
      return m.kind == x3d::MetadataKind::strings;
    case ValueKind::numbers:
      return is_number(m);
    case ValueKind::number:
    case ValueKind::vector:
    case ValueKind::rotation:
    case ValueKind::matrix:
      return is_number(m) && m.numbers.size() == count_of(kind);
    case ValueKind::boolean:
      return m.kind == x3d::MetadataKind::booleans && m.booleans.size() == 1;
    case ValueKind::set:
      return m.kind == x3d::MetadataKind::set;
  }
  return false;
}

/// The names that an unknown name may have meant: for "objct:INNER" the pattern "object:*" gives "object:INNER".
std::vector<std::string> candidates(const Table& table, const std::string& name) {
  const std::size_t colon = name.find(':');
  const std::string rest = colon == std::string::npos ? "1" : name.substr(colon + 1);
  std::vector<std::string> all;
  for (const Key& key : table.keys)
    all.push_back(key.name.ends_with('*') ? std::string(key.name.substr(0, key.name.size() - 1)) + rest
                                          : std::string(key.name));
  return all;
}

}  // namespace

Fields::Fields(const x3d::Metadata* set, const Table& table, std::string where, x3d::Problems& problems)
    : set_(set), table_(table), where_(std::move(where)) {
  if (set_ != nullptr) check(problems);
}

void Fields::check(x3d::Problems& problems) {
  std::vector<std::string> meant;
  for (const x3d::Metadata& child : set_->children) {
    const Key* key = table_.find(child.name);
    if (key == nullptr) {
      const std::vector<std::string> known = candidates(table_, child.name);
      // "triger" gets a number too, so that it is near to "trigger:1".
      const bool numbered = child.name.find(':') == std::string::npos && nearest(child.name, known).empty();
      const std::string word = child.name + (numbered ? ":1" : "");
      problems.unknown(child.line, where_, fmt::format("the key '{}' is not known here and does nothing", child.name),
                       word, known);
      meant.push_back(nearest(word, known));
      has_faults_ = has_faults_ || !meant.back().empty();
    } else if (check_value(*key, child, problems)) {
      good_[child.name] = &child;
    } else {
      has_faults_ = true;
    }
  }
  for (const Key& key : table_.keys) {
    if (!key.required || set_->find(key.name) != nullptr || has_like(key.unless)) continue;
    // It is given, but misspelt, which has been reported.
    if (std::find(meant.begin(), meant.end(), key.name) != meant.end()) continue;
    has_faults_ = true;
    problems.error(
        ErrorCode::missing, set_->line, where_, fmt::format("the key '{}' is missing", key.name),
        fmt::format("add it: {}{}", key.summary, key.example.empty() ? "" : fmt::format(", like {}", key.example)));
  }
}

bool Fields::has_like(std::string_view pattern) const {
  return !pattern.empty() && std::any_of(set_->children.begin(), set_->children.end(),
                                         [&](const x3d::Metadata& m) { return matches(pattern, m.name); });
}

bool Fields::check_value(const Key& key, const x3d::Metadata& value, x3d::Problems& problems) const {
  if (value.kind == x3d::MetadataKind::unreadable) return false;  // reported as it was read
  if (!is_of_kind(key.kind, value)) {
    const auto comma =
        is_number(value) ? x3d::comma_fault(value.commas, value.numbers.size(), count_of(key.kind)) : std::nullopt;
    if (comma) {
      problems.error(ErrorCode::invalid_value, value.line, where_, fmt::format("'{}': {}", value.name, comma->what),
                     comma->remedy);
      return false;
    }
    problems.error(ErrorCode::invalid_value, value.line, where_,
                   fmt::format("'{}' is of the wrong type or count: it is {}", value.name, value_in_words(value)),
                   fmt::format("write a {}{}", kind_in_words(key.kind),
                               key.example.empty() ? "" : fmt::format(", like {}", key.example)));
    return false;
  }
  const std::string* text = key.kind == ValueKind::string ? &value.strings.front() : nullptr;
  if (const auto fault = range_fault(key, value.numbers, text)) {
    problems.error(ErrorCode::invalid_value, value.line, where_, fmt::format("'{}': {}", value.name, fault->what),
                   fault->remedy);
    return false;
  }
  return true;
}

const x3d::Metadata* Fields::value(std::string_view name) const {
  const auto it = good_.find(name);
  return it == good_.end() ? nullptr : it->second;
}

bool Fields::given(std::string_view name) const {
  return value(name) != nullptr;
}

double Fields::number(std::string_view name) const {
  const Key& of = table_.key(name, ValueKind::number);
  const x3d::Metadata* found = value(name);
  return found != nullptr ? found->numbers.front() : of.default_number;
}

std::vector<double> Fields::numbers(std::string_view name) const {
  const x3d::Metadata* found = value(name);
  return found != nullptr ? found->numbers : std::vector<double>();
}

bool Fields::boolean(std::string_view name) const {
  const Key& of = table_.key(name, ValueKind::boolean);
  const x3d::Metadata* found = value(name);
  return found != nullptr ? found->booleans.front() : of.default_number != 0;
}

std::string Fields::string(std::string_view name) const {
  const Key& of = table_.key(name, ValueKind::string);
  const x3d::Metadata* found = value(name);
  return found != nullptr ? found->strings.front() : std::string(of.default_text);
}

std::vector<std::string> Fields::strings(std::string_view name) const {
  static_cast<void>(table_.key(name, ValueKind::strings));
  const x3d::Metadata* found = value(name);
  return found != nullptr ? found->strings : std::vector<std::string>();
}

Vec3 Fields::vector(std::string_view name) const {
  const Key& of = table_.key(name, ValueKind::vector);
  const x3d::Metadata* found = value(name);
  if (found == nullptr) return Vec3::Constant(of.default_number);
  return {found->numbers[0], found->numbers[1], found->numbers[2]};
}

Quat Fields::rotation(std::string_view name) const {
  static_cast<void>(table_.key(name, ValueKind::rotation));
  const x3d::Metadata* found = value(name);
  if (found == nullptr || found->numbers[3] == 0) return Quat::Identity();
  const Vec3 axis = Vec3(found->numbers[0], found->numbers[1], found->numbers[2]).normalized();
  return Quat(Eigen::AngleAxisd(found->numbers[3], axis));
}

const x3d::Metadata* Fields::set(std::string_view name) const {
  static_cast<void>(table_.key(name, ValueKind::set));
  return value(name);
}

std::vector<const x3d::Metadata*> Fields::sets_like(std::string_view pattern) const {
  static_cast<void>(table_.key(pattern, ValueKind::set));
  std::vector<const x3d::Metadata*> found;
  if (set_ == nullptr) return found;
  for (const x3d::Metadata& child : set_->children) {
    if (matches(pattern, child.name) && value(child.name) != nullptr) found.push_back(&child);
  }
  return found;
}

int Fields::line(std::string_view name) const {
  if (set_ == nullptr) return 0;
  const x3d::Metadata* found = set_->find(name);
  return found != nullptr ? found->line : set_->line;
}

}  // namespace mechane::scenario
