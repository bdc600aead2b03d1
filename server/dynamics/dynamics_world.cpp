#include "server/dynamics/dynamics_world.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "server/base/assert.hpp"
#include "server/dynamics/body_contacts.hpp"
#include "server/dynamics/bullet_math.hpp"
#include "server/dynamics/contact_solver.hpp"
#include "server/dynamics/coupling_rows.hpp"
#include "server/dynamics/grasp_rows.hpp"
#include "server/dynamics/joint_rows.hpp"
#include "server/dynamics/mechanism.hpp"

namespace mechane::dynamics {
namespace {

/// A body of ours and the same body in Bullet, which uses another frame. C is the centre of mass with the principal axes.
struct Body {
  btRigidBody bullet;
  Pose X_BC;
  Pose X_CB;
  Vec3 principal_kg_m2;  // simulated
  double mass_kg;        // simulated
  bool fixed;
  Wrench drive;       // simulated
  bool moves = true;  // whether Bullet has its mass now
  GripBody grip;

  Body(const state::BodyDescription& from, double mass, const Vec3& principal, const Pose& X_BC_in)
      : bullet(btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, nullptr, to_bt(principal))),
        X_BC(X_BC_in),
        X_CB(X_BC_in.inverse()),
        principal_kg_m2(principal),
        mass_kg(mass),
        fixed(from.fixed),
        drive{from.effort_scale * from.drive.f, from.effort_scale * from.drive.t},
        grip(grip_body(from)) {
    bullet.setDamping(from.linear_damping, from.angular_damping);
  }
};

/// Rows in the mechanism.
struct Placed {
  RowSet rows;
  std::size_t first = 0;
};

std::string place_of(const state::BodyDescription& body) {
  return "body " + body.name;
}

Expected<std::unique_ptr<Body>> make_body(const state::BodyDescription& from) {
  if (from.fixed) return std::make_unique<Body>(from, 0.0, Vec3::Zero(), Pose{});
  const double mass = from.mass_kg * from.effort_scale;
  if (!std::isfinite(mass) || mass <= 0 || from.mass_kg <= 0)
    return fail(ErrorCode::invalid_value, "the mass (times effort_scale) is not positive", place_of(from),
                "give a mass above 0 kg, or fixed='true'");
  if (!from.inertia_kg_m2.allFinite() || !from.p_BCm.allFinite())
    return fail(ErrorCode::invalid_value, "the inertia or the centre of mass is not finite", place_of(from),
                "give finite numbers");
  const Mat3 symmetric = 0.5 * (from.inertia_kg_m2 + from.inertia_kg_m2.transpose());
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(symmetric * from.effort_scale);
  if (solver.eigenvalues().minCoeff() <= 0)
    return fail(ErrorCode::invalid_value, "the inertia is not that of a solid body (not positive definite)",
                place_of(from), "give the inertia about the centre of mass, in kg m^2");
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return std::make_unique<Body>(from, mass, solver.eigenvalues(), Pose{from.p_BCm, Quat(axes).normalized()});
}

Expected<void> check_joint(const state::WorldDescription& description, const state::JointDescription& joint) {
  const std::string where = "joint " + joint.name;
  const std::size_t bodies = description.bodies.size();
  const bool first_known = !joint.body1 || joint.body1.index() < bodies;
  if (!joint.body2 || joint.body2.index() >= bodies || !first_known)
    return fail(joint.body2 ? ErrorCode::unknown_name : ErrorCode::missing, "the joint lacks a body", where,
                "give body2 (and body1, or none for the world) by the bodies' names");
  if (joint.body1 == joint.body2)
    return fail(ErrorCode::conflict, "the joint ties a body to itself", where, "give two bodies");
  for (const Pose* X : {&joint.X_B1J, &joint.X_B2J}) {
    const double norm = X->R.norm();
    if (!X->p.allFinite() || !(std::abs(norm - 1) < 1e-6))
      return fail(
          ErrorCode::invalid_value,
          "a frame of the joint has a place that is not finite, or a rotation that is not a unit quaternion (norm " +
              std::to_string(norm) + ")",
          where, "check its anchor point and axis");
  }
  return {};
}

}  // namespace

struct DynamicsWorld::Impl {
  struct Joint {
    state::JointDescription description;
    std::size_t body1;  // or kGround
    std::size_t body2;
    Placed placed;
  };

