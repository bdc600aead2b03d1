#include "client-sdk/client/parse.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "client-sdk/client/clean_text.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::client {
namespace {

static_assert(mechane_affordance_taken == static_cast<int>(Affordance::Kind::taken));
static_assert(mechane_affordance_turns == static_cast<int>(Affordance::Kind::turns));
static_assert(mechane_affordance_slides == static_cast<int>(Affordance::Kind::slides));
static_assert(mechane_affordance_placed == static_cast<int>(Affordance::Kind::placed));
static_assert(mechane_affordance_brought == static_cast<int>(Affordance::Kind::brought));

bool parse_pose(const proto::WirePose& wire, Pose& out) noexcept {
  if (!proto::all_finite(wire)) return false;
  out = proto::to_pose(wire);
  return proto::normalise(out);
}

/// False where a direction is not nearly of unit length.
bool make_unit(Vec3& direction) noexcept {
  const double length = direction.norm();
  if (!(length > 0.99 && length < 1.01)) return false;
  direction /= length;
  return true;
}

Duration parse_validity(std::uint32_t valid_us) noexcept {
  return std::chrono::microseconds(std::min<std::uint32_t>(valid_us, 1'000'000));
}

bool parse_contact(const proto::WireLocalContact& wire, LocalContact& out) noexcept {
  if (!(proto::all_finite(wire.p_W) && proto::all_finite(wire.n_W) && proto::all_finite(wire.v_W) &&
        proto::all_finite(wire.groove_wave_W)))
    return false;
  for (const float v :
       {wire.depth_m, wire.curvature_per_m, wire.stiffness_n_per_m, wire.damping_ns_per_m, wire.static_friction,
        wire.dynamic_friction, wire.viscosity_ns_per_m, wire.groove_depth_m, wire.groove_phase_rad}) {
    if (!std::isfinite(v)) return false;
  }
  out.p_W = proto::to_vec3(wire.p_W);
  out.n_W = proto::to_vec3(wire.n_W);
  if (!make_unit(out.n_W)) return false;
  out.v_W = proto::to_vec3(wire.v_W);
  out.depth_m = wire.depth_m;
  out.curvature_per_m = wire.curvature_per_m;
  out.stiffness_n_per_m = std::max(0.0f, wire.stiffness_n_per_m);
  out.damping_ns_per_m = std::max(0.0f, wire.damping_ns_per_m);
  out.static_friction = std::max(0.0f, wire.static_friction);
  out.dynamic_friction = std::max(0.0f, wire.dynamic_friction);
  out.viscosity_ns_per_m = std::clamp<double>(wire.viscosity_ns_per_m, 0, hand::kMaxViscosity_ns_per_m);
  out.grooves = {wire.groove_depth_m, proto::to_vec3(wire.groove_wave_W), wire.groove_phase_rad};
  if (!hand::are_renderable(out.grooves.depth_m, out.grooves.wave_W.norm())) out.grooves = {};  // the surface stays
  out.validity = parse_validity(wire.valid_us);
  return true;
}

bool parse_held(const proto::WireHeldPath& wire, HeldPath& out) noexcept {
  if (wire.kind == mechane_held_none) return true;
  if (wire.kind > mechane_held_free) return false;
  if (!(proto::all_finite(wire.p_HG) && proto::all_finite(wire.p_W) && proto::all_finite(wire.axis_W))) return false;
  for (const float v : {wire.radius_m, wire.along_n, wire.stiffness_n_per_m, wire.damping_ns_per_m, wire.limit_n}) {
    if (!std::isfinite(v)) return false;
  }
  out.kind = static_cast<HeldPath::Kind>(wire.kind);
  out.p_HG = proto::to_vec3(wire.p_HG);
  out.p_W = proto::to_vec3(wire.p_W);
  out.axis_W = proto::to_vec3(wire.axis_W);
  out.radius_m = wire.radius_m;
  out.along_n = wire.kind == mechane_held_free ? std::max(0.0f, wire.along_n) : wire.along_n;
  out.stiffness_n_per_m = std::max(0.0f, wire.stiffness_n_per_m);
  out.damping_ns_per_m = std::max(0.0f, wire.damping_ns_per_m);
  out.limit_n = std::max(0.0f, wire.limit_n);
  out.validity = parse_validity(wire.valid_us);
  return make_unit(out.axis_W) && (out.kind != HeldPath::Kind::circle || out.radius_m > 0);
}

bool parse_hand(const proto::WireHandPose& wire, HandPose& out) {
  const auto segments = proto::elements(wire.X_WS);
  if (segments.empty() || segments.size() > kHandSegments || !hand::is_hand_kind(wire.kind) ||
      !proto::all_finite(wire.f_W))
    return false;
  out.kiosk = clean(wire.kiosk);
  out.user = wire.user;
  out.kind = static_cast<HandKind>(wire.kind);
  out.stale = wire.stale != 0;
  out.holding = wire.holding != 0;
  out.force_W = proto::to_vec3(wire.f_W);
  out.X_WS.fill(Pose{});
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (!parse_pose(segments[i], out.X_WS[i])) return false;
  }
  return true;
}

