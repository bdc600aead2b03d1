#include "server/scenario/metadata.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "server/base/assert.hpp"
#include "server/scenario/key_scope.hpp"
#include "server/scenario/values.hpp"

namespace mechane::scenario {
namespace {

// A USE copies what it stands for, and copies of copies grow by powers: what one set may come to is bounded.
constexpr std::size_t kMostNodes = 100'000;
constexpr std::size_t kMostBytes = 8u << 20;
constexpr std::size_t kDeepest = 64;

std::string attribute_or(const Node& node, std::string_view name, const std::string& otherwise) {
  const std::string* value = node.attribute(name);
  return value != nullptr ? *value : otherwise;
}

/// Reads one tree of metadata. Each method returns false after it has said what is wrong.
class MetadataReader {
 public:
  MetadataReader(const Document& document, Problems& problems) : document_(document), problems_(problems) {}

  bool read(NodeId id, std::size_t depth, Metadata& out) {
    const Node& node = document_[document_.resolve(id)];
    out.line = document_[id].line;
    out.name = attribute_or(node, "name", {});
    const std::string* value = node.attribute("value");
    bytes_ += value != nullptr ? value->size() : 0;
    if (++nodes_ > kMostNodes || bytes_ > kMostBytes || depth > kDeepest) {
      return refuse(out, "the metadata is too large or too deep once every USE stands for a copy",
                    "write less of it, or without USE");
    }
    if (node.name == "MetadataSet") return read_children(document_.resolve(id), depth, out);
    return read_value(node.name, value != nullptr ? *value : std::string(), out);
  }

 private:
  bool refuse(const Metadata& at, std::string what, std::string remedy) {
    problems_.error(at.line, fmt::format("metadata '{}'", at.name), std::move(what), std::move(remedy));
    return false;
  }

  bool read_children(NodeId set, std::size_t depth, Metadata& out) {
    bool good = true;
    for (const NodeId child : document_.child_elements(set)) {
      if (!document_[child].name.starts_with("Metadata") || document_.container_field(child, "value") != "value")
        continue;
      Metadata metadata;
      if (!read(child, depth + 1, metadata)) {
        if (problems_.full() || nodes_ > kMostNodes || bytes_ > kMostBytes) return false;
        good = false;
      } else if (const Metadata* before = out.find(metadata.name)) {
        good = refuse(metadata, fmt::format("'{}' is already given in line {}", metadata.name, before->line),
                      "keep one of them");
      } else {
        out.children.push_back(std::move(metadata));
      }
    }
    return good;
  }

  bool read_value(const std::string& type, const std::string& text, Metadata& out) {
    if (type != "MetadataString" && text.find('"') != std::string::npos)
      return refuse(out, fmt::format("a {} holds no words", type), "write a MetadataString, or take the quotes away");
    if (type == "MetadataString") return take(parse_strings(text), MetadataKind::strings, out.strings, out);
    if (type == "MetadataDouble" || type == "MetadataFloat")
      return take(parse_numbers(text), MetadataKind::numbers, out.numbers, out);
    if (type == "MetadataInteger") return take(parse_integers(text), MetadataKind::integers, out.numbers, out);
    if (type == "MetadataBoolean") return take(parse_booleans(text), MetadataKind::booleans, out.booleans, out);
    return refuse(out, fmt::format("{} is no metadata node of X3D", type),
                  "use MetadataSet, String, Double, Float, Integer or Boolean");
  }

  template <class T>
  bool take(Value<std::vector<T>> value, MetadataKind kind, std::vector<T>& into, Metadata& out) {
    if (!value) return refuse(out, value.error().what, value.error().remedy);
    out.kind = kind;
    into = std::move(*value);
    return true;
  }