  Vec3 gravity_W;
  Frame ground;  // body1 of joints that hang on the world
  std::vector<std::unique_ptr<Body>> bodies;
  std::vector<Joint> joints;
  std::array<Placed, hand::kMaxUsers> grips;
  std::unique_ptr<BodyContacts> contacts;   // null: no two bodies may ever meet
  std::unique_ptr<CouplingRows> couplings;  // null: the world has none
  std::vector<JointAxis> axes;              // by joint; empty without couplings
  std::vector<Frame> frames;                // by body, at the start of this step
  std::vector<Twist> free;                  // by body, its velocity after the step but for all rows and contacts
  Mechanism mechanism;
  ContactSolver contact_solver{mechanism, frames, free};
  std::vector<btCollisionObject*> touching;  // those that have contacts in this step and can move; capacity for all
  std::vector<char> touches;                 // by body: it is in touching

  void add_joint(const state::JointDescription& from);
  Expected<void> add_couplings(const state::WorldState& state);
  void reserve();
  void load_bodies(const state::WorldState& state);
  void apply_forces(state::WorldState& state, double dt_s);
  void apply_axis_force(const Joint& joint, const JointMeasure& now, double force);
  [[nodiscard]] double most_viscous(const Joint& joint, const JointMeasure& now, double dt_s) const;
  void gather_joints(state::WorldState& state, double dt_s);
  void gather_grasps(state::WorldState& state, double dt_s);
  void add_rows(Placed& placed, std::size_t body1, std::size_t body2);
  void free_velocities(double dt_s);
  void solve(std::span<btPersistentManifold*> manifolds, double dt_s);
  void find_touching(std::span<btPersistentManifold*> manifolds);
  void move_bodies(state::WorldState& state, double dt_s);
  void store_joints(state::WorldState& state);
  void store_grasps(state::WorldState& state, double dt_s);
  void store_watches(state::WorldState& state, double dt_s);

  [[nodiscard]] const Frame& frame_of(std::size_t body) const { return body == kGround ? ground : frames[body]; }
  [[nodiscard]] Wrench wrench_of(const Placed& placed, double dt_s, const Vec3 Row::*arm) const;
};

