// geometry.rope: a rope of fixed length over sheaves, from a point or a drum to a point. It only pulls.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

using state::Coupling;
using state::ParameterKind;

class Rope final : public Agent {
 public:
  Rope(const Build& build, const Coupling& rope, double length_m)
      : length_m_(length_m),
        real_per_felt_(build.real_per_felt()),
        coupling_(build.coupling(rope)),
        tension_(build.slot("tension_n")),
        end_tension_(build.slot("end_tension_n")),
        length_(build.slot("length_m", length_m)),
        slack_(build.slot("slack")) {}

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    Coupling& rope = state.couplings[coupling_];
    rope.enabled = enabled;
    rope.offset = length_m_;
    state.memory[tension_] = rope.force_n * real_per_felt_;
    state.memory[end_tension_] = rope.end_force_n * real_per_felt_;
    state.memory[length_] = rope.length_m;
    state.memory[slack_] = rope.slack_m;
  }

 private:
  double length_m_;
  double real_per_felt_;
  std::size_t coupling_;
  std::size_t tension_;
  std::size_t end_tension_;
  std::size_t length_;
  std::size_t slack_;
};

/// invalid_value: a list is given that has not `each` numbers for each of the `nodes`.
Expected<void> check_count(const Build& build, const char* name, std::size_t each, std::size_t nodes) {
  const std::size_t count = build.parameters.numbers(name).size();
  if (!build.parameters.given(name) || count == each * nodes) return {};
  return fail(ErrorCode::invalid_value, fmt::format("{} has {} numbers for {} bodies", name, count, nodes),
              build.place(name), fmt::format("write {} for each of 'bodies'", each));
}

