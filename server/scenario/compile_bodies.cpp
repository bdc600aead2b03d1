// Makes bodies of RigidBody nodes.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/content/content_hash.hpp"
#include "server/scenario/compilation.hpp"
#include "server/state/surface_keys.hpp"
#include "server/x3d/node_fields.hpp"

namespace mechane::scenario {
namespace {

/// The url of the mesh file of a body's model, which exists; empty after a problem.
std::string model_url(Compilation& c, const Fields& fields) {
  const std::string model = fields.string("model");
  if (!fields.given("model")) return {};
  const x3d::NodeId id = c.document.find_def(model);
  if (!id || c.document[id].name != "Inline") {
    c.problems.error(
        ErrorCode::unknown_name, fields.line("model"), fields.where(), fmt::format("no Inline has the DEF '{}'", model),
        suggest(model, c.document.defs("Inline"), "add <Inline DEF='...' url='\"model.glb\"'/> to the Scene"));
    return {};
  }
  Attributes inline_node(c.document, id, c.problems);
  const std::vector<std::string> urls = inline_node.strings("url");
  if (urls.empty()) {
    inline_node.error(ErrorCode::missing, "the Inline has no url", "write url='\"model.glb\"'");
    return {};
  }
  const std::string& url = urls.front();
  if (!x3d::is_relative_path(url)) {
    inline_node.error(ErrorCode::invalid_value, fmt::format("the url '{}' is not a relative path", url),
                      "copy the file to a folder beside the scenario, and name it by its path from this file");
    return {};
  }
  if (!c.model_hashes.contains(url)) {
    const auto hash = c.loader.content_hash(c.document.path().parent_path() / url);
    if (!hash) {
      inline_node.error(hash.error().code, fmt::format("the mesh file '{}' cannot be read: {}", url, hash.error().what),
                        "check the url, or build the models");
      c.model_hashes[url] = "";
      return {};
    }
    c.model_hashes[url] = *hash;
  }
  return c.model_hashes[url].empty() ? std::string() : url;
}

/// The name of this file, as a mesh file that holds the shapes in it.
std::string own_url(Compilation& c) {
  const std::string url = c.document.path().filename().string();
  if (c.model_hashes.contains(url)) return url;
  c.model_hashes[url] = content::content_hash(std::as_bytes(std::span(c.document.source())));
  for (const x3d::NodeId id : c.document.elements("Inline")) {
    const std::string inlined = x3d::inlined_x3d(c.document, id);
    if (inlined.empty() || !c.shapes.used().contains(id) || c.model_hashes.contains(inlined)) continue;
    // That it is missing is told when its shapes are asked for.
    const auto hash = c.loader.content_hash(c.document.path().parent_path() / inlined);
    if (hash) c.model_hashes[inlined] = *hash;
  }
  return url;
}

/// The nodes of a mesh file that a body is touched and drawn as.
struct ShapeNodes {
  std::string url;
  std::string touched;
  std::string drawn;
};

/// Where the body's shape is; none after a problem.
std::optional<ShapeNodes> find_shape(Compilation& c, x3d::NodeId id, const Fields& fields, const std::string& name) {
  if (fields.given("model")) {
    const std::string url = model_url(c, fields);
    const std::string node = fields.given("node") ? fields.string("node") : name;
    return url.empty() ? std::nullopt : std::optional<ShapeNodes>({url, node, node});
  }
  if (c.shapes.has_shape(id)) {
    const x3d::NodeId picture = c.shapes.picture_of(id);
    return ShapeNodes{own_url(c), name, picture ? x3d::node_name(c.document, picture) : name};
  }
  if (!fields.has_faults())
    c.problems.error(ErrorCode::missing, fields.line("model"), fields.where(), "the body has no shape",
                     "write the key model, or put a CollidableShape into the body's geometry");
  return std::nullopt;
}

/// Reports that a node of a mesh file cannot be had.
void refuse_node(Compilation& c, const ShapeNodes& shape, const Place& at, const std::string& node,
                 const Error& error) {
  if (shape.url != c.document.path().filename().string()) {
    c.problems.error(error.code, at.line, at.text, fmt::format("node '{}' of {}: {}", node, shape.url, error.what),
                     error.remedy);
    return;
  }
  // The fault is in this file: at its own line.
  const std::size_t element = error.where.rfind("line ");
  const std::string where = element == std::string::npos ? at.text : error.where.substr(element);
  c.problems.error(error.code, error.line > 0 ? error.line : at.line, where, error.what, error.remedy);
}

/// Returns the node that hands touch; empty: they cannot touch the body.
std::string read_shape(Compilation& c, x3d::NodeId id, Attributes& attributes, const Fields& fields, bool has_set,
                       state::BodyDescription& body) {
  const bool own = c.shapes.has_shape(id);
  if (!has_set && !own) {
    attributes.warning(ErrorCode::missing, "the body has no shape: it is neither drawn nor touched",
                       "put a CollidableShape into its geometry, or name a model and node in 'mechane:body'");
    return {};
  }
  body.title = read_texts(c, fields.set("text"), fields.where() + ", text", "title")["title"];
  const auto shape = find_shape(c, id, fields, body.name);
  if (!shape) return {};
  body.mesh = {shape->url, c.model_hashes[shape->url], shape->drawn};
  const bool touchable = !fields.given("touchable") || fields.boolean("touchable");
  body.collides = fields.given("collides") ? fields.boolean("collides") : own && touchable && !fields.given("model");
  if (fields.given("restitution")) body.restitution = fields.number("restitution");
  const std::filesystem::path file = c.document.path().parent_path() / shape->url;
  const Place at =
      has_set ? Place(fields.where(), fields.line("node")) : Place(c.document.describe(id), c.document[id].line);
  if (!touchable || shape->drawn != shape->touched) {
    if (const auto found = c.loader.find_node(file, shape->drawn); !found)
      refuse_node(c, *shape, at, shape->drawn, found.error());
  }
  if (!touchable) {
    if (!body.collides) return {};
    c.problems.error(ErrorCode::conflict, fields.line("collides"), fields.where(),
                     "collides is true, but touchable is false",
                     "remove touchable false: touch and collisions use the same shape");
    return {};
  }
  const auto choice = geometry::solid_choice_of(fields.string("solid"));
  if (!choice) {
    c.problems.error(ErrorCode::invalid_value, fields.line("solid"), fields.where(),
                     fmt::format("solid is '{}'", fields.string("solid")),
                     "write auto, closed, or sheet with a thickness from 0.0001 to 0.1 m: sheet 0.001");
    return shape->touched;
  }
  auto object = c.loader.load(file, shape->touched, *choice);
  if (object) {
    body.object = std::move(*object);
  } else {
    refuse_node(c, *shape, at, shape->touched, object.error());
  }
  return shape->touched;
}

/// What a CollisionCollection says of the bodies in it. X3D has a coefficient for each of two directions along a surface; ours has no
/// direction, and takes the first.
void read_collection(Compilation& c, x3d::NodeId id, state::BodyDescription& body) {
  const x3d::NodeId collection = c.shapes.collection_of(id);
  if (!collection) return;
  const x3d::NodeFields fields(c.document, collection);
  const std::vector<std::string> applied = fields.strings("appliedParameters");
  const auto applies = [&](std::string_view word) {
    return std::any_of(applied.begin(), applied.end(), [&](const std::string& one) { return one.starts_with(word); });
  };
  if (applied.empty() || applies("BOUNCE")) body.restitution = fields.number("bounce");
  if (!applies("FRICTION_COEFFICIENT")) return;
  body.haptic.static_friction = fields.numbers("frictionCoefficients").front();
  body.haptic.dynamic_friction = body.haptic.static_friction;
}

void read_haptic(Compilation& c, x3d::NodeId id, state::BodyDescription& body) {
  const auto set = x3d::read_metadata(c.document, id, "mechane:haptic", c.problems);
  const Fields fields(set ? &*set : nullptr, haptic_table(), "mechane:haptic of " + body.name, c.problems);
  std::vector<state::SurfaceFault> faults;
  body.haptic = state::changed_surface(
      body.haptic, [&](std::string_view key) { return fields.numbers(key); }, faults);
  body.effort_scale = fields.number("effortScale");
  body.graspable = fields.boolean("graspable");
  if (fields.has_faults()) return;
  for (const state::SurfaceFault& fault : faults)
    c.problems.error(fault.code, fields.line(fault.key), fields.where(), fault.what, fault.remedy);
  if (body.haptic.groove_depth_m > 0) return;
  for (const char* key : {"grooveDistance", "grooveDirection"}) {
    if (fields.given(key))
      c.problems.warning(ErrorCode::conflict, fields.line(key), fields.where(),
                         fmt::format("'{}' does nothing without grooves", key), "write a grooveDepth, or remove it");
  }
}

/// In ascending order.
Vec3 principal_moments(const Mat3& inertia_kg_m2) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(inertia_kg_m2, Eigen::EigenvaluesOnly).eigenvalues();
}

bool is_of_a_solid(const Vec3& principal) {
  return principal[2] <= 1.001 * (principal[0] + principal[1]);
}

void read_mass(Attributes& attributes, state::BodyDescription& body) {
  body.mass_kg = attributes.number("mass");
  body.inertia_kg_m2 = attributes.symmetric_matrix("inertia");
  body.p_BCm = attributes.vector("centerOfMass");
  if (body.fixed) return;
  if (body.mass_kg <= 0)
    attributes.error(ErrorCode::invalid_value, "the mass is 0 kg", "write a mass above 0, or fixed='true'");
  const Vec3 principal = principal_moments(body.inertia_kg_m2);
  if (principal[0] <= 0) {
    attributes.error(ErrorCode::invalid_value, "the inertia is not positive definite",
                     "write the inertia of a solid body, in kg m^2");
  } else if (!is_of_a_solid(principal)) {
    attributes.error(ErrorCode::invalid_value,
                     "no solid body has this inertia: one principal moment is larger than the sum of the others",
                     "compute it again from the shape, or leave it out: then it is computed from the mesh");
  }
}

/// Warns of a mass that nothing of this shape can have or, without a shape, that no exhibit has.
void check_mass(Attributes& attributes, const state::BodyDescription& body, const std::optional<Solid>& solid) {
  constexpr double kAir = 1.2, kOsmium = 22600, kOak = 700;  // kg/m^3; no metal is denser than osmium
  constexpr double kLeast_kg = 1e-4, kMost_kg = 1e6;  // of things to touch in a museum, where the shape is not known
  const bool closed = solid && solid->is_closed();
  const double room_m3 = closed ? solid->volume_m3 : solid ? std::max(solid->volume_m3, solid->box_m3) : 0;
  if (closed && body.mass_kg < kAir * solid->volume_m3) {
    attributes.warning(ErrorCode::invalid_value,
                       fmt::format("the mass of {:.3g} kg is less than that of air: the mesh encloses {:.3g} m^3",
                                   body.mass_kg, solid->volume_m3),
                       fmt::format("write it in kilograms: made of oak it has some {:.2g}", kOak * solid->volume_m3));
  } else if (room_m3 > 0 && body.mass_kg > kOsmium * room_m3) {
    attributes.warning(
        ErrorCode::invalid_value,
        fmt::format("the mass of {:.3g} kg is more than that of any metal: the mesh {} {:.3g} m^3", body.mass_kg,
                    closed ? "encloses" : "fits into", room_m3),
        fmt::format("write it in kilograms, and the mesh in metres: made of oak it has some {:.2g}", kOak * room_m3));
  } else if (!solid && (body.mass_kg < kLeast_kg || body.mass_kg >= kMost_kg)) {
    attributes.warning(ErrorCode::invalid_value,
                       fmt::format("a mass of {:.3g} kg is outside what an exhibit can have", body.mass_kg),
                       "write it in kilograms");
  }
}

/// Computes an inertia that the author left out: from a closed mesh as of a uniform solid, from an open one as of a thin shell. Without
/// a mesh X3D's default stays.
void complete_inertia(Attributes& attributes, const Expected<std::optional<Solid>>& solid, bool has_mesh,
                      state::BodyDescription& body) {
  std::string why;
  if (!has_mesh) {
    why = "there is no mesh to compute it from";
  } else if (!solid) {
    why = "it cannot be computed: " + solid.error().what;
  } else if (!*solid) {
    return;  // the loader does not read meshes, or has reported the file
  } else {
    const bool closed = (*solid)->is_closed();
    const Mat3 inertia_kg_m2 = body.mass_kg * (*solid)->inertia_per_kg_m2;
    const Vec3 principal = principal_moments(inertia_kg_m2);
    if (principal[0] > 0 && is_of_a_solid(principal)) {
      body.inertia_kg_m2 = inertia_kg_m2;
      if (closed) return;
      attributes.warning(ErrorCode::missing,
                         fmt::format("the inertia is not given, and the mesh is not closed ({} open edges): it is "
                                     "computed as of a thin shell",
                                     (*solid)->open_edges),
                         "write it, or give the body a closed mesh");
      return;
    }
    why = fmt::format("the mesh {}, so it cannot be computed", closed ? "crosses itself" : "has no area");
  }
  attributes.warning(ErrorCode::missing,
                     fmt::format("the inertia is not given, and {}: it is taken as 1 kg m^2 about every axis", why),
                     "write it, or give the body a closed mesh");
}

void compare_with_mesh(Compilation& c, Attributes& attributes, const std::string& touched,
                       state::BodyDescription& body) {
  if (body.fixed || body.mass_kg <= 0) return;
  const bool has_mesh = !body.mesh.uri.empty();
  const bool missing = !attributes.given("inertia");
  Expected<std::optional<Solid>> solid = std::nullopt;
  if (has_mesh && (missing || c.loader.has_meshes_at_hand()))
    solid = c.loader.solid(c.document.path().parent_path() / body.mesh.uri, touched.empty() ? body.mesh.node : touched);
  check_mass(attributes, body, solid ? *solid : std::nullopt);
  if (missing) complete_inertia(attributes, solid, has_mesh, body);
}

double damping(const Compilation& c, Attributes& attributes, std::string_view name, double otherwise) {
  // X3D applies the factors only with autoDamp; without it a body has the small damping of air, but none in plain X3D.
  if (attributes.boolean("autoDamp") && (attributes.given(name) || is_plain(c))) return attributes.number(name);
  return is_plain(c) ? 0 : otherwise;
}

Vec3 sum_of(const std::vector<double>& vectors) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i + 2 < vectors.size(); i += 3)
    sum += Vec3(vectors[i], vectors[i + 1], vectors[i + 2]);
  return sum;
}