DynamicsWorld::DynamicsWorld(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DynamicsWorld::~DynamicsWorld() = default;

Expected<std::unique_ptr<DynamicsWorld>> DynamicsWorld::create(const state::WorldDescription& description,
                                                               const state::WorldState& state) {
  MECHANE_ASSERT(state.bodies.size() == description.bodies.size() && state.joints.size() == description.joints.size());
  if (const std::size_t most = std::max(state.joints.size(), state.couplings.size()); most > state::kMaxJoints)
    return fail(
        ErrorCode::too_large,
        std::to_string(most) + " joints or couplings are too many: a world takes " + std::to_string(state::kMaxJoints),
        {}, "make one body of those that do not move on each other, or divide the exhibit");
  auto impl = std::make_unique<Impl>();
  impl->gravity_W = description.gravity_W;
  for (const state::BodyDescription& from : description.bodies) {
    auto body = make_body(from);
    if (!body) return tl::unexpected(body.error());
    impl->bodies.push_back(std::move(*body));
  }
  for (const state::JointDescription& from : description.joints) {
    if (const auto good = check_joint(description, from); !good) return tl::unexpected(good.error());
    impl->add_joint(from);
  }
  std::vector<Collider> colliders;
  for (const auto& body : impl->bodies)
    colliders.push_back({&body->bullet, body->X_CB});
  auto contacts = BodyContacts::create(description, colliders);
  if (!contacts) return tl::unexpected(contacts.error());
  impl->contacts = std::move(*contacts);
  if (const auto good = impl->add_couplings(state); !good) return tl::unexpected(good.error());
  impl->reserve();
  return std::unique_ptr<DynamicsWorld>(new DynamicsWorld(std::move(impl)));
}

void DynamicsWorld::Impl::add_joint(const state::JointDescription& from) {
  joints.push_back({from, from.body1 ? from.body1.index() : kGround, from.body2.index(), {}});
}

Expected<void> DynamicsWorld::Impl::add_couplings(const state::WorldState& state) {
  if (state.couplings.empty()) return {};
  auto made = CouplingRows::create(state);
  if (!made) return tl::unexpected(made.error());
  couplings = std::make_unique<CouplingRows>(std::move(*made));
  axes.resize(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    axes[i].body1 = joints[i].body1;
    axes[i].body2 = joints[i].body2;
  }
  return {};
}

/// Room for every row that can ever be asked for at once, so that no step allocates. Bullet's solver keeps its tables from step to step:
/// one solve with all contacts sizes them.
void DynamicsWorld::Impl::reserve() {
  const std::size_t of_couplings = couplings ? couplings->most_rows() : 0;
  const std::size_t of_pairs = joints.size() * RowSet::kMost;
  const std::size_t of_grips = grips.size() * RowSet::kMost;
  const std::size_t of_contacts = contacts ? ContactSolver::kMostOwnRows : 0;
  const std::size_t tied = 2 * joints.size() + grips.size() + state::kMaxRopeNodes * of_couplings;
  mechanism.reserve(of_pairs + of_grips + of_couplings + of_contacts,
                    2 * (of_pairs + of_contacts) + of_grips + state::kMaxRopeNodes * of_couplings, bodies.size(),
                    std::min(tied, bodies.size()));
  frames.resize(bodies.size());
  free.resize(bodies.size());
  touches.resize(bodies.size());
  touching.reserve(bodies.size());
  contact_solver.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    bodies[i]->bullet.setUserIndex(static_cast<int>(i));
  if (contacts) solve(contacts->fill(), 1e-3);
}

void DynamicsWorld::step(state::WorldState& state, double dt_s) noexcept {
  MECHANE_ASSERT(dt_s > 0 && state.bodies.size() == impl_->bodies.size() &&
                 state.joints.size() == impl_->joints.size() &&
                 (impl_->couplings != nullptr || state.couplings.empty()));
  impl_->load_bodies(state);
  impl_->apply_forces(state, dt_s);
  impl_->mechanism.clear();
  impl_->gather_joints(state, dt_s);
  impl_->gather_grasps(state, dt_s);
  if (impl_->couplings) impl_->couplings->gather(state, impl_->frames, impl_->axes, dt_s, impl_->mechanism);
  impl_->free_velocities(dt_s);
  impl_->mechanism.factor();
  impl_->solve(impl_->contacts ? impl_->contacts->find(state, dt_s) : std::span<btPersistentManifold*>(), dt_s);
  impl_->move_bodies(state, dt_s);
  impl_->store_joints(state);
  impl_->store_grasps(state, dt_s);
  if (impl_->couplings) impl_->store_watches(state, dt_s);
}

void DynamicsWorld::Impl::load_bodies(const state::WorldState& state) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = *bodies[i];
    const state::BodyState& from = state.bodies[i];
    const bool moves = from.movable && !body.fixed;
    if (moves != body.moves) {
      body.bullet.setMassProps(moves ? body.mass_kg : 0, to_bt(moves ? body.principal_kg_m2 : Vec3::Zero()));
      body.bullet.setLinearVelocity({0, 0, 0});
      body.bullet.setAngularVelocity({0, 0, 0});
      body.moves = moves;
    }
    const Pose X_WC = from.X_WB * body.X_BC;
    Frame& frame = frames[i];
    frame.X_WB = from.X_WB;
    frame.p_WCm = X_WC.p;
    if (moves || contacts) body.bullet.setWorldTransform(to_bt(X_WC));
    if (!moves) {
      frame.V_WCm = {};
      frame.inverse_mass = 0;
      frame.inverse_inertia_W.setZero();
      continue;
    }
    const Mat3 R_WC(X_WC.R);
    frame.V_WCm = {from.V_WB.at(X_WC.p - from.X_WB.p), from.V_WB.w};
    frame.inverse_mass = 1 / body.mass_kg;
    frame.inverse_inertia_W = R_WC * body.principal_kg_m2.cwiseInverse().asDiagonal() * R_WC.transpose();
    body.bullet.setLinearVelocity(to_bt(frame.V_WCm.v));
    body.bullet.setAngularVelocity(to_bt(frame.V_WCm.w));
    body.bullet.clearForces();
  }
}

void DynamicsWorld::Impl::apply_forces(state::WorldState& state, double dt_s) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = *bodies[i];
    Wrench& load = state.bodies[i].load_W;
    if (body.moves) {
      const Vec3 weight = state.bodies[i].use_gravity ? Vec3(body.mass_kg * gravity_W) : Vec3::Zero();
      const Vec3 arm = frames[i].X_WB.p - frames[i].p_WCm;
      body.bullet.applyCentralForce(to_bt(weight + body.drive.f + load.f));
      body.bullet.applyTorque(to_bt(body.drive.t + load.t + arm.cross(load.f)));
      body.bullet.applyDamping(dt_s);
    }
    load = {};
  }
}

