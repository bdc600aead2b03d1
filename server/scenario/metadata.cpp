#include "server/scenario/metadata.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "server/base/assert.hpp"
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

bool matches(std::string_view pattern, std::string_view name) {
  if (!pattern.ends_with('*')) return pattern == name;
  return name.starts_with(pattern.substr(0, pattern.size() - 1));
}

bool is_number(const Metadata& m) {
  return m.kind == MetadataKind::numbers || m.kind == MetadataKind::integers;
}

bool one_of(std::string_view word, std::string_view choices) {
  while (!choices.empty()) {
    const std::size_t end = std::min(choices.find(' '), choices.size());
    if (choices.substr(0, end) == word) return true;
    choices.remove_prefix(std::min(end + 1, choices.size()));
  }
  return false;
}

/// "MetadataDouble with 3 numbers": what to write for a kind of value; empty where the value is of that kind.
std::string kind_fault(ValueKind kind, const Metadata& m) {
  const auto unless = [](bool good, const char* wanted) { return good ? std::string() : std::string(wanted); };
  switch (kind) {
    case ValueKind::string:
      return unless(m.kind == MetadataKind::strings && m.strings.size() == 1, "a MetadataString with one string");
    case ValueKind::strings:
      return unless(m.kind == MetadataKind::strings, "a MetadataString");
    case ValueKind::number:
      return unless(is_number(m) && m.numbers.size() == 1, "a MetadataDouble with one number");
    case ValueKind::vector:
      return unless(is_number(m) && m.numbers.size() == 3, "a MetadataDouble with 3 numbers");
    case ValueKind::rotation:
      return unless(is_number(m) && m.numbers.size() == 4,
                    "a MetadataDouble with 4 numbers: axis x y z, angle in radians");
    case ValueKind::boolean:
      return unless(m.kind == MetadataKind::booleans && m.booleans.size() == 1, "a MetadataBoolean with true or false");
    case ValueKind::set:
      return unless(m.kind == MetadataKind::set, "a MetadataSet");
  }
  return {};
}

std::string range_fault(const Key& key, const Metadata& m) {
  if (key.kind == ValueKind::string && !key.choices.empty() && !one_of(m.strings.front(), key.choices)) {
    return fmt::format("'{}' is none of: {}", m.strings.front(), key.choices);
  }
  for (const double value : m.numbers) {
    if (value < key.min || value > key.max) {
      return fmt::format("{} {} is not between {} and {}", value, key.unit, key.min, key.max);
    }
  }
  if (key.kind == ValueKind::rotation && Vec3(m.numbers[0], m.numbers[1], m.numbers[2]).norm() < 1e-9 &&
      m.numbers[3] != 0) {
    return "the axis of the rotation has no length";
  }
  return {};
}

}  // namespace

const Metadata* Metadata::find(std::string_view child) const {
  const auto it = std::find_if(children.begin(), children.end(), [&](const Metadata& m) { return m.name == child; });
  return it == children.end() ? nullptr : &*it;
}

std::optional<Metadata> read_metadata(const Document& document, NodeId owner, std::string_view name,
                                      Problems& problems) {
  const auto is_named = [&](NodeId id) {
    return document[id].name == "MetadataSet" && attribute_or(document[document.resolve(id)], "name", {}) == name;
  };
  NodeId found;
  for (const NodeId child : document.child_elements(owner)) {
    if (!document[child].name.starts_with("Metadata") || document.container_field(child, "metadata") != "metadata")
      continue;
    if (is_named(child)) found = child;
    for (const NodeId inner : document.child_elements(document.resolve(child))) {
      if (!found && is_named(inner)) found = inner;
    }
  }
  Metadata metadata;
  if (!found || !MetadataReader(document, problems).read(found, 0, metadata)) return std::nullopt;
  return metadata;
}

Fields::Fields(const Metadata* set, const Table& table, std::string where, Problems& problems)
    : set_(set), table_(table), where_(std::move(where)) {
  if (set_ != nullptr) check(problems);
}

void Fields::check(Problems& problems) {
  std::vector<std::string> known;
  for (const Key& key : table_.keys)
    known.emplace_back(key.name);
  for (const Metadata& child : set_->children) {
    const auto key =
        std::find_if(table_.keys.begin(), table_.keys.end(), [&](const Key& k) { return matches(k.name, child.name); });
    if (key == table_.keys.end()) {
      problems.warning(child.line, where_, fmt::format("the key '{}' is not known here and does nothing", child.name),
                       suggest(child.name, known, "remove it"));
    } else if (check_value(*key, child, problems)) {
      good_[child.name] = &child;
    }
  }
  for (const Key& key : table_.keys) {
    if (!key.required || set_->find(key.name) != nullptr) continue;
    problems.error(
        set_->line, where_, fmt::format("the key '{}' is missing", key.name),
        fmt::format("add it: {}{}", key.summary, key.example.empty() ? "" : fmt::format(", like {}", key.example)));
  }
}

bool Fields::check_value(const Key& key, const Metadata& value, Problems& problems) const {
  if (const std::string wanted = kind_fault(key.kind, value); !wanted.empty()) {
    problems.error(value.line, where_, fmt::format("'{}' is of the wrong type or count", value.name),
                   fmt::format("write {}{}", wanted, key.example.empty() ? "" : fmt::format(", like {}", key.example)));
    return false;
  }
  if (const std::string fault = range_fault(key, value); !fault.empty()) {
    problems.error(
        value.line, where_, fmt::format("'{}': {}", value.name, fault),
        key.example.empty() ? std::string("correct it") : fmt::format("write something like {}", key.example));
    return false;
  }
  return true;
}

const Key& Fields::key(std::string_view name, ValueKind kind) const {
  const auto it =
      std::find_if(table_.keys.begin(), table_.keys.end(), [&](const Key& k) { return matches(k.name, name); });
  MECHANE_ASSERT(it != table_.keys.end() && it->kind == kind);
  return *it;
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
