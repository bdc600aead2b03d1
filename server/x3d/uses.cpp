#include "server/x3d/uses.hpp"

#include <utility>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"

namespace mechane::x3d {
namespace {

/// Names are unique within a scope: the file, or one prototype's body.
using NameScope = NodeId;
using NamesByScope = std::map<std::pair<NameScope, std::string>, NodeId>;

/// The scope of each node. Parents come before their children in `nodes`.
std::vector<NameScope> scopes_of(const std::vector<Node>& nodes) {
  std::vector<NameScope> scopes(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const NodeId parent = nodes[i].parent;
    if (!parent) continue;
    scopes[i] = nodes[parent.index()].name == "ProtoBody" ? parent : scopes[parent.index()];
  }
  return scopes;
}

NamesByScope collect_names(const std::vector<Node>& nodes, const std::vector<NameScope>& scopes, Problems& problems) {
  NamesByScope names;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].kind != NodeKind::element) continue;
    const std::string* def = nodes[i].attribute("DEF");
    if (def == nullptr || def->empty()) continue;
    const auto [it, fresh] = names.try_emplace({scopes[i], *def}, NodeId(i));
    if (!fresh) {
      problems.error(ErrorCode::duplicate, nodes[i].line, nodes[i].name + " " + *def,
                     fmt::format("the DEF '{}' is already given in line {}", *def, nodes[it->second.index()].line),
                     "give this element another name");
    }
  }
  return names;
}

std::vector<std::string> names_within(const NamesByScope& names, NameScope scope) {
  std::vector<std::string> found;
  for (const auto& [key, id] : names) {
    if (key.first == scope) found.push_back(key.second);
  }
  return found;
}

void resolve_one(std::vector<Node>& nodes, std::size_t i, NameScope scope, const NamesByScope& names,
                 Problems& problems) {
  Node& node = nodes[i];
  const std::string* use = node.kind == NodeKind::element ? node.attribute("USE") : nullptr;
  if (use == nullptr || use->empty()) return;
  const std::string place = node.name + " USE " + *use;
  const auto it = names.find({scope, *use});
  if (it == names.end()) {
    problems.error(ErrorCode::unknown_name, node.line, place, fmt::format("no element has the DEF '{}'", *use),
                   suggest(*use, names_within(names, scope), "give an element that DEF"));
    return;
  }
  const Node& target = nodes[it->second.index()];
  if (target.name != node.name) {
    problems.error(ErrorCode::conflict, node.line, place,
                   fmt::format("'{}' is a {} (line {}), not a {}", *use, target.name, target.line, node.name),
                   "USE an element of the same type");
    return;
  }
  if (it->second.index() > i) {
    problems.warning(
        ErrorCode::conflict, node.line, place,
        fmt::format("the USE comes before its DEF (line {}): other X3D readers do not find it", target.line),
        "move the DEF before it");
  }
  node.used = it->second;
}

/// Depth first over children and USEs: an edge to a node that is still open closes a circle.
void find_circles(std::vector<Node>& nodes, Problems& problems) {
  enum class Mark : std::uint8_t { unseen, open, done };
  std::vector<Mark> marks(nodes.size(), Mark::unseen);
  struct Visit {
    std::size_t node;
    std::size_t next = 0;  // the next child to visit; children.size(): the element it uses
  };
  std::vector<Visit> stack;
  for (std::size_t root = 0; root < nodes.size(); ++root) {
    if (marks[root] != Mark::unseen) continue;
    stack.push_back({root});
    marks[root] = Mark::open;
    while (!stack.empty()) {
      Visit& visit = stack.back();
      Node& node = nodes[visit.node];
      const std::size_t step = visit.next++;
      if (step > node.children.size()) {
        marks[visit.node] = Mark::done;
        stack.pop_back();
        continue;
      }
      const NodeId to = step < node.children.size() ? node.children[step] : node.used;
      if (!to || marks[to.index()] == Mark::done) continue;
      if (marks[to.index()] == Mark::open) {
        problems.error(ErrorCode::conflict, node.line, node.name + " USE " + *node.attribute("USE"),
                       fmt::format("this USE is inside the element that it refers to (line {}), which makes a circle",
                                   nodes[to.index()].line),
                       "move the USE out of it, or write a new element in its place");
        node.used = NodeId::none();
        continue;
      }
      marks[to.index()] = Mark::open;
      stack.push_back({to.index()});
    }
  }
}

}  // namespace

void resolve_uses(std::vector<Node>& nodes, std::map<std::string, NodeId, std::less<>>& defs, Problems& problems) {
  const std::vector<NameScope> scopes = scopes_of(nodes);
  const NamesByScope names = collect_names(nodes, scopes, problems);
  for (std::size_t i = 0; i < nodes.size() && !problems.full(); ++i)
    resolve_one(nodes, i, scopes[i], names, problems);
  find_circles(nodes, problems);
  for (const auto& [key, id] : names) {
    if (!key.first) defs.emplace(key.second, id);
  }
}

}  // namespace mechane::x3d
