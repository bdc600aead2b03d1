#include "server/scenario/attributes.hpp"

#include <fmt/format.h>

#include "server/base/assert.hpp"
#include "server/x3d/node_fields.hpp"
#include "server/x3d/values.hpp"

namespace mechane::scenario {
namespace {

const Table& table_of(const x3d::Node& node) {
  const Table* table = find_node_table(node.name);
  MECHANE_ASSERT(table != nullptr);
  return *table;
}

const x3d::NodeType& type_of(const x3d::Node& node) {
  const x3d::NodeType* type = x3d::Schema::standard().find(node.name);
  MECHANE_ASSERT(type != nullptr);
  return *type;
}

}  // namespace

std::optional<x3d::BadValue> attribute_fault(const x3d::Field& field, const Key* key, std::string_view text) {
  if (auto fault = field.fault(text)) return fault;
  if (key == nullptr) return std::nullopt;
  std::vector<double> numbers;
  if (key->kind != ValueKind::string && key->kind != ValueKind::strings && key->kind != ValueKind::boolean) {
    if (const auto parsed = x3d::parse_numbers(text)) numbers = *parsed;
  }
  const std::string word(text);
  return range_fault(*key, numbers, key->kind == ValueKind::string ? &word : nullptr);
}

Attributes::Attributes(const x3d::Document& document, x3d::NodeId id, x3d::Problems& problems)
    : node_(document[id]),
      table_(table_of(node_)),
      type_(type_of(node_)),
      where_(document.describe(id)),
      problems_(problems) {}

bool Attributes::given(std::string_view name) const {
  return node_.attribute(name) != nullptr;
}

void Attributes::error(ErrorCode code, std::string what, std::string remedy) {
  problems_.error(code, node_.line, where_, std::move(what), std::move(remedy));
}

void Attributes::warning(ErrorCode code, std::string what, std::string remedy) {
  problems_.warning(code, node_.line, where_, std::move(what), std::move(remedy));
}

std::string_view Attributes::value(std::string_view name) const {
  const x3d::Field* field = type_.field(name);
  MECHANE_ASSERT(field != nullptr);
  const std::string* text = node_.attribute(name);
  if (text == nullptr || attribute_fault(*field, table_.find(name), *text)) return field->default_value;
  return *text;
}

std::vector<double> Attributes::numbers(std::string_view name) const {
  auto values = x3d::parse_numbers(value(name));
  MECHANE_ASSERT(values.has_value());
  return std::move(*values);
}

double Attributes::number(std::string_view name) const {
  static_cast<void>(table_.key(name, ValueKind::number));
  const std::vector<double> values = numbers(name);
  return values.empty() ? 0 : values.front();
}

Vec3 Attributes::vector(std::string_view name) const {
  static_cast<void>(table_.key(name, ValueKind::vector));
  const std::vector<double> values = numbers(name);
  MECHANE_ASSERT(values.size() == 3);
  return {values[0], values[1], values[2]};
}

Quat Attributes::rotation(std::string_view name) const {
  static_cast<void>(table_.key(name, ValueKind::rotation));
  return x3d::rotation_of(numbers(name));
}

Mat3 Attributes::symmetric_matrix(std::string_view name) {
  static_cast<void>(table_.key(name, ValueKind::matrix));
  const std::vector<double> values = numbers(name);
  MECHANE_ASSERT(values.size() == 9);
  const Mat3 matrix = Eigen::Map<const Mat3>(values.data());
  if (matrix.isApprox(matrix.transpose(), 1e-6)) return matrix;
  error(ErrorCode::invalid_value, fmt::format("{} is not symmetric", name),
        "write the same number on both sides of the diagonal");
  return Mat3::Identity();
}

bool Attributes::boolean(std::string_view name) const {
  static_cast<void>(table_.key(name, ValueKind::boolean));
  const auto values = x3d::parse_booleans(value(name));
  MECHANE_ASSERT(values.has_value() && values->size() == 1);
  return values->front();
}

std::vector<std::string> Attributes::strings(std::string_view name) const {
  static_cast<void>(table_.key(name, ValueKind::strings));
  auto values = x3d::parse_strings(value(name));
  MECHANE_ASSERT(values.has_value());
  return std::move(*values);
}

std::string Attributes::text(std::string_view name) const {
  static_cast<void>(table_.key(name, ValueKind::string));
  const std::string* text = node_.attribute(name);
  return text != nullptr ? *text : std::string();
}

}  // namespace mechane::scenario
