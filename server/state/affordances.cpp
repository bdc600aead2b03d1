#include "server/state/affordances.hpp"

#include <algorithm>
#include <string>

namespace mechane::state {
namespace {

BodyId body_of(const WorldDescription& description, const ComponentDescription& component, const char* name) {
  const auto* texts = component.written<std::vector<std::string>>(name);
  return texts == nullptr || texts->empty() ? BodyId{} : description.find_body(texts->front());
}

/// The first `count` numbers of a parameter; zeros where the author wrote fewer.
std::vector<double> numbers_of(const ComponentDescription& component, const char* name, std::size_t count) {
  std::vector<double> out(count, 0.0);
  const auto* written = component.written<std::vector<double>>(name);
  for (std::size_t i = 0; written != nullptr && i < std::min(count, written->size()); ++i)
    out[i] = (*written)[i];
  return out;
}

Vec3 point_of(const ComponentDescription& component, const char* name) {
  const std::vector<double> p = numbers_of(component, name, 3);
  return {p[0], p[1], p[2]};
}

void add_taken(const WorldDescription& description, AgentId agent, std::vector<Affordance>& out) {
  const auto add = [&](BodyId body) {
    if (body && !description.bodies[body.index()].fixed)
      out.push_back({Affordance::Kind::taken, agent, body, {}, {}, {}});
  };
  const auto* named = description.agents[agent.index()].written<std::vector<std::string>>("bodies");
  if (named == nullptr) {
    for (std::size_t i = 0; i < description.bodies.size(); ++i)
      add(BodyId(i));
    return;
  }
  for (const std::string& name : *named)
    add(description.find_body(name));
}

void add_place(const WorldDescription& description, AgentId agent, std::vector<Affordance>& out) {
  const ComponentDescription& snap = description.agents[agent.index()];
  const BodyId object = body_of(description, snap, "object");
  if (!object) return;
  const std::vector<double> turn = numbers_of(snap, "rotation", 4);
  const Vec3 about(turn[0], turn[1], turn[2]);
  Pose X_AJ{point_of(snap, "position"), Quat::Identity()};
  if (about.norm() > 1e-9) X_AJ.R = Quat(Eigen::AngleAxisd(turn[3], about.normalized()));
  out.push_back({Affordance::Kind::placed, agent, object, body_of(description, snap, "into"), X_AJ, {}});
}

void add_fire(const WorldDescription& description, AgentId agent, std::vector<Affordance>& out) {
  const ComponentDescription& lit = description.agents[agent.index()];
  const BodyId flame = body_of(description, lit, "flame");
  const BodyId hearth = body_of(description, lit, "body");
  if (!flame || !hearth) return;
  const Pose at{point_of(lit, "at"), Quat::Identity()};
  const Pose burns{point_of(lit, "flamePoint"), Quat::Identity()};
  // The flame is brought to the hearth; but where the flame's body is fixed, the torch is brought to the flame.
  const bool comes = description.bodies[flame.index()].fixed;
  out.push_back(comes ? Affordance{Affordance::Kind::brought, agent, hearth, flame, burns, at}
                      : Affordance{Affordance::Kind::brought, agent, flame, hearth, at, burns});
}

}  // namespace

std::vector<Affordance> affordances_of(const WorldDescription& description) {
  std::vector<Affordance> out;
  for (const JointDescription& joint : description.joints) {
    if (joint.kind == JointKind::ball || !joint.body2) continue;
    const Affordance::Kind kind = joint.kind == JointKind::hinge ? Affordance::Kind::turns : Affordance::Kind::slides;
    out.push_back({kind, {}, joint.body2, joint.body1, joint.X_B1J, joint.X_B2J});
  }
  for (std::size_t i = 0; i < description.agents.size(); ++i) {
    const std::string& type = description.agents[i].type;
    if (type == "simulation.grasp") add_taken(description, AgentId(i), out);
    if (type == "geometry.snap") add_place(description, AgentId(i), out);
    if (type == "simulation.lit") add_fire(description, AgentId(i), out);
  }
  if (out.size() > kMaxAffordances) out.resize(kMaxAffordances);
  return out;
}

}  // namespace mechane::state
