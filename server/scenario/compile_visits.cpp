// Reads scripted visits: the moves of a visitor's hand.
#include <array>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

using Kind = state::VisitMove::Kind;

Kind kind_of(const std::string& word) {
  constexpr std::array<std::pair<std::string_view, Kind>, 7> kKinds{{{"reach", Kind::reach},
                                                                     {"grasp", Kind::grasp},
                                                                     {"move_to", Kind::move_to},
                                                                     {"turn", Kind::turn},
                                                                     {"swing", Kind::swing},
                                                                     {"release", Kind::release},
                                                                     {"wait", Kind::wait}}};
  for (const auto& [name, kind] : kKinds) {
    if (name == word) return kind;
  }
  return Kind::wait;
}

void need(Compilation& c, const Fields& fields, std::string_view kind, std::string_view key) {
  if (fields.given(key) || fields.has_faults()) return;
  c.problems.error(ErrorCode::missing, fields.line(key), fields.where(),
                   fmt::format("a {} needs the key '{}'", kind, key), "add it");
}

BodyId read_body(Compilation& c, const Fields& fields, std::string_view kind) {
  need(c, fields, kind, "body");
  return find_body(c, fields);
}

JointId read_hinge(Compilation& c, const Fields& fields, std::string_view kind) {
  need(c, fields, kind, "joint");
  if (!fields.given("joint")) return JointId::none();
  const std::string name = fields.string("joint");
  const JointId joint = c.world.find_joint(name);
  if (!joint) {
    report_unknown(c, {fields.where(), fields.line("joint")}, "joint", name, names_of(c.world.joints),
                   "add a SingleAxisHingeJoint of that DEF");
  } else if (c.world.joints[joint.index()].kind != state::JointKind::hinge) {
    c.problems.error(ErrorCode::conflict, fields.line("joint"), fields.where(),
                     fmt::format("the joint '{}' is not a hinge", name), "name a SingleAxisHingeJoint");
  }
  return joint;
}

state::VisitMove compile_move(Compilation& c, const x3d::Metadata& set, const std::string& visit) {
  const Fields fields(&set, move_table(), fmt::format("{}, {}", visit, set.name), c.problems);
  const std::string kind = fields.string("kind");
  state::VisitMove move;
  move.kind = kind_of(kind);
  move.duration_s = fields.number("seconds");
  switch (move.kind) {
    case Kind::reach:
      move.body = read_body(c, fields, kind);
      need(c, fields, kind, "grip");
      move.p_BG = fields.vector("grip");
      break;
    case Kind::grasp:
      move.body = read_body(c, fields, kind);
      break;
    case Kind::move_to:
      move.body = read_body(c, fields, kind);
      need(c, fields, kind, "position");
      if (move.body) move.X_WB = c.world.bodies[move.body.index()].X_WB;
      move.X_WB.p = fields.vector("position");
      if (fields.given("orientation")) move.X_WB.R = fields.rotation("orientation");
      break;
    case Kind::turn:
      move.joint = read_hinge(c, fields, kind);
      need(c, fields, kind, "turns");
      move.turns = fields.number("turns");
      move.rate_rpm = fields.number("rpm");
      break;
    case Kind::swing:
      move.joint = read_hinge(c, fields, kind);
      need(c, fields, kind, "angle");
      move.amplitude_rad = fields.number("angle");
      if (fields.given("angle") && move.amplitude_rad == 0) {
        c.problems.error(ErrorCode::invalid_value, fields.line("angle"), fields.where(), "the angle of this swing is 0",
                         "write how far it goes, in radians");
      }
      move.cycles = fields.number("cycles");
      move.cycles_per_min = fields.number("perMinute");
      break;
    case Kind::release:
    case Kind::wait:
      break;
  }
  return move;
}

}  // namespace

void compile_visits(Compilation& c) {
  const x3d::Metadata* tree = tree_set(c, "visits");
  if (tree == nullptr) return;
  for (const x3d::Metadata& set : tree->children) {
    const std::string where = "visit " + set.name;
    if (set.kind != x3d::MetadataKind::set) {
      c.problems.error(ErrorCode::invalid_value, set.line, where, "the visit is not a set", "write a MetadataSet");
      continue;
    }
    const Fields fields(&set, visit_table(), where, c.problems);
    state::VisitDescription visit;
    visit.name = set.name;
    const std::string activity = fields.string("activity");
    visit.activity = c.world.find_activity(activity);
    if (fields.given("activity") && !visit.activity) {
      report_unknown(c, {where, fields.line("activity")}, "activity", activity, names_of(c.world.activities),
                     "add it to the scenario's activities");
    }
    for (const x3d::Metadata* move : fields.sets_like("move:*"))
      visit.moves.push_back(compile_move(c, *move, where));
    c.world.visits.push_back(std::move(visit));
  }
}

}  // namespace mechane::scenario