template <class Sequence>
bool parse_texts(const Sequence& wire, std::map<std::string, std::string>& out) {
  const auto texts = proto::elements(wire);
  if (texts.size() > mechane_kMaxLanguages) return false;
  out.clear();
  for (const proto::WireText& text : texts)
    out[clean(text.language)] = clean_string(text.content);
  return true;
}

bool parse_quantity(const proto::WireQuantity& wire, QuantityInfo& out) {
  out.name = clean_string(wire.name);
  out.unit = clean_string(wire.unit);
  if (wire.ranged) {
    if (!std::isfinite(wire.least) || !std::isfinite(wire.greatest) || !(wire.least < wire.greatest)) return false;
    out.range = {wire.least, wire.greatest};
  }
  return parse_texts(wire.label, out.label);
}

template <class Sequence>
bool parse_strings(const Sequence& wire, std::vector<std::string>& out) {
  const auto strings = proto::elements(wire);
  if (strings.size() > kMaxQuantities) return false;
  out.clear();
  for (const char* text : strings)
    out.push_back(clean_string(text));
  return true;
}

bool parse_rope(const proto::WireRope& wire, RopeShape& out) {
  const auto numbers = proto::elements(wire.p_W);
  if (numbers.size() % 3 != 0 || numbers.size() > 3 * kMaxRopePoints) return false;
  if (!std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); })) return false;
  if (!(wire.diameter_m > 0 && wire.diameter_m < 10)) return false;
  out.diameter_m = wire.diameter_m;
  out.points_W.resize(numbers.size() / 3);
  for (std::size_t i = 0; i < out.points_W.size(); ++i)
    out.points_W[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  return true;
}

/// Parses each element; false where there are too many, or one is invalid.
template <class Sequence, class Out, class Parse>
bool parse_each(const Sequence& wire, std::size_t most, std::vector<Out>& out, Parse&& parse_one) {
  const auto items = proto::elements(wire);
  if (items.size() > most) return false;
  out.clear();
  out.resize(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!parse_one(items[i], out[i])) return false;
  }
  return true;
}

bool parse_answer(const proto::WireAnswer& wire, Question::Answer& out) {
  out.name = clean_string(wire.name);
  return parse_texts(wire.text, out.text);
}

bool parse_question(const proto::WireQuestion& wire, Question& out) {
  if (wire.kind > mechane_question_scale || wire.marks > 100) return false;
  out.name = clean_string(wire.name);
  out.kind = wire.kind == mechane_question_scale ? Question::Kind::scale : Question::Kind::choice;
  out.marks = wire.marks;
  return parse_texts(wire.text, out.text) && parse_texts(wire.low, out.low) && parse_texts(wire.high, out.high) &&
         parse_each(wire.answers, mechane_kMaxPresented, out.answers, parse_answer);
}

bool parse_activity(const proto::WireActivity& wire, Activity& out) {
  out.name = clean_string(wire.name);
  return parse_texts(wire.title, out.title) && parse_texts(wire.goal, out.goal) &&
         parse_each(wire.questions, mechane_kMaxPresented, out.questions, parse_question);
}

bool parse_view(const proto::WireView& wire, View& out) {
  out.name = clean_string(wire.name);
  out.field_of_view_rad = wire.field_of_view_rad;
  return parse_pose(wire.X_WV, out.X_WV) && wire.field_of_view_rad > 0 && wire.field_of_view_rad < 3.14f;
}

bool parse_effect(const proto::WireEffect& wire, Effect& out) {
  for (const float v : {wire.full, wire.size_m, wire.speed_m_per_s}) {
    if (!std::isfinite(v)) return false;
  }
  if (!proto::all_finite(wire.p_BE) || !proto::all_finite(wire.direction_B) || wire.full <= 0) return false;
  out.name = clean_string(wire.name);
  out.kind = clean_string(wire.kind);
  if (wire.object >= 0) out.object = static_cast<std::uint32_t>(wire.object);
  out.node = clean_string(wire.node);
  out.p_BE = proto::to_vec3(wire.p_BE);
  out.direction_B = proto::to_vec3(wire.direction_B);
  out.quantity = wire.quantity;
  out.full = wire.full;
  out.size_m = wire.size_m;
  out.speed_m_per_s = wire.speed_m_per_s;
  const double length = out.direction_B.norm();
  return length > 0.99 && length < 1.01;
}