/// Equal and opposite on the two bodies, along (slider) or about (hinge) the joint's axis.
void DynamicsWorld::Impl::apply_axis_force(const Joint& joint, const JointMeasure& now, double force) {
  if (force == 0) return;
  for (const auto& [index, sign] : {std::pair{joint.body2, 1.0}, std::pair{joint.body1, -1.0}}) {
    if (frame_of(index).inverse_mass == 0) continue;
    btRigidBody& body = bodies[index]->bullet;
    const Vec3 along_W = sign * force * now.axis_W;
    if (joint.description.kind == state::JointKind::hinge) {
      body.applyTorque(to_bt(along_W));
    } else {
      body.applyCentralForce(to_bt(along_W));
      body.applyTorque(to_bt((now.p_WJ - frames[index].p_WCm).cross(along_W)));
    }
  }
}

/// The coefficient that stops the joint in one step; a larger one would reverse it. From the bodies' own mass or inertia, which is at
/// most the joint's.
double DynamicsWorld::Impl::most_viscous(const Joint& joint, const JointMeasure& now, double dt_s) const {
  double inverse = 0;
  for (const std::size_t body : {joint.body1, joint.body2}) {
    const Frame& f = frame_of(body);
    inverse += joint.description.kind == state::JointKind::hinge ? now.axis_W.dot(f.inverse_inertia_W * now.axis_W)
                                                                 : f.inverse_mass;
  }
  return inverse > 0 ? 1 / (dt_s * inverse) : 0;
}

void DynamicsWorld::Impl::gather_joints(state::WorldState& state, double dt_s) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    Joint& joint = joints[i];
    state::JointState& at = state.joints[i];
    const Frame& body1 = frame_of(joint.body1);
    const Frame& body2 = frame_of(joint.body2);
    const bool on = at.enabled && body1.inverse_mass + body2.inverse_mass > 0;
    joint.placed.rows.clear();
    if (!axes.empty()) axes[i].on = on && joint.description.kind != state::JointKind::ball;
    if (on) {
      const JointMeasure now = measure_joint(joint.description, body1, body2, at.position);
      const double drag = at.viscous > 0 ? -std::min(at.viscous, most_viscous(joint, now, dt_s)) * now.velocity : 0;
      apply_axis_force(joint, now, at.load + drag);
      joint_rows(joint.description, at, body1, body2, now, dt_s, joint.placed.rows);
      add_rows(joint.placed, joint.body1, joint.body2);
      if (!axes.empty()) {
        axes[i].now = now;
        axes[i].arm2_W = now.p_WJ - body2.p_WCm;
        axes[i].row = joint_axis_row(joint.description, body1, body2, now);
      }
    }
    at.load = 0;
    at.resistance = 0;
  }
}

void DynamicsWorld::Impl::gather_grasps(state::WorldState& state, double dt_s) {
  for (std::size_t u = 0; u < state.users.size(); ++u) {
    state::UserState& user = state.users[u];
    grips[u].rows.clear();
    if (!user.present || !user.grasp.active || !user.grasp.body) continue;
    const std::size_t held = user.grasp.body.index();
    MECHANE_ASSERT(held < bodies.size());
    grasp_rows(grip_spring(bodies[held]->grip, user.grasp.p_BG), frames[held], user, dt_s, grips[u].rows);
    add_rows(grips[u], kGround, held);
  }
}

void DynamicsWorld::Impl::add_rows(Placed& placed, std::size_t body1, std::size_t body2) {
  placed.first = mechanism.size();
  for (std::size_t k = 0; k < placed.rows.count; ++k)
    mechanism.add_row(placed.rows.rows[k], body1, body2, frames);
}

/// With the torque by which a body that tumbles turns its axes, solved implicitly.
void DynamicsWorld::Impl::free_velocities(double dt_s) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i]->moves) continue;
    const btRigidBody& body = bodies[i]->bullet;
    const Frame& frame = frames[i];
    const btVector3 w = body.getAngularVelocity();
    free[i].v = from_bt(body.getLinearVelocity()) + dt_s * frame.inverse_mass * from_bt(body.getTotalForce());
    free[i].w = from_bt(w) + frame.inverse_inertia_W * (dt_s * from_bt(body.getTotalTorque()));
    if (!w.isZero()) free[i].w += from_bt(body.computeGyroscopicImpulseImplicit_Body(dt_s));
  }
}

/// The bodies' velocities after the step.
void DynamicsWorld::Impl::solve(std::span<btPersistentManifold*> manifolds, double dt_s) {
  find_touching(manifolds);
  if (!contact_solver.has_bodies()) mechanism.solve(free);
  if (!manifolds.empty()) contact_solver.solve(touching, manifolds, dt_s);
  for (const std::size_t body : mechanism.bodies()) {
    free[body].v += mechanism.change(body).v;
    free[body].w += mechanism.change(body).w;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i]->moves || touches[i] != 0) continue;  // Bullet has written the velocities of those that touch
    bodies[i]->bullet.setLinearVelocity(to_bt(free[i].v));
    bodies[i]->bullet.setAngularVelocity(to_bt(free[i].w));
  }
}

