// One walk over the fields of a world that the next tick depends on, used by the hash, the writer and the reader of snapshots:
// what is hashed is what is saved. Contacts, loads and events are made anew in each tick and are left out, and so are what bodies feel
// like and the pitch and cone of joints, which agents write in each tick. Clicks move nothing: a world that goes on begins to count them
// anew.
#pragma once

#include <type_traits>

#include "server/state/world_state.hpp"

namespace mechane::state {

/// `Archive` has `void bytes(T& plain)` for numbers and enumerations. `State` is WorldState or const WorldState.
template <class Archive, class State>
class StateWalk {
 public:
  StateWalk(Archive& archive, State& state, StateVersion version = kStateVersion)
      : archive_(archive), state_(state), version_(version) {}

  void run() {
    archive_.bytes(state_.tick);
    for (auto& body : state_.bodies)
      walk_body(body);
    for (auto& joint : state_.joints)
      walk_joint(joint);
    for (auto& value : state_.quantities)
      archive_.bytes(value);
    for (auto& enabled : state_.agent_enabled)
      archive_.bytes(enabled);
    for (auto& value : state_.memory)
      archive_.bytes(value);
    for (auto& user : state_.users)
      walk_user(user);
    walk_progress(state_.progress);
    // After what is older, so that a world without couplings has the bytes that it had before there were any.
    for (auto& coupling : state_.couplings)
      walk_coupling(coupling);
    if (version_ == StateVersion::without_governors) return;
    for (auto& user : state_.users)
      archive_.bytes(user.age);
    for (auto& governor : state_.governors)
      walk_governor(governor);
    if (version_ == StateVersion::with_governors) return;
    for (auto& user : state_.users)
      walk_anchors(user);
    if (version_ == StateVersion::with_anchors) return;
    for (auto& user : state_.users)
      walk_sides(user);
    if (version_ == StateVersion::with_sides) return;
    for (auto& user : state_.users) {
      archive_.bytes(user.sample.side);
      for (auto& scale : user.sample.finger_scale)
        archive_.bytes(scale);
    }
    if (version_ == StateVersion::with_builds) return;
    for (auto& governor : state_.governors)
      archive_.bytes(governor.lifted_j);
    if (version_ < StateVersion::with_gravity) return;
    // Of other bodies the description says it, so that a world in which no step changes it has the bytes that it had before.
    for (const BodyId body : state_.weighed)
      archive_.bytes(state_[body].use_gravity);
  }

 private:
  template <class V>
  void vector(V& v) {
    for (int i = 0; i < 3; ++i)
      archive_.bytes(v.coeffRef(i));
  }
  void vector(const Vec3& v) {
    for (int i = 0; i < 3; ++i)
      archive_.bytes(v[i]);
  }
  template <class P>
  void pose(P& X) {
    vector(X.p);
    for (int i = 0; i < 4; ++i)
      archive_.bytes(X.R.coeffs()[i]);
  }
  template <class T>
  void twist(T& V) {
    vector(V.v);
    vector(V.w);
  }
  template <class B>
  void walk_body(B& body) {
    pose(body.X_WB);
    twist(body.V_WB);
    archive_.bytes(body.movable);
    archive_.bytes(body.visible);
    archive_.bytes(body.graspable);
  }
  template <class J>
  void walk_joint(J& joint) {
    archive_.bytes(joint.enabled);
    archive_.bytes(joint.position);
    archive_.bytes(joint.velocity);
    archive_.bytes(joint.min_position);
    archive_.bytes(joint.max_position);
    archive_.bytes(joint.friction);
    archive_.bytes(joint.viscous);
  }
  template <class U>
  void walk_user(U& user) {
    archive_.bytes(user.present);
    archive_.bytes(user.stale);
    archive_.bytes(user.jumped);
    archive_.bytes(user.freshness);
    archive_.bytes(user.sample.session);
    archive_.bytes(user.sample.sequence);
    archive_.bytes(user.sample.kind);
    archive_.bytes(user.sample.grasp_intent);
    archive_.bytes(user.sample.hand_scale);
    for (auto& angle : user.sample.joints)
      archive_.bytes(angle);
    pose(user.X_WH);
    twist(user.V_WH);
    archive_.bytes(user.grasp.active);
    archive_.bytes(user.grasp.body);
    pose(user.grasp.X_HB);
    vector(user.grasp.p_BG);
    archive_.bytes(user.grasp.force_limit_n);
    archive_.bytes(user.grasp.torque_limit_nm);
    vector(user.grasp.reaction_W.f);
    vector(user.grasp.reaction_W.t);
    vector(user.output.force_W.f);
    vector(user.output.force_W.t);
  }
  /// Of a damaged file the count may be any number, here and below.
  template <class U>
  void walk_anchors(U& user) {
    archive_.bytes(user.anchor_count);
    for (std::size_t i = 0; i < user.anchor_count && i < user.anchors.size(); ++i) {
      auto& anchor = user.anchors[i];
      archive_.bytes(anchor.body);
      archive_.bytes(anchor.segment);
      archive_.bytes(anchor.slides);
      vector(anchor.p_SA);
      vector(anchor.p_BA);
    }
  }
  template <class U>
  void walk_sides(U& user) {
    archive_.bytes(user.side_count);
    for (std::size_t i = 0; i < user.side_count && i < user.sides.size(); ++i) {
      auto& side = user.sides[i];
      archive_.bytes(side.body);
      archive_.bytes(side.segment);
      vector(side.n_B);
      archive_.bytes(side.height_m);
    }
  }
  template <class G>
  void walk_governor(G& governor) {
    vector(governor.last.force_W.f);
    vector(governor.last.force_W.t);
    for (auto& force : governor.last.finger_force_n)
      archive_.bytes(force);
    archive_.bytes(governor.last.reasons);
    archive_.bytes(governor.ramp);
    archive_.bytes(governor.gain);
    archive_.bytes(governor.credit_j);
    for (auto& count : governor.counts)
      archive_.bytes(count);
  }
  template <class P>
  void walk_progress(P& progress) {
    archive_.bytes(progress.activity);
    archive_.bytes(progress.step);
    archive_.bytes(progress.done);
    archive_.bytes(progress.step_tick);
    archive_.bytes(progress.activity_tick);
    archive_.bytes(progress.steps_done);
    archive_.bytes(progress.hint_shown);
  }

  template <class C>
  void walk_coupling(C& coupling) {
    archive_.bytes(coupling.enabled);
    archive_.bytes(coupling.offset);
    pose(coupling.X_B1B2);
    archive_.bytes(coupling.force_n);
    archive_.bytes(coupling.torque_nm);
    archive_.bytes(coupling.end_force_n);
    archive_.bytes(coupling.length_m);
    archive_.bytes(coupling.slack_m);
  }

  Archive& archive_;
  State& state_;
  StateVersion version_;
};

}  // namespace mechane::state
