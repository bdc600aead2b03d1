#include "server/haptics/render_forces.hpp"

#include <algorithm>
#include <cmath>

#include "server/haptics/contact_patch.hpp"
#include "server/haptics/effective_mass.hpp"

namespace mechane::haptics {
namespace {

using hand::HandKind;
using hand::HapticOutput;
using state::BodyState;
using state::HapticMaterial;
using state::UserState;

// An explicit spring or damper must stay well below what would reverse the body's motion within one step, or it would oscillate.
constexpr double kStiffnessBound = 0.1;
constexpr double kDampingBound = 0.3;

/// What one touch does: the force on the hand, and the spring it was made with.
struct PatchForce {
  Vec3 f_H_W = Vec3::Zero();
  double stiffness_n_per_m = 0;
  double damping_ns_per_m = 0;
};

Vec3 friction_force(const Vec3& v_tangent, double normal_force_n, const HapticMaterial& material, double speed_limit) {
  const double speed = v_tangent.norm();
  if (speed <= 0 || normal_force_n <= 0) return Vec3::Zero();
  const double mu = speed < speed_limit ? material.static_friction : material.dynamic_friction;
  return -mu * normal_force_n / std::max(speed, speed_limit) * v_tangent;
}

/// Spring, damping on the way in, friction. Continuous in depth and speed but for the fall from static to dynamic friction.
PatchForce touch_force(const ContactPatch& patch, const HapticMaterial& material, const ForceConfig& config,
                       double m_eff_kg, const Vec3& v_rel_W) {
  PatchForce out;
  const double k_bound = kStiffnessBound * m_eff_kg / (kTickSeconds * kTickSeconds);
  const double b_bound = kDampingBound * m_eff_kg / kTickSeconds;
  out.stiffness_n_per_m = std::min(material.stiffness_n_per_m, k_bound);
  out.damping_ns_per_m = std::min(material.damping_ns_per_m, b_bound);
  const double approach = std::max(0.0, -v_rel_W.dot(patch.n_BH_W));
  const double onset = std::min(1.0, patch.depth_m / config.damping_depth_m);
  const double normal_n = out.stiffness_n_per_m * patch.depth_m + onset * out.damping_ns_per_m * approach;
  const Vec3 v_tangent = v_rel_W - v_rel_W.dot(patch.n_BH_W) * patch.n_BH_W;
  out.f_H_W = normal_n * patch.n_BH_W + friction_force(v_tangent, normal_n, material, config.friction_speed_m_per_s);
  return out;
}

void add_to_hand(UserState& user, const Vec3& f_H_W, const Vec3& p_WC) {
  user.output.force_W.f += f_H_W;
  user.output.force_W.t += (p_WC - user.X_WH.p).cross(f_H_W);
}

/// Equation 19: what a glove that only pulls can show of a force on a phalanx.
void add_to_finger(UserState& user, std::size_t segment, const Vec3& f_H_W) {
  if (user.sample.kind != HandKind::glove || segment == 0) return;
  const double pull_n = f_H_W.dot(HandModel::finger_normal_W(user.X_WS[segment]));
  user.output.finger_force_n[hand::finger_of(segment)] += std::max(0.0, pull_n);
}

void add_local_contact(UserState& user, const ContactPatch& patch, const PatchForce& force, const Vec3& v_B_W,
                       const HapticMaterial& material) {
  HapticOutput& out = user.output;
  std::size_t slot = out.contact_count;
  if (slot == out.contacts.size()) {
    const auto shallowest = std::min_element(out.contacts.begin(), out.contacts.end(),
                                             [](const auto& a, const auto& b) { return a.depth_m < b.depth_m; });
    if (shallowest->depth_m >= patch.depth_m) return;
    slot = static_cast<std::size_t>(shallowest - out.contacts.begin());
  } else {
    ++out.contact_count;
  }
  hand::LocalContact& contact = out.contacts[slot];
  contact.p_W = patch.p_WC;
  contact.n_W = patch.n_BH_W;
  contact.v_W = v_B_W;
  contact.depth_m = patch.depth_m;
  contact.curvature_per_m = 0;
  contact.stiffness_n_per_m = force.stiffness_n_per_m;
  contact.damping_ns_per_m = force.damping_ns_per_m;
  contact.friction = material.dynamic_friction;
}

/// The product's mode: each touch on its own, summed at the wrist.
void render_patches(const state::WorldDescription& description, state::WorldState& state, UserState& user,
                    const ForceConfig& config) {
  std::array<ContactPatch, kMaxPatches> patches;
  const std::size_t count = gather_patches(user.contact_span(), patches);
  for (std::size_t i = 0; i < count; ++i) {
    const ContactPatch& patch = patches[i];
    if (patch.depth_m <= 0) continue;
    BodyState& body = state[patch.body];
    const HapticMaterial& material = description.bodies[patch.body.index()].haptic;
    const Vec3 v_B_W = body.V_WB.at(patch.p_WC - body.X_WB.p);
    const Vec3 v_rel_W = user.V_WH.at(patch.p_WC - user.X_WH.p) - v_B_W;
    const double m_eff = effective_mass_kg(description, state, patch.body, patch.p_WC, patch.n_BH_W);
    const PatchForce force = touch_force(patch, material, config, m_eff, v_rel_W);
    add_to_finger(user, patch.segment, force.f_H_W);
    // A hand feels what it holds through the grasp's spring; only its fingers feel the surface.
    if (user.grasp.active && user.grasp.body == patch.body) continue;
    add_to_hand(user, force.f_H_W, patch.p_WC);
    add_local_contact(user, patch, force, v_B_W, material);
    add_force(body, -user.freshness * force.f_H_W, patch.p_WC);
  }
}

/// Equation 18 as published. It is kept to show its flaws: a point that enters with no depth halves the
/// force, and one average over the whole hand cancels a pinch.
void render_paper(const state::WorldDescription& description, state::WorldState& state, UserState& user) {
  if (user.contact_count == 0) return;
  const double n = user.contact_count;
  for (const state::Contact& contact : user.contact_span()) {
    if (user.grasp.active && user.grasp.body == contact.body) continue;
    const double k = description.bodies[contact.body.index()].haptic.stiffness_n_per_m;
    const Vec3 f_H_W = k / n * contact.depth_m * contact.n_BH_W;
    add_to_hand(user, f_H_W, contact.p_WC);
    add_to_finger(user, contact.segment, f_H_W);
    add_force(state[contact.body], -user.freshness * f_H_W, contact.p_WC);
  }
}

/// The constraint's reaction, as dynamics found it in the last tick.
void render_grasp(const state::WorldState& state, UserState& user) {
  user.output.holding = user.grasp.active;
  if (!user.grasp.active) return;
  const Vec3 p_WG = state[user.grasp.body].X_WB * user.grasp.p_BG;
  add_to_hand(user, user.grasp.reaction_W.f, p_WG);
  user.output.force_W.t += user.grasp.reaction_W.t;
}

}  // namespace

Expected<ForceRenderer> ForceRenderer::create(const ForceConfig& config) {
  auto governor = hand::ForceGovernor::make(config.governor);
  if (!governor) return tl::unexpected(governor.error());
  return ForceRenderer(config, *governor);
}

void ForceRenderer::start(state::WorldState& state) const noexcept {
  state.governors.fill(governor_.start());
}

void ForceRenderer::run(const state::WorldDescription& description, state::WorldState& state) const noexcept {
  for (std::size_t i = 0; i < state.users.size(); ++i)
    render_user(description, state, i);
}

void ForceRenderer::render_user(const state::WorldDescription& description, state::WorldState& state,
                                std::size_t index) const noexcept {
  UserState& user = state.users[index];
  const std::uint64_t echo_sequence = user.sample.sequence;
  const std::uint64_t echo_sent_ns = user.sample.sent_ns;
  user.output = HapticOutput{};
  user.output.echo_sequence = echo_sequence;
  user.output.echo_sent_ns = echo_sent_ns;
  if (user.present) {
    if (config_.mode == ForceMode::paper) {
      render_paper(description, state, user);
    } else {
      render_patches(description, state, user, config_);
    }
    render_grasp(state, user);
    if (user.freshness <= 0) user.output.contact_count = 0;  // where the hand is now, nobody here knows
  }
  hand::GovernorState& governor = state.governors[index];
  if (user.jumped) governor_.reset(governor);
  hand::GovernorInput input;
  input.wanted_W = user.output.force_W;
  input.finger_force_n = user.output.finger_force_n;
  input.V_WH = user.V_WH;
  input.age = user.age;
  input.engaged = user.present;
  static_cast<hand::HandForce&>(user.output) = governor_.apply(governor, input, kTickPeriod);
}

}  // namespace mechane::haptics
