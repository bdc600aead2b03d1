// Viewpoints, and effects to see and hear beside the bodies.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

/// Stream, jet and level need the right unit: displays turn the number into a width, a speed or a height.
void check_unit(Compilation& c, const Fields& fields, const state::EffectDescription& effect) {
  const bool flow = effect.kind == "stream" || effect.kind == "jet";
  const bool height = effect.kind == "level";
  if (!effect.quantity || !(flow || height)) return;
  const state::QuantityDescription& quantity = c.world.quantities[effect.quantity.index()];
  const std::string& unit = quantity.unit;
  const bool fits = flow ? unit == "l/s" || unit == "l/min" || unit == "m3/s" || unit == "kg/s" : unit == "m";
  if (fits || c.misspelt_parameters.contains({quantity.name, "unit"})) return;
  c.problems.error(ErrorCode::conflict, fields.line("quantity"), fields.where(),
                   fmt::format("a {} is driven by a {}, but '{}' has the unit '{}'", effect.kind,
                               flow ? "flow" : "height", quantity.name, unit),
                   flow ? "name a quantity with the unit l/s, l/min, m3/s or kg/s" : "name a quantity with the unit m");
}

/// Whether a mesh file of the scenario's bodies has the node; adds a problem where no file has it. Files that cannot be read have been
/// reported with the bodies.
bool node_is_there(Compilation& c, const Fields& fields, const std::string& node) {
  std::vector<std::string> files;
  std::optional<Error> missing;
  for (const auto& [url, hash] : c.model_hashes) {
    if (hash.empty()) continue;
    const auto found = c.loader.find_node(c.document.path().parent_path() / url, node);
    if (found) return true;
    files.push_back(url);
    if (!missing) missing = found.error();
  }
  if (!missing) return false;
  c.problems.error(missing->code, fields.line("node"), fields.where(),
                   fmt::format("node '{}' of {}: {}", node, fmt::join(files, ", "), missing->what), missing->remedy);
  return false;
}

/// Warns of a key that is written and has no meaning for this kind of effect.
void warn_unused(Compilation& c, const Fields& fields, const state::EffectDescription& effect, const char* key,
                 const char* remedy) {
  if (fields.given(key))
    c.problems.warning(ErrorCode::conflict, fields.line(key), fields.where(),
                       fmt::format("a {} effect does not use '{}'", effect.kind, key), remedy);
}

/// A river needs a node that is drawn as water, and a direction along its surface; it has no quantity.
void check_flow(Compilation& c, const Fields& fields, const state::EffectDescription& effect) {
  if (effect.node.empty()) {
    c.problems.error(ErrorCode::missing, fields.line("kind"), fields.where(),
                     "the flow effect does not say which node flows", "name the node of the mesh file in the key node");
  } else if (node_is_there(c, fields, effect.node) && !effect.node.starts_with("WATER_")) {
    c.problems.error(ErrorCode::conflict, fields.line("node"), fields.where(),
                     fmt::format("node '{}' is not water, so displays do not let it flow", effect.node),
                     fmt::format("name it WATER_{} in the model, and here", effect.node));
  }
  if (std::hypot(effect.direction_B.x(), effect.direction_B.z()) < 0.1) {
    c.problems.error(ErrorCode::invalid_value, fields.line(fields.given("direction") ? "direction" : "kind"),
                     fields.where(), "the direction points up or down, not along the water",
                     "write a level direction in W, like 0 0 1");
  }
  for (const char* key : {"quantity", "body"})
    warn_unused(c, fields, effect, key, "remove it: a river flows steadily, in the world's frame");
}

/// Displays draw only the nodes that bodies name, SCENE and WATER_*; a level effect needs one of those.
void check_risen_node(Compilation& c, const Fields& fields, const std::string& node) {
  if (!node_is_there(c, fields, node) || node == "SCENE" || node.starts_with("WATER_")) return;
  const auto& bodies = c.world.bodies;
  const auto shows = [&](const state::BodyDescription& body) { return body.mesh.node == node; };
  if (std::any_of(bodies.begin(), bodies.end(), shows)) return;
  c.problems.error(ErrorCode::conflict, fields.line("node"), fields.where(),
                   fmt::format("node '{}' is not water, so displays do not raise it", node),
                   fmt::format("name it WATER_{} in the model, and here", node));
}

/// What is felt is felt in a body, all over.
void check_felt(Compilation& c, const x3d::Metadata& set, const Fields& fields,
                const state::EffectDescription& effect) {
  if (effect.felt && !fields.given("body")) {
    c.problems.error(ErrorCode::missing, set.line, fields.where(),
                     "the touch.click effect does not say in which body it is felt",
                     "name what a hand holds or touches in the key body");
  }
  if (!effect.felt) return warn_unused(c, fields, effect, "force", "remove it: only a touch.click has a force");
  for (const char* key : {"point", "direction", "size", "speed"})
    warn_unused(c, fields, effect, key, "remove it: a touch.click is felt wherever a hand holds or touches the body");
}

