// X3D's sensors of bodies and hands, and the bodies that events move.
#include <algorithm>
#include <array>

#include "server/agents/event_node.hpp"
#include "server/collision/object.hpp"

namespace mechane::agents {
namespace {

/// Whether any two of its collider's bodies touch. It asks the collision maps itself, because what the solver found is the solver's.
class CollisionSensor final : public EventNode {
 public:
  CollisionSensor(const EventBuild& build, const state::WorldDescription& description)
      : enabled_(build.port("enabled")),
        active_(build.port("isActive")),
        pairs_(build.node.pairs),
        description_(description) {}

  void begin(Instant& i) const noexcept override {
    const bool now = i.flag(enabled_) && std::ranges::any_of(pairs_, [&](const auto& pair) {
                       return touch(i.state, pair.first, pair.second);
                     });
    if (now != i.flag(active_)) i.send(active_, now ? 1.0 : 0.0);
  }

 private:
  [[nodiscard]] bool touch(const state::WorldState& state, BodyId a, BodyId b) const noexcept {
    std::array<collision::PointContact, 1> found;
    collision::ContactBuffer contacts(found);
    collision::find_contacts(*description_.bodies[a.index()].object, state[a].X_WB,
                             *description_.bodies[b.index()].object, state[b].X_WB, contacts);
    return !contacts.contacts().empty();
  }

  Port enabled_, active_;
  std::span<const std::pair<BodyId, BodyId>> pairs_;  // of the description
  const state::WorldDescription& description_;
};

/// Whether a hand is in a box. X3D asks for the viewer; what comes near an exhibit here is a hand.
class ProximitySensor final : public EventNode {
 public:
  explicit ProximitySensor(const EventBuild& build)
      : enabled_(build.port("enabled")),
        center_(build.port("center")),
        size_(build.port("size")),
        active_(build.port("isActive")),
        entered_(build.port("enterTime")),
        left_(build.port("exitTime")),
        position_(build.port("position_changed")),
        orientation_(build.port("orientation_changed")),
        X_PW_(build.node.X_WP.inverse()) {}

  void begin(Instant& i) const noexcept override {
    const auto hand = std::ranges::find_if(i.state.users, [&](const auto& user) { return has(i, user); });
    const bool now = hand != i.state.users.end();
    if (now != i.flag(active_)) {
      i.send(active_, now ? 1.0 : 0.0);
      i.send(now ? entered_ : left_, i.now_s);
    }
    if (!now) return;
    const Pose X_PH = X_PW_ * hand->X_WH;
    if (X_PH.p != i.vector(position_)) i.send(position_, X_PH.p);
    if (X_PH.R.coeffs() != i.rotation(orientation_).coeffs()) i.send(orientation_, X_PH.R);
  }

 private:
  [[nodiscard]] bool has(const Instant& i, const state::UserState& user) const noexcept {
    if (!i.flag(enabled_) || !user.present || user.stale) return false;
    const Vec3 half = 0.5 * i.vector(size_);
    const Vec3 from_center = X_PW_ * user.X_WH.p - i.vector(center_);
    return (half.array() > 0).all() && (from_center.array().abs() <= half.array()).all();
  }

  Port enabled_, center_, size_, active_, entered_, left_, position_, orientation_;
  Pose X_PW_;
};

/// A body's place: it tells of it, and goes where events put it.
class RigidBody final : public EventNode {
 public:
  explicit RigidBody(const EventBuild& build)
      : body_(build.node.body),
        position_(build.port("position")),
        orientation_(build.port("orientation")),
        velocity_(build.port("linearVelocity")),
        turning_(build.port("angularVelocity")) {}

  void begin(Instant& i) const noexcept override {
    const state::BodyState& body = i.state[body_];
    if (body.X_WB.p != i.vector(position_)) i.send(position_, body.X_WB.p);
    if (body.X_WB.R.coeffs() != i.rotation(orientation_).coeffs()) i.send(orientation_, body.X_WB.R);
    if (body.V_WB.v != i.vector(velocity_)) i.send(velocity_, body.V_WB.v);
    if (body.V_WB.w != i.vector(turning_)) i.send(turning_, body.V_WB.w);
  }

  // Not where a step has let the body go.
  [[nodiscard]] bool accepts(const Instant& i, Port /*port*/, const double* /*value*/) const noexcept override {
    return !i.state[body_].movable;
  }

  void end(Instant& i) const noexcept override {
    if (!i.had_event(position_) && !i.had_event(orientation_)) return;
    move(i.state[body_], {i.vector(position_), i.rotation(orientation_)}, i.dt_s);
  }

  /// Hands feel how fast a body comes. Dynamics stops it again.
  static void move(state::BodyState& body, const Pose& X_WB, double dt_s) noexcept {
    if (body.movable) return;
    body.V_WB = mean_twist(body.X_WB, X_WB, dt_s);
    body.X_WB = X_WB;
  }

 private:
  BodyId body_;
  Port position_, orientation_, velocity_, turning_;
};

/// A Transform whose shapes are a body.
class Transform final : public EventNode {
 public:
  explicit Transform(const EventBuild& build)
      : body_(build.node.body),
        X_WP_(build.node.X_WP),
        center_(build.node.center),
        first_(build.node.first_rotation),
        translation_(build.port("translation")),
        rotation_(build.port("rotation")) {}

  void end(Instant& i) const noexcept override {
    if (!i.had_event(translation_) && !i.had_event(rotation_)) return;
    // The mesh has its centre where the first rotation left it.
    const Quat R = i.rotation(rotation_);
    const Vec3 p = i.vector(translation_) + center_ - R * (first_.conjugate() * center_);
    RigidBody::move(i.state[body_], X_WP_ * Pose{p, R}, i.dt_s);
  }

 private:
  BodyId body_;
  Pose X_WP_;
  Vec3 center_;
  Quat first_;
  Port translation_, rotation_;
};

}  // namespace

std::unique_ptr<EventNode> make_collision_sensor(const EventBuild& build, const state::WorldDescription& description) {
  return std::make_unique<CollisionSensor>(build, description);
}
std::unique_ptr<EventNode> make_proximity_sensor(const EventBuild& build) {
  return std::make_unique<ProximitySensor>(build);
}
std::unique_ptr<EventNode> make_rigid_body(const EventBuild& build) {
  return std::make_unique<RigidBody>(build);
}
std::unique_ptr<EventNode> make_transform(const EventBuild& build) {
  return std::make_unique<Transform>(build);
}

}  // namespace mechane::agents