bool parse_affordance(const proto::WireAffordance& wire, Affordance& out) {
  if (wire.kind > mechane_affordance_brought || wire.object >= kMaxObjects) return false;
  if (wire.base >= static_cast<std::int32_t>(kMaxObjects)) return false;
  out.kind = static_cast<Affordance::Kind>(wire.kind);
  out.agent = clean_string(wire.agent);
  out.object = wire.object;
  if (wire.base >= 0) out.base = static_cast<std::uint32_t>(wire.base);
  return parse_pose(wire.X_AJ, out.X_AJ) && parse_pose(wire.X_BJ, out.X_BJ);
}

}  // namespace

bool parse(const proto::HapticOutput& wire, ForceSample& out) noexcept {
  if (wire.protocol != proto::kProtocol || wire.contact_count > kMaxLocalContacts) return false;
  if (!(proto::all_finite(wire.f_W) && proto::all_finite(wire.t_W) && proto::all_finite(wire.finger_force_n) &&
        std::isfinite(wire.click_n)))
    return false;
  out.sequence = wire.seq;
  out.echo_sequence = wire.echo_seq;
  out.echo_sent_ns = wire.echo_sent_ns;
  out.waited = std::chrono::microseconds(wire.waited_us);
  out.force_W = {proto::to_vec3(wire.f_W), proto::to_vec3(wire.t_W)};
  std::copy(std::begin(wire.finger_force_n), std::end(wire.finger_force_n), out.finger_force_n.begin());
  out.contact_count = wire.contact_count;
  for (std::size_t i = 0; i < kMaxLocalContacts; ++i) {
    out.contacts[i] = LocalContact{};
    if (i < wire.contact_count && !parse_contact(wire.contacts[i], out.contacts[i])) return false;
  }
  out.clicks = {wire.clicks, std::clamp<double>(wire.click_n, 0, hand::kMaxClick_n)};
  out.reasons = wire.reasons;
  out.holding = wire.holding != 0;
  out.held = HeldPath{};
  return !out.holding || parse_held(wire.held, out.held);
}

bool parse(const proto::SceneFrame& wire, Frame& out) {
  const auto bodies = proto::elements(wire.bodies);
  const auto visible = proto::elements(wire.visible);
  const auto quantities = proto::elements(wire.quantities);
  const auto hands = proto::elements(wire.hands);
  if (wire.protocol != proto::kProtocol || bodies.size() > kMaxObjects || visible.size() > kMaxObjects ||
      quantities.size() > kMaxQuantities || hands.size() > kMaxHands) {
    return false;
  }
  out.sequence = wire.seq;
  out.tick = wire.tick;
  out.bodies.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].object >= visible.size() || !parse_pose(bodies[i].X_WB, out.bodies[i].X_WB)) return false;
    out.bodies[i].object = bodies[i].object;
  }
  out.visible.assign(visible.begin(), visible.end());
  out.quantities.assign(quantities.begin(), quantities.end());
  if (!std::all_of(quantities.begin(), quantities.end(), [](double q) { return std::isfinite(q); })) return false;
  out.hands.resize(hands.size());
  for (std::size_t i = 0; i < hands.size(); ++i) {
    if (!parse_hand(hands[i], out.hands[i])) return false;
  }
  return parse_each(wire.ropes, kMaxRopes, out.ropes, parse_rope);
}

bool parse(const proto::SceneObject& wire, SceneObject& out) {
  if (wire.protocol != proto::kProtocol || wire.object >= kMaxObjects || !parse_pose(wire.X_WB, out.X_WB)) return false;
  out.index = wire.object;
  out.name = clean_string(wire.name);
  out.mesh_uri = clean_string(wire.mesh_uri);
  out.mesh_hash = clean_string(wire.mesh_hash);
  out.mesh_node = clean_string(wire.mesh_node);
  out.parent = clean_string(wire.parent);
  out.movable = wire.movable;
  return parse_texts(wire.title, out.title);
}