/// What is wrong between the keys of an effect.
void check_effect(Compilation& c, const x3d::Metadata& set, const Fields& fields,
                  const state::EffectDescription& effect) {
  if (effect.kind == "level" && effect.node.empty()) {
    c.problems.error(ErrorCode::missing, set.line, fields.where(), "the level effect does not say which node rises",
                     "name the node of the mesh file in the key node");
  } else if (effect.kind == "level") {
    check_risen_node(c, fields, effect.node);
  } else if (effect.kind == "flow") {
    check_flow(c, fields, effect);
  } else {
    warn_unused(c, fields, effect, "node", "remove it: body and point say where the effect is");
  }
  if (effect.kind != "flow" && fields.given("node") && !fields.given("quantity")) {
    c.problems.error(ErrorCode::missing, set.line, fields.where(),
                     fmt::format("the {} effect has no quantity to drive it", effect.kind),
                     "name a quantity in the key quantity");
  }
  check_felt(c, set, fields, effect);
  check_unit(c, fields, effect);
}

state::EffectDescription read_effect(Compilation& c, const x3d::Metadata& set) {
  const Fields fields(&set, effect_table(), "effect " + set.name, c.problems);
  state::EffectDescription effect;
  effect.name = set.name;
  effect.kind = fields.string("kind");
  effect.body = find_body(c, fields);
  effect.node = fields.string("node");
  effect.quantity = find_quantity(c, fields);
  effect.full = fields.number("full");
  effect.size_m = fields.number("size");
  effect.speed_m_per_s = fields.number("speed");
  effect.force_n = fields.number("force");
  effect.felt = effect.kind == "touch.click";
  effect.p_BE = fields.vector("point");
  if (fields.given("direction")) {
    effect.direction_B = fields.vector("direction");
    if (effect.direction_B.norm() < 1e-9) {
      c.problems.error(ErrorCode::invalid_value, fields.line("direction"), fields.where(),
                       "the direction has no length", "write a vector, like 0 1 0");
    } else {
      effect.direction_B.normalize();
    }
  }
  if (!fields.has_faults()) check_effect(c, set, fields, effect);
  return effect;
}

void extend(Eigen::AlignedBox3d& box, const Vec3& center, double radius) {
  box.extend(Vec3(center.array() - radius)).extend(Vec3(center.array() + radius));
}

/// Before and above what can move, and where it swings, or all where nothing can, so that it fills half the picture; none without shapes.
std::optional<state::Viewpoint> view_of_all(const state::WorldDescription& world) {
  constexpr double kLeastRadius_m = 0.3;
  const auto& bodies = world.bodies;
  const bool any_moves = std::any_of(bodies.begin(), bodies.end(), [](const auto& b) { return b.object && !b.fixed; });
  Eigen::AlignedBox3d box;
  for (const state::BodyDescription& body : bodies) {
    if (!body.object || (any_moves && body.fixed)) continue;
    const geometry::Sphere& bound_B = body.object->bound_O;
    extend(box, body.X_WB * bound_B.center, bound_B.radius);
  }
  for (const state::JointDescription& joint : world.joints) {
    const state::BodyDescription& body = bodies[joint.body2.index()];
    const bool hangs = !joint.body1 || bodies[joint.body1.index()].fixed;
    if (!hangs || !body.object || joint.kind == state::JointKind::slider) continue;
    const geometry::Sphere& bound_B = body.object->bound_O;
    extend(box, body.X_WB * joint.X_B2J.p, (bound_B.center - joint.X_B2J.p).norm() + bound_B.radius);
  }
  if (box.isEmpty()) return std::nullopt;
  state::Viewpoint view;
  const double radius_m = std::max(kLeastRadius_m, box.diagonal().norm() / 2);
  const Quat R_WV(Eigen::AngleAxisd(-0.3, Vec3::UnitX()));
  const double distance_m = 2 * radius_m / std::tan(view.field_of_view_rad / 2);
  view.X_WV = {box.center() + distance_m * (R_WV * Vec3::UnitZ()), R_WV};
  return view;
}

}  // namespace

void compile_effects(Compilation& c) {
  const x3d::Metadata* tree = tree_set(c, "effects");
  if (tree == nullptr) return;
  for (const x3d::Metadata& set : tree->children) {
    if (set.kind != x3d::MetadataKind::set) {
      c.problems.error(ErrorCode::invalid_value, set.line, "effect " + set.name, "the effect is not a set",
                       "write a MetadataSet");
    } else {
      c.world.effects.push_back(read_effect(c, set));
    }
  }
}

void compile_viewpoints(Compilation& c) {
  for (const x3d::NodeId id : c.document.elements("Viewpoint")) {
    Attributes attributes(c.document, id, c.problems);
    state::Viewpoint viewpoint;
    viewpoint.name = attributes.text("DEF");
    viewpoint.description = attributes.text("description");
    viewpoint.X_WV = {attributes.vector("position"), attributes.rotation("orientation")};
    viewpoint.field_of_view_rad = attributes.number("fieldOfView");
    if (c.document[id].parent != c.document.scene()) {
      attributes.warning(ErrorCode::not_supported, "the nodes around the Viewpoint do not move it",
                         "put it directly under the Scene");
    }
    c.world.viewpoints.push_back(std::move(viewpoint));
  }
  if (!c.world.viewpoints.empty()) return;
  if (auto view = view_of_all(c.world)) c.world.viewpoints.push_back(std::move(*view));
}

}  // namespace mechane::scenario
