#include "server/x3d/node_fields.hpp"

#include "server/base/assert.hpp"

namespace mechane::x3d {
namespace {

const NodeType& known_type(const Node& node) {
  const NodeType* type = Schema::standard().find(node.name);
  MECHANE_ASSERT(type != nullptr);
  return *type;
}

/// Whether a child of this type, with this containerField (null: not written), fills the slot.
bool fills(const NodeType& parent, const Slot& slot, const NodeType& child, const std::string* written) {
  if (written != nullptr) return *written == slot.name;
  if (child.container == slot.name) return true;
  // Where the usual field is not one of the parent's, it is in the first field that takes it.
  if (parent.slot(child.container) != nullptr) return false;
  for (const Slot& other : parent.slots) {
    if (Schema::standard().accepts(other, child.name)) return &other == &slot;
  }
  return false;
}

}  // namespace

Quat rotation_of(std::span<const double> four_numbers) {
  MECHANE_ASSERT(four_numbers.size() == 4);
  const Vec3 axis(four_numbers[0], four_numbers[1], four_numbers[2]);
  if (four_numbers[3] == 0 || axis.norm() < 1e-9) return Quat::Identity();
  return Quat(Eigen::AngleAxisd(four_numbers[3], axis.normalized()));
}

NodeFields::NodeFields(const Document& document, NodeId id)
    : document_(document), id_(document.resolve(id)), node_(document[id_]), type_(known_type(node_)) {}

std::string_view NodeFields::value(std::string_view name) const {
  const Field* field = type_.field(name);
  MECHANE_ASSERT(field != nullptr);
  const std::string* text = node_.attribute(name);
  return text == nullptr || field->fault(*text) ? field->default_value : std::string_view(*text);
}

std::vector<double> NodeFields::numbers(std::string_view name) const {
  auto values = parse_numbers(value(name));
  MECHANE_ASSERT(values.has_value());
  return std::move(*values);
}

double NodeFields::number(std::string_view name) const {
  const std::vector<double> values = numbers(name);
  return values.empty() ? 0 : values.front();
}

bool NodeFields::boolean(std::string_view name) const {
  return value(name) == "true";
}

Vec3 NodeFields::vector(std::string_view name) const {
  const std::vector<double> values = numbers(name);
  MECHANE_ASSERT(values.size() == 3);
  return {values[0], values[1], values[2]};
}

Quat NodeFields::rotation(std::string_view name) const {
  return rotation_of(numbers(name));
}

std::vector<std::string> NodeFields::strings(std::string_view name) const {
  auto values = parse_strings(value(name));
  MECHANE_ASSERT(values.has_value());
  return std::move(*values);
}

std::string NodeFields::text(std::string_view name) const {
  return std::string(value(name));
}

std::vector<NodeId> NodeFields::nodes(std::string_view slot_name) const {
  std::vector<NodeId> found;
  const Slot* slot = type_.slot(slot_name);
  if (slot == nullptr) return found;
  for (const NodeId child : document_.child_elements(id_)) {
    const NodeType* type = Schema::standard().find(document_[child].name);
    if (type != nullptr && fills(type_, *slot, *type, document_[child].attribute("containerField")))
      found.push_back(document_.resolve(child));
  }
  return found;
}

NodeId NodeFields::node(std::string_view slot) const {
  const std::vector<NodeId> found = nodes(slot);
  return found.empty() ? NodeId::none() : found.front();
}

}  // namespace mechane::x3d
