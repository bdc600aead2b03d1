#include "client-sdk/studio/view/view.hpp"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "client-sdk/studio/edits/body_edits.hpp"
#include "server/base/math.hpp"
#include "server/scenario/copies.hpp"
#include "server/x3d/metadata.hpp"
#include "server/x3d/node_fields.hpp"
#include "server/x3d/shape_tree.hpp"

namespace mechane::studio {
namespace {

using ViewJson = nlohmann::json;
using x3d::Document;
using x3d::Metadata;
using x3d::MetadataKind;
using x3d::NodeId;

constexpr std::string_view kScenarioSet = "mechane:scenario";

std::string written(const ViewJson& json) {
  return json.dump(-1, ' ', false, ViewJson::error_handler_t::replace);
}

std::string def_of(const Document& document, NodeId id) {
  const std::string* def = document[id].attribute("DEF");
  return def == nullptr ? std::string() : *def;
}

template <class T>
ViewJson one_or_list(const std::vector<T>& values) {
  if (values.size() == 1) return ViewJson(static_cast<T>(values.front()));
  ViewJson list = ViewJson::array();
  for (const T& value : values)
    list.push_back(static_cast<T>(value));
  return list;
}

ViewJson value_json(const Metadata& value) {
  switch (value.kind) {
    case MetadataKind::strings:
      return one_or_list(value.strings);
    case MetadataKind::numbers:
    case MetadataKind::integers:
      return one_or_list(value.numbers);
    case MetadataKind::booleans:
      return one_or_list(value.booleans);
    case MetadataKind::set:
    case MetadataKind::unreadable:
      break;
  }
  return nullptr;
}

std::string_view type_word(MetadataKind kind) {
  switch (kind) {
    case MetadataKind::strings:
      return "strings";
    case MetadataKind::numbers:
      return "numbers";
    case MetadataKind::integers:
      return "integers";
    case MetadataKind::booleans:
      return "booleans";
    default:
      return "unreadable";
  }
}

ViewJson metadata_json(const Metadata& metadata) {
  ViewJson out{{"name", metadata.name}, {"line", metadata.line}};
  if (metadata.kind != MetadataKind::set) {
    out.update({{"kind", "value"}, {"type", type_word(metadata.kind)}, {"value", value_json(metadata)}});
    return out;
  }
  ViewJson children = ViewJson::array();
  for (const Metadata& child : metadata.children)
    children.push_back(metadata_json(child));
  out.update({{"kind", "set"}, {"children", std::move(children)}});
  return out;
}

ViewJson pose_of(const Pose& X) {
  return {X.p.x(), X.p.y(), X.p.z(), X.R.x(), X.R.y(), X.R.z(), X.R.w()};
}

/// In W; none where it has none, or stands in a scaled group.
std::optional<Pose> pose_in_world(const Document& document, NodeId id) {
  const std::string& type = document[id].name;
  const x3d::NodeFields fields(document, id);
  if (type == "RigidBody") return Pose{fields.vector("position"), fields.rotation("orientation")};
  const bool transform = type == "Transform";
  if (!transform && type != "Viewpoint") return std::nullopt;
  const auto around = x3d::frame_around(document, id);
  if (!around) return std::nullopt;
  return *around * Pose{fields.vector(transform ? "translation" : "position"),
                        fields.rotation(transform ? "rotation" : "orientation")};
}

/// The names of the bodies that a RigidBody stands for; none where it is one.
ViewJson copies_json(const Document& document, NodeId id) {
  ViewJson names = ViewJson::array();
  for (const std::string& name : scenario::copies_in(document, id))
    names.push_back(name);
  return names;
}

ViewJson node_json(const Document& document, NodeId id) {
  const std::string& type = document[id].name;
  ViewJson out{{"def", def_of(document, id)}, {"type", type}, {"line", document[id].line}};
  if (const auto X = pose_in_world(document, id)) out["pose"] = pose_of(*X);
  ViewJson children = ViewJson::array();
  if (type == "RigidBody") {
    const x3d::NodeFields fields(document, id);
    const bool fixed = fields.boolean("fixed");
    out["movable"] = !fixed;
    if (!fixed) out["mass"] = fields.number("mass");
    if (ViewJson copies = copies_json(document, id); !copies.empty()) out["copies"] = std::move(copies);
    for (const NodeId child : document.child_elements(id)) {
      if (is_collidable(document, child) && !document[child].used && !def_of(document, child).empty())
        children.push_back({{"def", def_of(document, child)},
                            {"type", document[child].name},
                            {"line", document[child].line},
                            {"children", ViewJson::array()}});
    }
  }
  out["children"] = std::move(children);
  return out;
}

/// Nodes that have a name, in the order written: what an author can select.
std::vector<NodeId> named_nodes(const Document& document) {
  std::vector<NodeId> out;
  for (const std::string& def : document.defs("")) {
    const NodeId id = document.find_def(def);
    const std::string& type = document[id].name;
    if (type == "RigidBody" || type == "Transform" || type == "Viewpoint" || type == "Inline" || is_joint(document, id))
      out.push_back(id);
  }
  std::ranges::sort(out);
  return out;
}

ViewJson fields_json(const Document& document, NodeId id) {
  ViewJson out = ViewJson::object();
  for (const x3d::Attribute& attribute : document[id].attributes)
    if (attribute.name != "DEF" && attribute.name != "containerField") out[attribute.name] = attribute.value;
  return out;
}

/// A body, a joint or a Viewpoint: its fields as written, our sets on it, and of a joint its two bodies.
ViewJson inspected_json(const Document& document, NodeId id, x3d::Problems& problems) {
  ViewJson sets = ViewJson::object();
  for (const char* name : {"mechane:body", "mechane:haptic", "mechane:agent"})
    if (const auto set = x3d::read_metadata(document, id, name, problems)) sets[name] = metadata_json(*set);
  ViewJson out{{"def", def_of(document, id)},
               {"type", document[id].name},
               {"line", document[id].line},
               {"fields", fields_json(document, id)},
               {"sets", std::move(sets)}};
  for (const char* side : {"body1", "body2"}) {
    for (const NodeId child : document.child_elements(id))
      if (document.container_field(child, "") == side) out[side] = def_of(document, document.resolve(child));
  }
  return out;
}

/// The path of the metadata that stands in a line, within the set: "activities/use"; empty where there is none.
std::string path_at(const Metadata& set, int line) {
  for (const Metadata& child : set.children) {
    if (child.line == line) return child.name;
    const std::string below = child.kind == MetadataKind::set ? path_at(child, line) : "";
    if (!below.empty()) return child.name + "/" + below;
  }
  return {};
}

std::optional<Metadata> scenario_metadata(const Document& document, x3d::Problems& problems) {
  for (const NodeId info : document.elements("WorldInfo"))
    if (auto set = x3d::read_metadata(document, info, kScenarioSet, problems)) return set;
  return std::nullopt;
}

/// "RigidBody INNER" names a node where INNER is a DEF.
std::string node_in(const Document& document, const std::string& described) {
  const std::string name = described.substr(described.rfind(' ') + 1);
  return document.find_def(name) ? name : std::string();
}

ViewJson problem_json(const Document* document, const Metadata* scenario, const x3d::Problem& problem) {
  ViewJson out{{"severity", x3d::word_of(problem.severity)},
               {"message", problem.what},
               {"remedy", problem.remedy},
               {"line", problem.line},
               {"place", problem.node}};
  if (scenario != nullptr && problem.line > 0)
    if (const std::string path = path_at(*scenario, problem.line); !path.empty()) out["path"] = path;
  if (document != nullptr)
    if (const std::string node = node_in(*document, problem.node); !node.empty()) out["node"] = node;
  return out;
}

/// Notes are of what is valid: authors see errors and warnings.
ViewJson problem_list(const Document* document, const Metadata* scenario, std::span<const x3d::Problem> problems) {
  ViewJson list = ViewJson::array();
  for (const x3d::Problem& problem : problems)
    if (problem.severity != x3d::Severity::note) list.push_back(problem_json(document, scenario, problem));
  return list;
}

}  // namespace

std::size_t count_errors(std::span<const x3d::Problem> problems) {
  return static_cast<std::size_t>(
      std::ranges::count(problems, x3d::Severity::error, [](const x3d::Problem& problem) { return problem.severity; }));
}

std::string problems_json(const Document* document, std::span<const x3d::Problem> problems) {
  x3d::Problems ignored("");
  const auto scenario = document != nullptr ? scenario_metadata(*document, ignored) : std::nullopt;
  return written(problem_list(document, scenario ? &*scenario : nullptr, problems));
}

std::string view_json(const Viewed& viewed) {
  const Document& document = viewed.document;
  x3d::Problems ignored("");  // the checker tells of them
  const auto scenario = scenario_metadata(document, ignored);
  ViewJson outline = ViewJson::array(), bodies = ViewJson::array(), joints = ViewJson::array(),
           views = ViewJson::array();
  for (const NodeId id : named_nodes(document)) {
    outline.push_back(node_json(document, id));
    if (document[id].name == "RigidBody") bodies.push_back(inspected_json(document, id, ignored));
    if (is_joint(document, id)) joints.push_back(inspected_json(document, id, ignored));
    if (document[id].name == "Viewpoint") views.push_back(inspected_json(document, id, ignored));
  }
  ViewJson problems = problem_list(&document, scenario ? &*scenario : nullptr, viewed.problems);
  if (!viewed.notice.empty())
    problems.push_back({{"severity", "warning"},
                        {"message", viewed.notice},
                        {"remedy", "go on; name a version to be able to come back to this text"},
                        {"line", 0},
                        {"place", "history"}});
  const auto last = [](const std::vector<Step>& steps) { return steps.empty() ? std::string() : steps.back().title; };
  return written(
      {{"name", viewed.name},
       {"revision", viewed.history.revision()},
       {"by", viewed.by},
       {"canUndo", !viewed.history.undoable().empty()},
       {"canRedo", !viewed.history.redoable().empty()},
       {"undoes", last(viewed.history.undoable())},
       {"redoes", last(viewed.history.redoable())},
       {"problems", std::move(problems)},
       {"outline", std::move(outline)},
       {"metadata",
        scenario ? metadata_json(*scenario)
                 : ViewJson{{"kind", "set"}, {"name", kScenarioSet}, {"line", 0}, {"children", ViewJson::array()}}},
       {"bodies", std::move(bodies)},
       {"joints", std::move(joints)},
       {"views", std::move(views)},
       {"added", viewed.added}});
}

}  // namespace mechane::studio