void DynamicsWorld::Impl::find_touching(std::span<btPersistentManifold*> manifolds) {
  std::fill(touches.begin(), touches.end(), char{0});
  touching.clear();
  for (const btPersistentManifold* manifold : manifolds) {
    for (const btCollisionObject* object : {manifold->getBody0(), manifold->getBody1()}) {
      const auto body = static_cast<std::size_t>(object->getUserIndex());
      if (touches[body] != 0 || !bodies[body]->moves) continue;
      touches[body] = 1;
      bodies[body]->bullet.updateInertiaTensor();
      touching.push_back(&bodies[body]->bullet);
    }
  }
  contact_solver.clear();
  for (const std::size_t body : mechanism.bodies()) {
    if (touches[body] != 0) contact_solver.add(bodies[body]->bullet);
  }
}

void DynamicsWorld::Impl::move_bodies(state::WorldState& state, double dt_s) {
  if (contacts) contacts->note_rest();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = *bodies[i];
    state::BodyState& to = state.bodies[i];
    if (!body.moves) {
      to.V_WB = {};
      continue;
    }
    btTransform X = body.bullet.getWorldTransform();
    if (!contacts || !contacts->rests(i)) body.bullet.predictIntegratedTransform(dt_s, X);
    const btQuaternion q = X.getRotation();
    const Pose X_WC{from_bt(X.getOrigin()), Quat(q.w(), q.x(), q.y(), q.z()).normalized()};
    Pose X_WB = X_WC * body.X_CB;
    if (X_WB.R.dot(to.X_WB.R) < 0) X_WB.R.coeffs() = -X_WB.R.coeffs();  // the same rotation, without a jump of sign
    const Twist V_WC{from_bt(body.bullet.getLinearVelocity()), from_bt(body.bullet.getAngularVelocity())};
    to.X_WB = X_WB;
    to.V_WB = {V_WC.at(X_WB.p - X_WC.p), V_WC.w};
    frames[i].X_WB = X_WB;
    frames[i].p_WCm = X_WC.p;
    frames[i].V_WCm = V_WC;
  }
}

void DynamicsWorld::Impl::store_joints(state::WorldState& state) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    state::JointState& to = state.joints[i];
    to.velocity = 0;
    if (!to.enabled) continue;
    const JointMeasure now =
        measure_joint(joints[i].description, frame_of(joints[i].body1), frame_of(joints[i].body2), to.position);
    to.position = now.position;
    to.velocity = now.velocity;
  }
}

/// What placed rows do to one of their bodies, of which `arm` is the member, about its centre of mass; without the sign.
Wrench DynamicsWorld::Impl::wrench_of(const Placed& placed, double dt_s, const Vec3 Row::*arm) const {
  Wrench sum;
  for (std::size_t k = 0; k < placed.rows.count; ++k) {
    const double force = mechanism.impulse_of(placed.first + k) / dt_s;
    sum.f += force * placed.rows.rows[k].n_W;
    sum.t += force * (placed.rows.rows[k].*arm);
  }
  return sum;
}

void DynamicsWorld::Impl::store_grasps(state::WorldState& state, double dt_s) {
  for (std::size_t u = 0; u < state.users.size(); ++u) {
    const Wrench of_hand = wrench_of(grips[u], dt_s, &Row::a1_W);
    state.users[u].grasp.reaction_W = {-of_hand.f, -of_hand.t};
  }
}

/// What couplings bore, and what joints bear: what their own rows give to body2.
void DynamicsWorld::Impl::store_watches(state::WorldState& state, double dt_s) {
  couplings->store(state, axes, mechanism, dt_s);
  for (state::Coupling& watch : state.couplings) {
    if (watch.kind != state::CouplingKind::watch || !watch.joint1 || !state[watch.joint1].enabled) continue;
    const std::size_t i = watch.joint1.index();
    if (joints[i].placed.rows.count == 0) continue;
    const Wrench bears = wrench_of(joints[i].placed, dt_s, &Row::a2_W);
    watch.force_n = bears.f.norm();
    watch.torque_nm = (bears.t - axes[i].arm2_W.cross(bears.f)).norm();
  }
}

}  // namespace mechane::dynamics
