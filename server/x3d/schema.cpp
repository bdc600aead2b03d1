#include "server/x3d/schema.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "server/base/assert.hpp"
#include "server/x3d/node_types.hpp"

namespace mechane::x3d {
namespace {

double number_in(std::string_view text) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  MECHANE_ASSERT(status == std::errc{} && end == text.data() + text.size());
  return value;
}

std::vector<std::string_view> split(std::string_view text, std::string_view at) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t begin = text.find_first_not_of(at);
    if (begin == std::string_view::npos) break;
    const std::size_t end = std::min(text.find_first_of(at, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    text.remove_prefix(end);
  }
  return words;
}

/// "name:Type[0,1]=0.5"
Field field_in(std::string_view text) {
  Field field;
  const std::size_t colon = text.find(':');
  field.name = text.substr(0, colon);
  text.remove_prefix(colon + 1);
  const std::size_t equals = text.find('=');
  if (equals != std::string_view::npos) field.default_value = text.substr(equals + 1);
  text = text.substr(0, equals);
  const std::size_t open = text.find_first_of("[(");
  field.type = text.substr(0, open);
  if (open == std::string_view::npos) return field;
  const std::string_view range = text.substr(open);
  const std::size_t comma = range.find(',');
  const std::string_view least = range.substr(1, comma - 1);
  const std::string_view most = range.substr(comma + 1, range.size() - comma - 2);
  field.has_min = !least.empty();
  field.has_max = !most.empty();
  if (field.has_min) field.min = number_in(least);
  if (field.has_max) field.max = number_in(most);
  field.above_min = range.front() == '(';
  field.below_max = range.back() == ')';
  return field;
}

/// "+slot*:Type|Type"
Slot slot_in(std::string_view text) {
  Slot slot;
  const std::size_t colon = text.find(':');
  slot.name = text.substr(1, colon - 1);
  slot.many = slot.name.ends_with('*');
  if (slot.many) slot.name.remove_suffix(1);
  slot.accepts = split(text.substr(colon + 1), "|");
  return slot;
}

/// The shape of a field type's value.
struct Shape {
  enum class Of { reals, integers, booleans, strings, text };
  Of of = Of::text;
  std::size_t width = 1;  // numbers that make one value
  bool many = false;
  bool unit_interval = false;
};

Shape shape_of(std::string_view type) {
  using Of = Shape::Of;
  const bool many = type.starts_with("MF");
  const std::string_view kind = type.substr(2);
  if (kind == "Bool") return {Of::booleans, 1, many, false};
  if (kind == "String") return {many ? Of::strings : Of::text, 1, many, false};
  if (kind == "Image") return {Of::text, 1, false, false};  // its numbers are often written in base 16
  if (kind == "Int32") return {Of::integers, 1, many, false};
  if (kind == "Color") return {Of::reals, 3, many, true};
  if (kind == "ColorRGBA") return {Of::reals, 4, many, true};
  if (kind == "Rotation") return {Of::reals, 4, many, false};
  if (kind.starts_with("Vec")) return {Of::reals, static_cast<std::size_t>(kind[3] - '0'), many, false};
  if (kind.starts_with("Matrix")) {
    const auto side = static_cast<std::size_t>(kind[6] - '0');
    return {Of::reals, side * side, many, false};
  }
  return {Of::reals, 1, many, false};
}

std::string wanted(const Shape& shape) {
  if (shape.many) return fmt::format("write groups of {} numbers", shape.width);
  return shape.width == 1 ? std::string("write one number") : fmt::format("write {} numbers", shape.width);
}

std::optional<BadValue> count_fault(const Shape& shape, std::size_t count) {
  const bool good = shape.many ? count % shape.width == 0 : count == shape.width;
  if (good) return std::nullopt;
  return BadValue{fmt::format("it has {} number{}", count, count == 1 ? "" : "s"), wanted(shape)};
}

}  // namespace

std::string Field::range() const {
  if (has_min && has_max) {
    const std::string_view apart = above_min || below_max ? " (ends not allowed)" : "";
    return fmt::format("{} to {}{}", min, max, above_min && !below_max ? " (not the lower end)" : apart);
  }
  if (has_min) return above_min ? fmt::format("above {}", min) : fmt::format("{} or more", min);
  return has_max ? fmt::format("{} or less", max) : std::string();
}