Vec3 vector_at(const std::vector<double>& numbers, std::size_t i) {
  return {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
}

Expected<void> read_drum(const Build& build, Coupling& rope) {
  const state::Parameters& p = build.parameters;
  const auto drum = build.joint("drum", state::JointKind::hinge);
  if (!drum) return tl::unexpected(drum.error());
  if (!p.given("drumRadius"))
    return fail(ErrorCode::missing, "a drum is given, but not its radius", build.place("drum"),
                "give drumRadius, in m");
  const state::JointDescription& joint = build.description.joints[drum->index()];
  rope.drum = true;
  rope.joint1 = *drum;
  rope.body1 = joint.body1;
  state::RopeNode& node = rope.nodes[rope.node_count++];
  node.body = joint.body2;
  node.p_BC = joint.X_B2J.p;
  node.axis_B = joint.X_B2J.rotate(Vec3::UnitZ());
  node.radius_m = p.number("drumRadius");
  node.sense = p.boolean("drumReverse") ? 1 : -1;  // the rope runs off the drum; winding goes against its way
  return {};
}

Expected<Coupling> read_rope(const Build& build) {
  const state::Parameters& p = build.parameters;
  const std::vector<std::string> bodies = p.texts("bodies");
  Coupling rope;
  rope.kind = state::CouplingKind::rope;
  if (p.given("drum")) {
    if (auto good = read_drum(build, rope); !good) return tl::unexpected(good.error());
  }
  const std::size_t most = rope.nodes.size() - rope.node_count, least = 2 - rope.node_count;
  if (bodies.size() < least || bodies.size() > most)
    return fail(ErrorCode::invalid_value, fmt::format("the rope has {} bodies", bodies.size()), build.place("bodies"),
                fmt::format("name {} to {}: where it ends and what it runs over", least, most));
  if (p.numbers("points").size() != 3 * bodies.size())
    return fail(ErrorCode::invalid_value,
                fmt::format("points has {} numbers for {} bodies", p.numbers("points").size(), bodies.size()),
                build.place("points"), "write x y z for each of 'bodies', in the body's frame");
  for (const auto& [name, each] :
       {std::pair{"radii", 1}, std::pair{"senses", 1}, std::pair{"efficiencies", 1}, std::pair{"axes", 3}}) {
    if (auto good = check_count(build, name, static_cast<std::size_t>(each), bodies.size()); !good)
      return tl::unexpected(good.error());
  }
  const auto number = [&](const char* name, std::size_t i, double otherwise) {
    return p.given(name) ? p.numbers(name)[i] : otherwise;
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    state::RopeNode& node = rope.nodes[rope.node_count++];
    node.body = build.description.find_body(bodies[i]);
    node.p_BC = vector_at(p.numbers("points"), i);
    node.radius_m = number("radii", i, 0);
    node.sense = number("senses", i, 1) < 0 ? -1 : 1;
    node.efficiency = number("efficiencies", i, p.number("efficiency"));
    node.friction_coefficient = p.number("capstan");
    if (!p.given("axes")) continue;
    node.axis_B = vector_at(p.numbers("axes"), i);
    if (node.axis_B.norm() < 1e-9)
      return fail(ErrorCode::invalid_value, fmt::format("axis {} in 'axes' is 0 0 0, which has no direction", i + 1),
                  build.place("axes"), "write a vector, like 0 0 1");
    node.axis_B.normalize();
  }
  return rope;
}

/// The length of the rope's way at the start. Notes where it leaves the drum then.
double measure_at_start(const state::WorldDescription& world, Coupling& rope) {
  std::array<Pose, state::kMaxRopeNodes> X_WN;
  for (std::size_t i = 0; i < rope.node_count; ++i) {
    if (rope.nodes[i].body) X_WN[i] = world.bodies[rope.nodes[i].body.index()].X_WB;
  }
  const Quat R_W1 = rope.body1 ? world.bodies[rope.body1.index()].X_WB.R : Quat::Identity();
  const state::RopePath path = state::measure_rope(rope, X_WN, R_W1);
  const Vec3 arm_W = path.p_out_W[0] - X_WN[0] * rope.nodes[0].p_BC;
  if (rope.drum && arm_W.norm() > 1e-9) rope.drum_start_1 = R_W1.conjugate() * arm_W.normalized();
  return path.length_m;
}

Expected<std::unique_ptr<Agent>> make_rope(const Build& build) {
  auto rope = read_rope(build);
  if (!rope) return tl::unexpected(rope.error());
  const double way = measure_at_start(build.description, *rope);
  rope->diameter_m = build.parameters.number("diameter");
  rope->length_m = build.parameters.given("length") ? build.parameters.number("length") : way;
  return std::make_unique<Rope>(build, *rope, rope->length_m);
}

constexpr state::ParameterType kRopeParameters[] = {
    {.name = "bodies",
     .kind = ParameterKind::texts,
     .summary = "where it begins (without a drum), what it runs over, where it ends; a body for each",
     .required = true,
     .reference = state::Reference::body},
    {.name = "points",
     .kind = ParameterKind::numbers,
     .unit = "m",
     .summary = "x y z of each in its body's frame: an end, or a sheave's centre",
     .required = true,
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "radii",
     .kind = ParameterKind::numbers,
     .unit = "m",
     .summary = "of the sheaves; 0: the rope runs through the point. Of an end it is not used",
     .min = 0,
     .max = 100},
    {.name = "axes",
     .kind = ParameterKind::numbers,
     .summary = "x y z of each sheave's axis in its body's frame; none: 0 0 1",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "senses",
     .kind = ParameterKind::numbers,
     .summary = "which way round each: 1 right-handed about its axis from first to last, -1 left-handed",
     .default_value = 1,
     .min = -1,
     .max = 1},
    {.name = "efficiency",
     .summary = "of every sheave: the lower tension over the higher while the rope moves",
     .default_value = 1,
     .min = 0.01,
     .max = 1},
    {.name = "efficiencies",
     .kind = ParameterKind::numbers,
     .summary = "the same, for each",
     .default_value = 1,
     .min = 0.01,
     .max = 1},
    {.name = "capstan",
     .summary = "friction coefficient of a rope on a beam or a post: efficiency falls with the wrap, exp(-it * rad)",
     .min = 0,
     .max = 3},
    {.name = "length",
     .unit = "m",
     .summary = "unstretched, off the drum, at the start; none: as long as its way then",
     .min = 0.001,
     .max = state::kFarthest_m},
    {.name = "diameter", .unit = "m", .summary = "as it is drawn", .default_value = 0.02, .min = 1e-3, .max = 0.5},
    {.name = "drum",
     .kind = ParameterKind::text,
     .summary = "the hinge of a drum that it begins on and is wound on",
     .reference = state::Reference::joint},
    {.name = "drumRadius", .unit = "m", .summary = "of the drum, to the rope's middle", .min = 1e-3, .max = 100},
    {.name = "drumReverse",
     .kind = ParameterKind::boolean,
     .summary = "turning the drum to lower angles winds; otherwise to higher ones"},
};
constexpr state::ValueType kRopeValues[] = {
    state::amount("tension_n", "N", "of its first part, at the drum: the real tension"),
    state::amount("end_tension_n", "N", "of its last part: the real tension"),
    {"length_m", "m", "off the drum"},
    state::amount("slack", "m", "how much longer it is than its way; 0: taut"),
};

}  // namespace

const AgentKind& rope_kind() {
  static const AgentKind kKind{
      {"geometry.rope", "A rope over sheaves, from a drum or a point; off: it is cut", kRopeParameters, kRopeValues},
      make_rope};
  return kKind;
}

}  // namespace mechane::agents