bool parse(const proto::WorldStatus& wire, WorldStatus& out) {
  const auto quantities = proto::elements(wire.quantities);
  if (wire.protocol != proto::kProtocol || quantities.size() > kMaxQuantities) return false;
  out.world = clean(wire.world);
  out.scenario = clean_string(wire.scenario);
  out.scenario_hash = clean_string(wire.scenario_hash);
  out.scenario_folder = clean_string(wire.scenario_folder);
  out.activity = clean_string(wire.activity);
  out.step = clean_string(wire.step);
  out.steps_done = wire.steps_done;
  out.steps_total = wire.steps_total;
  out.done = wire.done;
  out.hint = wire.hint;
  out.detail = clean_string(wire.detail);
  out.quantities.clear();
  for (const proto::WireQuantity& q : quantities) {
    if (!parse_quantity(q, out.quantities.emplace_back())) return false;
  }
  const auto goals = proto::elements(wire.goals);
  if (goals.size() > quantities.size()) return false;
  for (const proto::WireQuantityGoal& goal : goals) {
    if (goal.quantity >= out.quantities.size() || !std::isfinite(goal.value)) return false;
    out.quantities[goal.quantity].goal = {goal.value, goal.from_above};
  }
  return parse_strings(wire.enabled_agents, out.enabled_agents) && parse_texts(wire.title, out.title) &&
         parse_texts(wire.caption, out.caption) && parse_texts(wire.hint_text, out.hint_text) &&
         parse_strings(wire.activities, out.activities) && parse_texts(wire.narration, out.narration) &&
         parse_texts(wire.audio, out.audio);
}

bool parse(const proto::WorldPresentation& wire, WorldPresentation& out) {
  if (wire.protocol != proto::kProtocol) return false;
  out.world = clean(wire.world);
  return parse_strings(wire.languages, out.languages) &&
         parse_each(wire.activities, mechane_kMaxPresented, out.activities, parse_activity) &&
         parse_each(wire.views, mechane_kMaxPresented, out.views, parse_view) &&
         parse_each(wire.effects, mechane_kMaxPresented, out.effects, parse_effect) &&
         parse_each(wire.affordances, mechane_kMaxAffordances, out.affordances, parse_affordance);
}

bool parse(const proto::Event& wire, WorldEvent& out) {
  if (wire.protocol != proto::kProtocol || !std::isfinite(wire.value)) return false;
  out.tick = wire.tick;
  out.kind = clean(wire.kind);
  out.subject = clean_string(wire.subject);
  out.object = clean_string(wire.object);
  out.value = wire.value;
  return true;
}

bool parse(const proto::ServerStatus& wire, ServerStatus& out) {
  if (wire.protocol != proto::kProtocol) return false;
  for (const float v : {wire.tick_us_median, wire.tick_us_p99, wire.tick_us_p999, wire.tick_us_max, wire.wake_us_p99,
                        wire.wake_us_max, wire.input_gap_ms}) {
    if (!std::isfinite(v)) return false;
  }
  out.server = clean(wire.server);
  out.version = clean_string(wire.version);
  out.worlds = wire.worlds;
  out.worlds_limit = wire.worlds_limit;
  out.users = wire.users;
  out.ticks = wire.ticks;
  out.overruns = wire.overruns;
  out.late_wakeups = wire.late_wakeups;
  out.preemptions = wire.preemptions;
  out.tick_us_median = wire.tick_us_median;
  out.tick_us_p99 = wire.tick_us_p99;
  out.tick_us_p999 = wire.tick_us_p999;
  out.tick_us_max = wire.tick_us_max;
  out.wake_us_p99 = wire.wake_us_p99;
  out.wake_us_max = wire.wake_us_max;
  out.realtime = wire.realtime;
  out.records_ok = wire.records_ok;
  out.input_gaps = wire.input_gaps;
  out.input_gap_ms = wire.input_gap_ms;
  out.overload = clean_string(wire.overload);
  return parse_strings(wire.scenarios, out.scenarios);
}

bool parse(const proto::WorldAssignment& wire, Assignment& out) {
  if (wire.protocol != proto::kProtocol) return false;
  out.server = clean(wire.server);
  out.incarnation = wire.incarnation;
  out.epoch = wire.epoch;
  out.world = clean(wire.world);
  if (!out.world.empty() && !proto::is_name(out.world)) return false;
  out.trouble = clean_string(wire.trouble);
  out.no_room = clean_string(wire.no_room);
  for (std::size_t i = 0; i < out.owners.size(); ++i) {
    out.owners[i] = {wire.owners[i].session, clean(wire.owners[i].program), clean(wire.owners[i].host)};
  }
  return true;
}

std::string other_protocol(const proto::ServerStatus& wire) {
  if (wire.protocol == proto::kProtocol) return {};
  return fmt::format(
      "server {} on {} is Mechane {}, which speaks protocol {}; this program speaks protocol {}: install the same "
      "version of Mechane on both machines",
      clean(wire.server), clean_string(wire.host), clean_string(wire.version), wire.protocol, proto::kProtocol);
}

}  // namespace mechane::client