/// How it moves at the start, and what drives it.
void read_motion(Compilation& c, x3d::NodeId id, const Attributes& attributes, state::BodyDescription& body) {
  body.V_WB.w = attributes.vector("angularVelocity");
  body.V_WB.v = attributes.vector("linearVelocity") - body.V_WB.w.cross(body.X_WB.R * body.p_BCm);
  const x3d::NodeFields fields(c.document, id);
  body.drive = {sum_of(fields.numbers("forces")), sum_of(fields.numbers("torques"))};
}

void compile_body(Compilation& c, x3d::NodeId id) {
  Attributes attributes(c.document, id, c.problems);
  state::BodyDescription body;
  body.name = x3d::node_name(c.document, id);
  if (!is_plain(c) && attributes.text("DEF").empty()) {
    attributes.error(ErrorCode::missing, "a RigidBody has no DEF",
                     "give it a name: everything refers to bodies by name");
    return;
  }
  body.fixed = attributes.boolean("fixed");
  body.use_gravity = attributes.boolean("useGlobalGravity");
  body.X_WB = {attributes.vector("position"), attributes.rotation("orientation")};
  body.visible = attributes.boolean("visible");
  body.linear_damping = damping(c, attributes, "linearDampingFactor", body.linear_damping);
  body.angular_damping = damping(c, attributes, "angularDampingFactor", body.angular_damping);
  read_mass(attributes, body);
  read_collection(c, id, body);
  read_haptic(c, id, body);
  const auto set = x3d::read_metadata(c.document, id, "mechane:body", c.problems);
  const Fields fields(set ? &*set : nullptr, body_table(), "mechane:body of " + body.name, c.problems);
  const std::string touched = read_shape(c, id, attributes, fields, set.has_value(), body);
  compare_with_mesh(c, attributes, touched, body);
  const auto add = [&](state::BodyDescription one) {
    if (!one.fixed) read_motion(c, id, attributes, one);
    c.world.bodies.push_back(std::move(one));
    c.body_lines.push_back(c.document[id].line);
    c.touchable.push_back(!touched.empty());
  };
  const std::vector<Pose> copies = read_copies(c, id, fields, body.X_WB);
  if (copies.empty()) return add(std::move(body));
  for (std::size_t i = 0; i < copies.size(); ++i) {
    state::BodyDescription copy = body;
    copy.name = copy_name(body.name, i);
    copy.X_WB = copies[i];
    add(std::move(copy));
  }
}

}  // namespace

