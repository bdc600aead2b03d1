#include "server/x3d/document.hpp"

#include <algorithm>

namespace mechane::x3d {

const std::string* Node::attribute(std::string_view wanted) const {
  const auto it =
      std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& a) { return a.name == wanted; });
  return it == attributes.end() ? nullptr : &it->value;
}

NodeId Document::find_def(std::string_view def) const {
  const auto it = defs_.find(def);
  return it == defs_.end() ? NodeId::none() : it->second;
}

NodeId Document::resolve(NodeId id) const {
  return nodes_[id.index()].used ? nodes_[id.index()].used : id;
}

std::vector<NodeId> Document::elements(std::string_view type) const {
  std::vector<NodeId> found;
  std::vector<NodeId> open{scene_};
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    const Node& node = nodes_[id.index()];
    if (node.kind != NodeKind::element || node.used || node.name == "ProtoDeclare") continue;
    if (node.name == type) found.push_back(id);
    open.insert(open.end(), node.children.rbegin(), node.children.rend());
  }
  return found;
}

std::vector<NodeId> Document::child_elements(NodeId id) const {
  std::vector<NodeId> found;
  for (const NodeId child : nodes_[id.index()].children) {
    if (nodes_[child.index()].kind == NodeKind::element) found.push_back(child);
  }
  return found;
}

std::string Document::container_field(NodeId id, std::string_view otherwise) const {
  const std::string* field = nodes_[id.index()].attribute("containerField");
  return field != nullptr ? *field : std::string(otherwise);
}

std::string Document::describe(NodeId id) const {
  const Node& node = nodes_[id.index()];
  const std::string* def = node.attribute("DEF");
  if (def == nullptr) def = node.attribute("USE");
  return def != nullptr ? node.name + " " + *def : node.name;
}

std::vector<std::string> Document::defs(std::string_view type) const {
  std::vector<std::string> names;
  for (const auto& [name, id] : defs_) {
    if (type.empty() || nodes_[id.index()].name == type) names.push_back(name);
  }
  return names;
}

}  // namespace mechane::x3d
