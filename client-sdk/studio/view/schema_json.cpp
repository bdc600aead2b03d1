#include "client-sdk/studio/view/schema_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "client-sdk/studio/edits/parts.hpp"
#include "server/agents/registry.hpp"
#include "server/machines/registry.hpp"
#include "server/scenario/schema.hpp"
#include "server/x3d/schema.hpp"

namespace mechane::studio {
namespace {

using SchemaJson = nlohmann::json;
using scenario::ValueKind;

std::string_view type_word(ValueKind kind) {
  switch (kind) {
    case ValueKind::string:
      return "string";
    case ValueKind::strings:
      return "strings";
    case ValueKind::number:
      return "number";
    case ValueKind::numbers:
      return "numbers";
    case ValueKind::vector:
      return "vector";
    case ValueKind::rotation:
      return "rotation";
    case ValueKind::matrix:
      return "matrix";
    case ValueKind::boolean:
      return "boolean";
    case ValueKind::set:
      break;
  }
  return "set";
}

std::string_view word_of(scenario::Names names) {
  using scenario::Names;
  switch (names) {
    case Names::body:
      return "body";
    case Names::joint:
      return "joint";
    case Names::agent:
      return "agent";
    case Names::quantity:
      return "quantity";
    case Names::step:
      return "step";
    case Names::activity:
      return "activity";
    case Names::model:
      return "model";
    case Names::source:
      return "source";
    case Names::language:
      return "language";
    case Names::view:
      return "view";
    case Names::formula:
      return "formula";
    case Names::nothing:
      break;
  }
  return {};
}

std::string_view word_of(state::Reference reference) {
  using state::Reference;
  switch (reference) {
    case Reference::body:
      return "body";
    case Reference::joint:
      return "joint";
    case Reference::agent:
      return "agent";
    case Reference::activity:
      return "activity";
    case Reference::quantity:
      return "quantity";
    case Reference::machine:
      return "machine";
    case Reference::expression:
      return "formula";
    case Reference::none:
      break;
  }
  return {};
}

void put(SchemaJson& out, const char* name, std::string_view text) {
  if (!text.empty()) out[name] = text;
}

void put_range(SchemaJson& out, double least, double most) {
  if (std::isfinite(least)) out["least"] = least;
  if (std::isfinite(most)) out["most"] = most;
}

SchemaJson key_json(const scenario::Key& key) {
  SchemaJson out{{"name", key.name}, {"type", type_word(key.kind)}, {"doc", key.summary}};
  put(out, "unit", key.unit);
  put_range(out, key.min, key.max);
  if (!key.choices.empty()) out["choices"] = scenario::words_of(key.choices);
  if (key.required) out["required"] = true;
  put(out, "unless", key.unless);
  put(out, "names", word_of(key.names));
  put(out, "example", key.example);
  if (key.required) return out;
  if (key.kind == ValueKind::number) out["default"] = key.default_number;
  if (key.kind == ValueKind::boolean && key.default_text.empty()) out["default"] = key.default_number != 0;
  if (key.kind == ValueKind::string) put(out, "default", key.default_text);
  return out;
}

SchemaJson table_json(const scenario::Table& table, std::string_view name);

/// A key that is a set, as a table of that name. Sets whose names the author chooses are described once, as "*".
SchemaJson set_json(const scenario::Key& key) {
  if (!key.free_names && key.inner != nullptr) {
    SchemaJson out = table_json(*key.inner, key.name);
    out["doc"] = key.summary;
    return out;
  }
  SchemaJson sets = SchemaJson::array();
  // Those of agents and machines are in the lists of their types.
  if (key.inner != nullptr) sets.push_back(table_json(*key.inner, "*"));
  return {{"name", key.name}, {"doc", key.summary}, {"keys", SchemaJson::array()}, {"sets", std::move(sets)}};
}

SchemaJson table_json(const scenario::Table& table, std::string_view name) {
  SchemaJson keys = SchemaJson::array(), sets = SchemaJson::array();
  for (const scenario::Key& key : table.keys) {
    if (key.kind == ValueKind::set)
      sets.push_back(set_json(key));
    else
      keys.push_back(key_json(key));
  }
  return {{"name", name}, {"doc", table.summary}, {"keys", std::move(keys)}, {"sets", std::move(sets)}};
}

std::string_view parameter_word(const state::ParameterType& parameter) {
  switch (parameter.kind) {
    case state::ParameterKind::number:
      return "number";
    case state::ParameterKind::numbers:
      return parameter.count == 3 ? "vector" : "numbers";
    case state::ParameterKind::text:
      return "string";
    case state::ParameterKind::texts:
      return "strings";
    case state::ParameterKind::boolean:
      break;
  }
  return "boolean";
}

SchemaJson parameter_json(const state::ParameterType& parameter) {
  SchemaJson out{{"name", parameter.name}, {"type", parameter_word(parameter)}, {"doc", parameter.summary}};
  put(out, "unit", parameter.unit);
  put_range(out, parameter.min, parameter.max);
  if (parameter.count > 0) out["count"] = parameter.count;
  put(out, "names", word_of(parameter.reference));
  if (parameter.required) {
    out["required"] = true;
  } else if (!parameter.default_text.empty()) {
    out["default"] = parameter.default_text;
  } else if (parameter.kind == state::ParameterKind::boolean) {
    out["default"] = parameter.default_value != 0;
  } else if ((parameter.kind == state::ParameterKind::number || parameter.kind == state::ParameterKind::numbers) &&
             parameter.has_default()) {
    out["default"] = parameter.default_value;
  }
  return out;
}

SchemaJson value_json(const state::ValueType& value) {
  SchemaJson out{{"name", value.name}, {"doc", value.summary}};
  put(out, "unit", value.unit);
  put_range(out, value.min, value.max);
  return out;
}

SchemaJson components_json(std::span<const state::ComponentType> types) {
  SchemaJson out = SchemaJson::array();
  for (const state::ComponentType& type : types) {
    SchemaJson keys = SchemaJson::array(), values = SchemaJson::array();
    for (const state::ParameterType& parameter : type.parameters)
      keys.push_back(parameter_json(parameter));
    for (const state::ValueType& value : type.values)
      values.push_back(value_json(value));
    out.push_back({{"name", type.name},
                   {"doc", type.summary},
                   {"keys", std::move(keys)},
                   {"sets", SchemaJson::array()},
                   {"values", std::move(values)}});
  }
  return out;
}

SchemaJson node_json(const scenario::Table& table) {
  SchemaJson out = table_json(table, table.name);
  const x3d::NodeType* type = x3d::Schema::standard().find(table.name);
  for (SchemaJson& key : out["keys"]) {
    const x3d::Field* field = type == nullptr ? nullptr : type->field(key["name"].get<std::string>());
    if (field == nullptr) continue;
    key["x3d"] = field->type;
    if (field->has_min && !key.contains("least")) key["least"] = field->min;
    if (field->has_max && !key.contains("most")) key["most"] = field->max;
    std::string usual(field->default_value);
    for (char& c : usual)
      c = c == ',' ? ' ' : c;
    if (!usual.empty()) key["default"] = usual;
  }
  return out;
}

SchemaJson parts_json() {
  SchemaJson out = SchemaJson::array();
  for (const Part& part : parts())
    out.push_back({{"name", part.name}, {"title", {{"el", part.title_el}, {"en", part.title_en}}}});
  return out;
}

}  // namespace

std::string schema_json() {
  SchemaJson nodes = SchemaJson::array();
  for (const scenario::Table& table : scenario::node_tables())
    nodes.push_back(node_json(table));
  const SchemaJson out{
      {"metadata",
       {table_json(scenario::scenario_table(), "mechane:scenario"), table_json(scenario::body_table(), "mechane:body"),
        table_json(scenario::haptic_table(), "mechane:haptic")}},
      {"agents", components_json(agents::registry())},
      {"machines", components_json(machines::registry())},
      {"nodes", std::move(nodes)},
      {"parts", parts_json()}};
  return out.dump(-1, ' ', false, SchemaJson::error_handler_t::replace);
}

}  // namespace mechane::studio