std::optional<BadValue> Field::fault(std::string_view text) const {
  const Shape shape = shape_of(type);
  if (shape.of == Shape::Of::text) return std::nullopt;
  if (shape.of == Shape::Of::strings) {
    const auto values = parse_strings(text);
    if (values) return std::nullopt;
    return BadValue{values.error().what, "write " + in_straight_quotes(name, text)};
  }
  if (shape.of == Shape::Of::booleans) {
    const auto values = parse_booleans(text);
    if (!values) return values.error();
    if (!shape.many && values->size() != 1) return BadValue{"it is not one value", "write true or false"};
    return std::nullopt;
  }
  const auto values = shape.of == Shape::Of::integers ? parse_integers(text) : parse_numbers(text);
  if (!values) return values.error();
  if (auto fault = count_fault(shape, values->size())) {
    auto comma = shape.many ? std::nullopt : comma_fault(decimal_commas(text), values->size(), shape.width);
    return comma ? comma : fault;
  }
  for (const double value : *values) {
    const bool low = (has_min && (above_min ? value <= min : value < min)) || (shape.unit_interval && value < 0);
    const bool high = (has_max && (below_max ? value >= max : value > max)) || (shape.unit_interval && value > 1);
    if (!low && !high) continue;
    return BadValue{fmt::format("{} is out of its range", value),
                    fmt::format("write {}", shape.unit_interval ? "numbers from 0 to 1" : range())};
  }
  return std::nullopt;
}

const Field* NodeType::field(std::string_view wanted_name) const {
  const auto it = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == wanted_name; });
  return it == fields.end() ? nullptr : &*it;
}

const Slot* NodeType::slot(std::string_view wanted_name) const {
  const auto it = std::find_if(slots.begin(), slots.end(), [&](const Slot& s) { return s.name == wanted_name; });
  return it == slots.end() ? nullptr : &*it;
}

bool NodeType::is_statement() const {
  return container.empty() && std::find(bases.begin(), bases.end(), "X3DStatement") != bases.end();
}

Schema::Schema() {
  NodeType* type = nullptr;
  for (const std::string_view line : split(node_types(), "\n")) {
    if (line.front() == '#') continue;
    std::vector<std::string_view> words = split(line, " ");
    if (line.front() != ' ') {
      const std::string_view head = words.front();
      const std::size_t colon = head.find(':');
      const std::string_view name = head.substr(0, std::min(head.find('@'), colon));
      type = &types_[name];
      type->name = name;
      if (name.size() < colon) type->container = head.substr(name.size() + 1, colon - name.size() - 1);
      type->bases = split(head.substr(colon + 1), ",");
      words.erase(words.begin());
    }
    for (const std::string_view word : words) {
      if (word.front() == '+') {
        type->slots.push_back(slot_in(word));
      } else {
        type->fields.push_back(field_in(word));
      }
    }
  }
  // What bases have, their heirs have too, unless they say otherwise.
  for (auto& [name, heir] : types_) {
    std::vector<std::string_view> open = heir.bases;
    while (!open.empty()) {
      const std::string_view base_name = open.back();
      open.pop_back();
      const auto base = types_.find(base_name);
      MECHANE_ASSERT(base != types_.end());
      for (const Field& field : base->second.fields) {
        if (heir.field(field.name) == nullptr) heir.fields.push_back(field);
      }
      for (const Slot& slot : base->second.slots) {
        if (heir.slot(slot.name) == nullptr) heir.slots.push_back(slot);
      }
      open.insert(open.end(), base->second.bases.begin(), base->second.bases.end());
    }
  }
}

const Schema& Schema::standard() {
  static const Schema kSchema;
  return kSchema;
}

const NodeType* Schema::find(std::string_view name) const {
  const auto it = types_.find(name);
  return it == types_.end() || it->second.is_abstract() ? nullptr : &it->second;
}

bool Schema::is_a(std::string_view type, std::string_view base) const {
  if (type == base || base == "X3DNode") return true;
  const auto it = types_.find(type);
  if (it == types_.end()) return false;
  return std::any_of(it->second.bases.begin(), it->second.bases.end(),
                     [&](std::string_view next) { return is_a(next, base); });
}

bool Schema::accepts(const Slot& slot, std::string_view type) const {
  return std::any_of(slot.accepts.begin(), slot.accepts.end(),
                     [&](std::string_view accepted) { return is_a(type, accepted); });
}

std::vector<std::string> Schema::names() const {
  std::vector<std::string> names;
  for (const auto& [name, type] : types_) {
    if (!type.is_abstract()) names.emplace_back(name);
  }
  return names;
}

}  // namespace mechane::x3d
