#include "server/haptics/render_forces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "server/hand/held_path.hpp"
#include "server/haptics/clicks.hpp"
#include "server/haptics/contact_patch.hpp"
#include "server/haptics/effective_mass.hpp"
#include "server/haptics/friction.hpp"
#include "server/haptics/held_path.hpp"
#include "server/haptics/keep_deepest.hpp"
#include "server/haptics/smooth_normal.hpp"
#include "server/haptics/wall_sides.hpp"

namespace mechane::haptics {
namespace {

using hand::HandKind;
using hand::HapticOutput;
using state::BodyState;
using state::HapticMaterial;
using state::UserState;

/// What one touch does: the force on the hand, and the spring it was made with.
struct PatchForce {
  Vec3 f_H_W = Vec3::Zero();
  Spring spring;
  double knock_n = 0;  ///< the click of a first touch
};

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

/// The grooves of a body as a segment of the hand meets them. The phase is taken where the segment's own frame is, for the middle of a
/// touch jumps from point to point.
hand::Grooves grooves_at(const HapticMaterial& material, const Pose& X_WB, const Vec3& p_WS, const state::Contact& at) {
  if (material.groove_depth_m <= 0) return {};
  const Vec3 p_BS = X_WB.inverse() * Vec3(p_WS + at.depth_m * at.n_BH_W);
  return {material.groove_depth_m, hand::along_surface(X_WB.rotate(material.groove_wave_B), at.n_BH_W),
          material.groove_wave_B.dot(p_BS)};
}

void add_local_contact(HapticOutput& out, const state::Contact& at, double curvature_per_m, const Vec3& v_B_W,
                       const Spring& spring, const HapticMaterial& material, const hand::Grooves& grooves) {
  const hand::LocalContact contact{.p_W = at.p_WC,
                                   .n_W = at.n_BH_W,
                                   .v_W = v_B_W,
                                   .depth_m = at.depth_m,
                                   .curvature_per_m = curvature_per_m,
                                   .stiffness_n_per_m = spring.stiffness_n_per_m,
                                   .damping_ns_per_m = spring.damping_ns_per_m,
                                   .static_friction = material.static_friction,
                                   .dynamic_friction = material.dynamic_friction,
                                   .viscosity_ns_per_m = spring.viscosity_ns_per_m,
                                   .grooves = grooves};
  KeepDeepest(out.contacts, out.contact_count).add(contact);
}

/// The middle of a ball that moves over a surface keeps to a second surface, one radius farther out: the curvature of that one. A hollow
/// narrower than two radii counts as that wide.
double curvature_under_ball_per_m(double curvature_per_m, double radius_m) {
  const double under = std::max(curvature_per_m, -0.5 / radius_m);
  return under / (1 + under * radius_m);
}

/// Gives a tip's touch, or a surface near it, the normal that a soft finger feels, and returns how the surface is curved for the segment's
/// middle. The other segments are larger, and cover facets by themselves. `p_WS`, `depth_m`: where the segment's middle was when the touch
/// was found, and how deep it was there.
double smooth_at(const state::WorldDescription& description, const HandModel& hand, const state::WorldState& state,
                 const UserState& user, state::Contact& at, const ForceConfig& config, const Vec3& p_WS,
                 double depth_m) {
  const collision::Object* const object = description.bodies[at.body.index()].object.get();
  const bool stylus = user.sample.kind == HandKind::one_point;
  const bool tip = stylus || hand::is_fingertip(at.segment);
  if (config.normals == NormalKind::of_contacts || object == nullptr || !tip) return 0;
  const BodyState& body = state[at.body];
  const Pose& X_WB = body.X_WB;
  const Pose X_BW = X_WB.inverse();
  Touch touch{
      .p_B = X_BW * at.p_WC, .n_B = X_BW.rotate(at.n_BH_W), .thin_walls = config.thin_walls != ThinWalls::let_through};
  touch.v_B = X_BW.rotate(user.V_WH.at(at.p_WC - user.X_WH.p) - body.V_WB.at(at.p_WC - X_WB.p));
  const double radius_m = hand.inner_radius_m(user.sample, at.segment);
  if (stylus) {  // under a ball, the surface lies in the direction of its normal
    touch.p_B = X_BW * p_WS;
    touch.surface_m = radius_m - depth_m;
    touch.rounds = 2;
  }
  const SmoothSurface smooth = smooth_surface(hand.pad(), *object, touch);
  at.n_BH_W = X_WB.rotate(smooth.n_B);
  return curvature_under_ball_per_m(smooth.curvature_per_m, radius_m);
}

/// One touch of the product's mode, of so many. Moves its anchor.
PatchForce touch_force(const state::WorldDescription& description, const state::WorldState& state,
                       const UserState& user, const ContactPatch& patch, const Vec3& v_B_W,
                       const hand::Grooves& grooves, double touches, const ForceConfig& config,
                       FrictionAnchors& anchors) {
  const HapticMaterial& material = state[patch.body].haptic;
  const Pose& X_WB = state[patch.body].X_WB;
  const auto spring_along = [&](const Vec3& direction_W) {
    return bounded_spring(material, effective_mass_kg(description, state, patch.body, patch.p_WC, direction_W));
  };
  const Vec3 v_rel_W = user.V_WH.at(patch.p_WC - user.X_WH.p) - v_B_W;
  const Spring spring = spring_along(patch.n_BH_W);
  hand::Resistance resistance{spring.stiffness_n_per_m, spring.damping_ns_per_m, 0, config.damping_depth_m};
  const Vec3 sliding_W = hand::along_surface(v_rel_W, patch.n_BH_W);
  if (material.viscosity_ns_per_m > 0 && !sliding_W.isZero(0))
    resistance.viscosity_ns_per_m = spring_along(sliding_W.normalized()).viscosity_ns_per_m / touches;
  const hand::GroovedTouch on_grooves = hand::grooved(patch.depth_m, grooves, grooves.phase_rad, kPatchShare);
  const hand::SurfaceForce surface = hand::surface_force(on_grooves, patch.n_BH_W, v_rel_W, resistance);
  const Rubbing rubbing{patch.n_BH_W, surface.normal_n, v_rel_W, material};
  PatchForce force{surface.f_W, spring};
  if (config.friction == FrictionKind::damps) {
    force.f_H_W += damping_friction(rubbing);
    return force;
  }
  const std::optional<Stretch> before = anchors.stretch_of(patch, X_WB);
  if (!before && !user.jumped) force.knock_n = material.knock_ns_per_m * -v_rel_W.dot(patch.n_BH_W);
  Stretch stretch = before.value_or(Stretch{});
  const Vec3 pull_W = stretch.s_W + kTickSeconds * sliding_W;
  if (!pull_W.isZero(0)) force.f_H_W += sticking_friction(rubbing, spring_along(pull_W.normalized()), stretch);
  anchors.keep(patch, X_WB, stretch);
  return force;
}

/// The product's mode: each touch on its own, summed at the wrist.
void render_patches(const state::WorldDescription& description, const HandModel& hand, state::WorldState& state,
                    UserState& user, const ForceConfig& config) {
  ContactPatches patches;
  gather_patches(user.contact_span(), patches);
  if (config.thin_walls != ThinWalls::let_through)
    hold_walls(description, hand, state, user, config.thin_walls, patches);
  FrictionAnchors anchors(user);
  for (ContactPatch& patch : patches) {
    if (patch.depth_m <= 0) continue;
    state::Contact touch{patch.body, patch.segment, patch.p_WC, patch.n_BH_W, patch.depth_m};
    double curvature_per_m = 0;
    if (!patch.in_corner) {
      curvature_per_m = smooth_at(description, hand, state, user, touch, config,
                                  user.X_WS[patch.segment].p + patch.out_W, patch.found_depth_m);
      patch.n_BH_W = touch.n_BH_W;
    }
    BodyState& body = state[patch.body];
    const Vec3 v_B_W = body.V_WB.at(patch.p_WC - body.X_WB.p);
    const HapticMaterial& material = body.haptic;
    const hand::Grooves grooves = grooves_at(material, body.X_WB, user.X_WS[patch.segment].p, touch);
    const PatchForce force = touch_force(description, state, user, patch, v_B_W, grooves,
                                         static_cast<double>(patches.size()), config, anchors);
    add_to_finger(user, patch.segment, force.f_H_W);
    if (force.knock_n > 0) add_click(user, state.tick, force.knock_n);
    // A hand feels what it holds through the grasp's spring; only its fingers feel the surface.
    if (user.holds(patch.body)) continue;
    add_to_hand(user, force.f_H_W, patch.p_WC);
    add_local_contact(user.output, touch, curvature_per_m, v_B_W, force.spring, material, grooves);
    add_force(body, -user.freshness * force.f_H_W, patch.p_WC);
  }
}

/// What a client may render by itself when the hand comes to these surfaces before we see it.
void announce_near(const state::WorldDescription& description, const HandModel& hand, const state::WorldState& state,
                   UserState& user, const ForceConfig& config) {
  for (state::Contact near : user.near_span()) {
    if (user.holds(near.body)) continue;
    if (has_side(user, near.segment, near.body)) continue;  // behind a wall, it is the wrong one
    const double curvature_per_m =
        smooth_at(description, hand, state, user, near, config, user.X_WS[near.segment].p, near.depth_m);
    const BodyState& body = state[near.body];
    const HapticMaterial& material = body.haptic;
    Spring spring = bounded_spring(material, effective_mass_kg(description, state, near.body, near.p_WC, near.n_BH_W));
    spring.stiffness_n_per_m *= kPatchShare;
    add_local_contact(user.output, near, curvature_per_m, body.V_WB.at(near.p_WC - body.X_WB.p), spring, material,
                      grooves_at(material, body.X_WB, user.X_WS[near.segment].p, near));
  }
}

/// Equation 18 as published. It is kept to show its flaws: a point that enters with no depth halves the
/// force, and one average over the whole hand cancels a pinch.
void render_paper(state::WorldState& state, UserState& user) {
  user.anchor_count = 0;
  if (user.contact_count == 0) return;
  const double n = user.contact_count;
  for (const state::Contact& contact : user.contact_span()) {
    if (user.holds(contact.body)) continue;
    const double k = state[contact.body].haptic.stiffness_n_per_m;
    const Vec3 f_H_W = k / n * contact.depth_m * contact.n_BH_W;
    add_to_hand(user, f_H_W, contact.p_WC);
    add_to_finger(user, contact.segment, f_H_W);
    add_force(state[contact.body], -user.freshness * f_H_W, contact.p_WC);
  }
}

/// The constraint's reaction, as dynamics found it in the last tick.
void render_grasp(const state::WorldDescription& description, const state::WorldState& state, UserState& user) {
  user.output.holding = user.grasp.active;
  if (!user.grasp.active) return;
  user.output.held = held_path(description, state, user);
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

void ForceRenderer::run(const state::WorldDescription& description, const HandModel& hand,
                        state::WorldState& state) const noexcept {
  for (std::size_t i = 0; i < state.users.size(); ++i)
    render_user(description, hand, state, i);
  find_clicks(description, state);
  for (UserState& user : state.users)
    user.output.clicks = user.clicks;
}

void ForceRenderer::render_user(const state::WorldDescription& description, const HandModel& hand,
                                state::WorldState& state, std::size_t index) const noexcept {
  UserState& user = state.users[index];
  const std::uint64_t echo_sequence = user.sample.sequence;
  const std::uint64_t echo_sent_ns = user.sample.sent_ns;
  user.output = HapticOutput{};
  user.output.echo_sequence = echo_sequence;
  user.output.echo_sent_ns = echo_sent_ns;
  if (user.present) {
    if (config_.mode == ForceMode::paper) {
      render_paper(state, user);
    } else {
      render_patches(description, hand, state, user, config_);
      announce_near(description, hand, state, user, config_);
    }
    render_grasp(description, state, user);
    if (user.freshness <= 0) {  // where the hand is now, nobody here knows
      user.output.contact_count = 0;
      user.output.held = {};
    }
  }
  hand::GovernorState& governor = state.governors[index];
  if (user.jumped) governor_.reset(governor);
  hand::GovernorInput input;
  input.wanted_W = user.output.force_W;
  input.finger_force_n = user.output.finger_force_n;
  input.V_WH = user.V_WH;
  input.age = user.age;
  if (config_.weights) input.weight_W = hand::held_weight(user.output.held, user.X_WH, user.age);
  input.engaged = user.present;
  static_cast<hand::HandForce&>(user.output) = governor_.apply(governor, input, kTickPeriod);
}

}  // namespace mechane::haptics