state::BodyDescription& add_own_body(Compilation& c, const std::string& name, x3d::NodeId id) {
  state::BodyDescription body;
  body.name = name;
  body.fixed = true;
  const ShapeNodes shape{own_url(c), name, name};
  body.mesh = {shape.url, c.model_hashes[shape.url], shape.drawn};
  auto object = c.loader.load(c.document.path().parent_path() / shape.url, shape.touched, {});
  if (object) {
    body.object = std::move(*object);
  } else {
    refuse_node(c, shape, {c.document.describe(id), c.document[id].line}, shape.touched, object.error());
  }
  c.world.bodies.push_back(std::move(body));
  c.body_lines.push_back(c.document[id].line);
  c.touchable.push_back(true);
  return c.world.bodies.back();
}

void compile_scenery(Compilation& c) {
  if (c.shapes.has_scenery() && !c.world.find_body(x3d::kScenery)) add_own_body(c, x3d::kScenery, c.document.scene());
}

void compile_bodies(Compilation& c) {
  const std::vector<x3d::NodeId> collections = c.document.elements("RigidBodyCollection");
  for (const x3d::NodeId id : collections) {
    Attributes attributes(c.document, id, c.problems);
    if (id == collections.front()) {
      c.world.gravity_W = attributes.vector("gravity");
    } else {
      attributes.warning(ErrorCode::duplicate,
                         "there is a second RigidBodyCollection: its bodies have the gravity of the first one",
                         "move its bodies and joints into the first one");
    }
  }
  for (const x3d::NodeId id : c.document.elements("RigidBody"))
    compile_body(c, id);
}

}  // namespace mechane::scenario