  const Document& document_;
  Problems& problems_;
  std::size_t nodes_ = 0;
  std::size_t bytes_ = 0;
};

bool is_number(const Metadata& m) {
  return m.kind == MetadataKind::numbers || m.kind == MetadataKind::integers;
}

/// What a value is: "2 numbers".
std::string value_in_words(const Metadata& m) {
  const auto count = [](std::size_t n, const char* word) { return fmt::format("{} {}{}", n, word, n == 1 ? "" : "s"); };
  switch (m.kind) {
    case MetadataKind::set:
      return "a set";
    case MetadataKind::strings:
      return count(m.strings.size(), "string");
    case MetadataKind::booleans:
      return count(m.booleans.size(), "boolean");
    case MetadataKind::numbers:
    case MetadataKind::integers:
      break;
  }
  return count(m.numbers.size(), "number");
}

/// Whether a value is of a kind.
bool is_of_kind(ValueKind kind, const Metadata& m) {
  switch (kind) {
    case ValueKind::string:
      return m.kind == MetadataKind::strings && m.strings.size() == 1;
    case ValueKind::strings:
      return m.kind == MetadataKind::strings;
    case ValueKind::number:
      return is_number(m) && m.numbers.size() == 1;
    case ValueKind::vector:
      return is_number(m) && m.numbers.size() == 3;
    case ValueKind::rotation:
      return is_number(m) && m.numbers.size() == 4;
    case ValueKind::matrix:
      return is_number(m) && m.numbers.size() == 9;
    case ValueKind::boolean:
      return m.kind == MetadataKind::booleans && m.booleans.size() == 1;
    case ValueKind::set:
      return m.kind == MetadataKind::set;
  }
  return false;
}

/// What may have been meant by a name: for "objct:INNER" the pattern "object:*" stands as "object:INNER".
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

const Metadata* Metadata::find(std::string_view child) const {
  const auto it = std::find_if(children.begin(), children.end(), [&](const Metadata& m) { return m.name == child; });
  return it == children.end() ? nullptr : &*it;
}

std::optional<Metadata> read_metadata(const Document& document, NodeId owner, std::string_view name,
                                      Problems& problems) {
  const NodeId found = find_set(document, owner, name);
  Metadata metadata;
  if (!found || !MetadataReader(document, problems).read(found, 0, metadata)) return std::nullopt;
  return metadata;
}

Fields::Fields(const Metadata* set, const Table& table, std::string where, Problems& problems)
    : set_(set), table_(table), where_(std::move(where)) {
  if (set_ != nullptr) check(problems);
}

void Fields::check(Problems& problems) {
  std::vector<std::string> meant;
  for (const Metadata& child : set_->children) {
    const Key* key = table_.find(child.name);
    if (key == nullptr) {
      const std::vector<std::string> known = candidates(table_, child.name);
      // "triger" is near to "trigger:1" once it has a number too.
      const bool numbered = child.name.find(':') == std::string::npos && nearest(child.name, known).empty();
      const std::string word = child.name + (numbered ? ":1" : "");
      problems.unknown(child.line, where_, fmt::format("the key '{}' is not known here and does nothing", child.name),
                       word, known);
      meant.push_back(nearest(word, known));
    } else if (check_value(*key, child, problems)) {
      good_[child.name] = &child;
    }
  }
  for (const Key& key : table_.keys) {
    if (!key.required || set_->find(key.name) != nullptr || has_like(key.unless)) continue;
    // It is there, misspelt, and that has been said.
    if (std::find(meant.begin(), meant.end(), key.name) != meant.end()) continue;
    problems.error(
        set_->line, where_, fmt::format("the key '{}' is missing", key.name),
        fmt::format("add it: {}{}", key.summary, key.example.empty() ? "" : fmt::format(", like {}", key.example)));
  }
}

bool Fields::has_like(std::string_view pattern) const {
  return !pattern.empty() && std::any_of(set_->children.begin(), set_->children.end(),
                                         [&](const Metadata& m) { return matches(pattern, m.name); });
}

bool Fields::check_value(const Key& key, const Metadata& value, Problems& problems) const {
  if (!is_of_kind(key.kind, value)) {
    const bool comma = key.kind == ValueKind::number && is_number(value) && value.numbers.size() == 2;
    problems.error(value.line, where_,
                   fmt::format("'{}' is of the wrong type or count: it is {}", value.name, value_in_words(value)),
                   fmt::format("write a {}{}{}", kind_in_words(key.kind),
                               key.example.empty() ? "" : fmt::format(", like {}", key.example),
                               comma ? "; decimals have a point, a comma parts two numbers" : ""));
    return false;
  }
  const std::string* text = key.kind == ValueKind::string ? &value.strings.front() : nullptr;
  if (const auto fault = range_fault(key, value.numbers, text)) {
    problems.error(value.line, where_, fmt::format("'{}': {}", value.name, fault->what), fault->remedy);
    return false;
  }
  return true;
}

const Key& Fields::key(std::string_view name, ValueKind kind) const {
  const Key* found = table_.find(name);
  MECHANE_ASSERT(found != nullptr && found->kind == kind);
  return *found;
}

const Metadata* Fields::value(std::string_view name) const {
  const auto it = good_.find(name);
  return it == good_.end() ? nullptr : it->second;
}

bool Fields::given(std::string_view name) const {
  return value(name) != nullptr;
}

double Fields::number(std::string_view name) const {
  const Key& of = key(name, ValueKind::number);
  const Metadata* found = value(name);
  return found != nullptr ? found->numbers.front() : of.default_number;
}

bool Fields::boolean(std::string_view name) const {
  const Key& of = key(name, ValueKind::boolean);
  const Metadata* found = value(name);
  return found != nullptr ? found->booleans.front() : of.default_number != 0;
}

std::string Fields::string(std::string_view name) const {
  const Key& of = key(name, ValueKind::string);
  const Metadata* found = value(name);
  return found != nullptr ? found->strings.front() : std::string(of.default_text);
}

std::vector<std::string> Fields::strings(std::string_view name) const {
  static_cast<void>(key(name, ValueKind::strings));
  const Metadata* found = value(name);
  return found != nullptr ? found->strings : std::vector<std::string>();
}

Vec3 Fields::vector(std::string_view name) const {
  const Key& of = key(name, ValueKind::vector);
  const Metadata* found = value(name);
  if (found == nullptr) return Vec3::Constant(of.default_number);
  return {found->numbers[0], found->numbers[1], found->numbers[2]};
}

Quat Fields::rotation(std::string_view name) const {
  static_cast<void>(key(name, ValueKind::rotation));
  const Metadata* found = value(name);
  if (found == nullptr || found->numbers[3] == 0) return Quat::Identity();
  const Vec3 axis = Vec3(found->numbers[0], found->numbers[1], found->numbers[2]).normalized();
  return Quat(Eigen::AngleAxisd(found->numbers[3], axis));
}

const Metadata* Fields::set(std::string_view name) const {
  static_cast<void>(key(name, ValueKind::set));
  return value(name);
}

std::vector<const Metadata*> Fields::sets_like(std::string_view pattern) const {
  static_cast<void>(key(pattern, ValueKind::set));
  std::vector<const Metadata*> found;
  if (set_ == nullptr) return found;
  for (const Metadata& child : set_->children) {
    if (matches(pattern, child.name) && value(child.name) != nullptr) found.push_back(&child);
  }
  return found;
}

int Fields::line(std::string_view name) const {
  if (set_ == nullptr) return 0;
  const Metadata* found = set_->find(name);
  return found != nullptr ? found->line : set_->line;
}

}  // namespace mechane::scenario
