// RigidBody nodes to bodies.
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

/// The url of a model's mesh file, checked to be there; empty after a problem.
std::string model_url(Compilation& c, const Fields& fields) {
  const std::string model = fields.string("model");
  if (!fields.given("model")) return {};
  const x3d::NodeId id = c.document.find_def(model);
  if (!id || c.document[id].name != "Inline") {
    c.problems.error(
        fields.line("model"), fields.where(), fmt::format("no Inline has the DEF '{}'", model),
        suggest(model, c.document.defs("Inline"), "add <Inline DEF='...' url='\"model.glb\"'/> to the Scene"));
    return {};
  }
  Attributes inline_node(c.document, id, c.problems);
  const std::vector<std::string> urls = inline_node.strings("url");
  if (urls.empty()) {
    inline_node.error("the Inline has no url", "write url='\"model.glb\"'");
    return {};
  }
  const std::string& url = urls.front();
  if (!x3d::is_relative_path(url)) {
    inline_node.error(fmt::format("the url '{}' is not a path beside the scenario", url),
                      "copy the file there and name it by a relative path");
    return {};
  }
  if (!c.model_hashes.contains(url)) {
    const auto hash = c.loader.content_hash(c.document.path().parent_path() / url);
    if (!hash) {
      inline_node.error(fmt::format("the mesh file '{}' cannot be read: {}", url, hash.error().what),
                        "check the url, or build the models");
      c.model_hashes[url] = "";
      return {};
    }
    c.model_hashes[url] = *hash;
  }
  return c.model_hashes[url].empty() ? std::string() : url;
}

void read_shape(Compilation& c, x3d::NodeId id, Attributes& attributes, state::BodyDescription& body) {
  const auto set = x3d::read_metadata(c.document, id, "mechane:body", c.problems);
  if (!set) {
    attributes.warning("the body has no 'mechane:body': it is neither drawn nor touched",
                       "name its model and node there");
    return;
  }
  const Fields fields(&*set, body_table(), "mechane:body of " + body.name, c.problems);
  body.title = read_texts(c, fields.set("text"), fields.where() + ", text", "title")["title"];
  const std::string url = model_url(c, fields);
  if (url.empty()) return;
  body.mesh = {url, c.model_hashes[url], fields.given("node") ? fields.string("node") : body.name};
  body.collides = fields.boolean("collides");
  body.restitution = fields.number("restitution");
  const std::filesystem::path file = c.document.path().parent_path() / url;
  const auto refuse_node = [&](const Error& error) {
    c.problems.error(fields.line("node"), fields.where(),
                     fmt::format("node '{}' of {}: {}", body.mesh.node, url, error.what), error.remedy);
  };
  if (!fields.boolean("touchable")) {
    if (const auto found = c.loader.find_node(file, body.mesh.node); !found) refuse_node(found.error());
    if (!body.collides) return;
    c.problems.error(fields.line("collides"), fields.where(), "the body is to collide but is not touchable",
                     "remove touchable false: one shape serves both");
    return;
  }
  auto object = c.loader.load(file, body.mesh.node);
  if (!object) return refuse_node(object.error());
  body.object = std::move(*object);
}

void read_haptic(Compilation& c, x3d::NodeId id, state::BodyDescription& body) {
  const auto set = x3d::read_metadata(c.document, id, "mechane:haptic", c.problems);
  const Fields fields(set ? &*set : nullptr, haptic_table(), "mechane:haptic of " + body.name, c.problems);
  body.haptic = {fields.number("stiffness"), fields.number("damping"), fields.number("staticFriction"),
                 fields.number("dynamicFriction")};
  body.effort_scale = fields.number("effortScale");
  body.graspable = fields.boolean("graspable");
  if (body.haptic.dynamic_friction > body.haptic.static_friction) {
    c.problems.error(fields.line("dynamicFriction"), fields.where(), "friction grows when it slips",
                     "write a dynamicFriction below the staticFriction");
  }
}

void read_mass(Attributes& attributes, state::BodyDescription& body) {
  body.mass_kg = attributes.number("mass");
  body.inertia_kg_m2 = attributes.symmetric_matrix("inertia");
  body.p_BCm = attributes.vector("centerOfMass");
  if (body.fixed) return;
  if (body.mass_kg <= 0) attributes.error("the mass is 0 kg", "write a mass above 0, or fixed='true'");
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(body.inertia_kg_m2, Eigen::EigenvaluesOnly);
  const Vec3& principal = solver.eigenvalues();  // from small to large
  if (principal[0] <= 0) {
    attributes.error("the inertia is not positive definite", "write the inertia of a solid body, in kg m^2");
  } else if (principal[2] > 1.001 * (principal[0] + principal[1])) {
    attributes.error("no solid body has this inertia: one principal moment is larger than the sum of the others",
                     "compute it anew from the shape");
  } else if (!attributes.given("inertia")) {
    attributes.warning("the inertia is not given and is taken as 1 kg m^2 about every axis",
                       "write it, computed from the shape");
  }
}

double damping(Attributes& attributes, std::string_view name, double otherwise) {
  // X3D applies the factors only where autoDamp says so; without it a body has the air's small damping.
  return attributes.boolean("autoDamp") && attributes.given(name) ? attributes.number(name) : otherwise;
}

void compile_body(Compilation& c, x3d::NodeId id) {
  Attributes attributes(c.document, id, c.problems);
  state::BodyDescription body;
  body.name = attributes.text("DEF");
  if (body.name.empty()) {
    attributes.error("a RigidBody has no DEF", "give it a name: everything refers to bodies by name");
    return;
  }
  body.fixed = attributes.boolean("fixed");
  body.use_gravity = attributes.boolean("useGlobalGravity");
  body.X_WB = {attributes.vector("position"), attributes.rotation("orientation")};
  body.visible = attributes.boolean("visible");
  body.linear_damping = damping(attributes, "linearDampingFactor", body.linear_damping);
  body.angular_damping = damping(attributes, "angularDampingFactor", body.angular_damping);
  read_mass(attributes, body);
  read_haptic(c, id, body);
  read_shape(c, id, attributes, body);
  c.world.bodies.push_back(std::move(body));
  c.body_lines.push_back(c.document[id].line);
}

}  // namespace

void compile_bodies(Compilation& c) {
  const std::vector<x3d::NodeId> collections = c.document.elements("RigidBodyCollection");
  for (const x3d::NodeId id : collections) {
    Attributes attributes(c.document, id, c.problems);
    if (id == collections.front()) {
      c.world.gravity_W = attributes.vector("gravity");
    } else {
      attributes.warning("a second RigidBodyCollection: its bodies move in the first one, with the first one's gravity",
                         "merge them");
    }
  }
  for (const x3d::NodeId id : c.document.elements("RigidBody"))
    compile_body(c, id);
}

}  // namespace mechane::scenario
