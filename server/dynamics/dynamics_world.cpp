#include "server/dynamics/dynamics_world.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "server/base/assert.hpp"
#include "server/dynamics/body_contacts.hpp"
#include "server/dynamics/coupling_rows.hpp"
#include "server/dynamics/grasp_rows.hpp"
#include "server/dynamics/joint_rows.hpp"

namespace mechane::dynamics {
namespace {

constexpr int kSolverIterations = 60;
constexpr double kSolverResidual = 1e-20;  // (m/s)^2: the iterations end when no row changes by more than 1e-10 m/s

btVector3 to_bt(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
btQuaternion to_bt(const Quat& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}
btTransform to_bt(const Pose& X) {
  return btTransform(to_bt(X.R), to_bt(X.p));
}
Vec3 from_bt(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

/// The one kind of constraint that this room gives to Bullet: the rows that joint_rows and grasp_rows computed. Bullet's body A is
/// body2, its body B is body1.
class RowConstraint final : public btTypedConstraint {
 public:
  RowConstraint(btRigidBody& body1, btRigidBody& body2) : btTypedConstraint(MAX_CONSTRAINT_TYPE, body2, body1) {}

  RowSet rows;

  void getInfo1(btConstraintInfo1* info) override {
    info->m_numConstraintRows = static_cast<int>(rows.count);
    info->nub = 0;
  }
  void getInfo2(btConstraintInfo2* info) override {
    for (std::size_t i = 0; i < rows.count; ++i) {
      const Row& row = rows.rows[i];
      const std::size_t at = i * static_cast<std::size_t>(info->rowskip);
      copy(row.n_W, info->m_J1linearAxis + at);
      copy(row.a2_W, info->m_J1angularAxis + at);
      copy(-row.n_W, info->m_J2linearAxis + at);
      copy(-row.a1_W, info->m_J2angularAxis + at);
      info->m_constraintError[at] = row.target;
      info->m_lowerLimit[at] = std::max(row.min_impulse, -static_cast<double>(SIMD_INFINITY));
      info->m_upperLimit[at] = std::min(row.max_impulse, static_cast<double>(SIMD_INFINITY));
    }
  }
  void setParam(int, btScalar, int) override {}
  [[nodiscard]] btScalar getParam(int, int) const override { return 0; }

 private:
  static void copy(const Vec3& v, btScalar* to) {
    for (int k = 0; k < 3; ++k)
      to[k] = v[k];
  }
};

/// Bullet's solver, with a train of couplings swept after each of its own sweeps. The bodies that it is given begin with those of the
/// train, in their order.
class Solver final : public btSequentialImpulseConstraintSolver {
 public:
  Train* train = nullptr;  // null: none

  void reserve(std::size_t bodies) {
    start_.resize(bodies);
    delta_.resize(bodies);
  }

 protected:
  btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int body_count,
                                btPersistentManifold** manifolds, int manifold_count, btTypedConstraint** constraints,
                                int constraint_count, const btContactSolverInfo& info, btIDebugDraw* draw) override {
    const btScalar residual = btSequentialImpulseConstraintSolver::solveSingleIteration(
        iteration, bodies, body_count, manifolds, manifold_count, constraints, constraint_count, info, draw);
    if (train == nullptr || train->size() == 0) return residual;
    for (const std::size_t i : train->bodies()) {
      const btSolverBody& body = solver_body(bodies[i]);
      delta_[i] = {from_bt(body.m_deltaLinearVelocity), from_bt(body.m_deltaAngularVelocity)};
      if (iteration != 0) continue;
      start_[i] = {from_bt(body.m_linearVelocity + body.m_externalForceImpulse),
                   from_bt(body.m_angularVelocity + body.m_externalTorqueImpulse)};
    }
    if (iteration == 0) train->begin(start_);
    const double change = train->sweep(delta_);
    for (const std::size_t i : train->bodies()) {
      btSolverBody& body = solver_body(bodies[i]);
      body.m_deltaLinearVelocity = to_bt(delta_[i].v);
      body.m_deltaAngularVelocity = to_bt(delta_[i].w);
    }
    return std::max(residual, change);
  }

 private:
  btSolverBody& solver_body(const btCollisionObject* body) { return m_tmpSolverBodyPool[body->getCompanionId()]; }

  std::vector<Twist> start_;
  std::vector<Twist> delta_;
};

/// A body of ours and the same body in Bullet, which uses another frame. C is the centre of mass with the principal axes.
struct Body {
  btRigidBody bullet;
  Pose X_BC;
  Pose X_CB;
  Vec3 principal_kg_m2;  // simulated
  double mass_kg;        // simulated
  bool fixed;
  bool use_gravity;
  Wrench drive;       // simulated
  bool moves = true;  // whether Bullet has its mass now
  GripBody grip;
  Frame frame;  // at the start of this step

  Body(const state::BodyDescription& from, double mass, const Vec3& principal, const Pose& X_BC_in)
      : bullet(btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, nullptr, to_bt(principal))),
        X_BC(X_BC_in),
        X_CB(X_BC_in.inverse()),
        principal_kg_m2(principal),
        mass_kg(mass),
        fixed(from.fixed),
        use_gravity(from.use_gravity),
        drive{from.effort_scale * from.drive.f, from.effort_scale * from.drive.t},
        grip(grip_body(from)) {
    bullet.setDamping(from.linear_damping, from.angular_damping);
  }
};

/// The hand's end of a grip: see GripStep.
struct Hand {
  btRigidBody proxy{btRigidBody::btRigidBodyConstructionInfo(1, nullptr, nullptr, btVector3(1, 1, 1))};
  btJointFeedback feedback;
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
    Body* body1;
    Body* body2;
    std::unique_ptr<RowConstraint> constraint;
    std::unique_ptr<btJointFeedback> feedback;  // null: nothing measures what it bears
  };

  Vec3 gravity_W;
  std::unique_ptr<Body> ground;  // body1 of joints that hang on the world
  std::vector<std::unique_ptr<Body>> bodies;
  std::vector<Joint> joints;
  std::array<Hand, hand::kMaxUsers> hands;
  std::vector<std::unique_ptr<RowConstraint>> grips;  // by user, then body
  std::unique_ptr<BodyContacts> contacts;             // null: no two bodies may ever meet
  std::unique_ptr<CouplingRows> couplings;            // null: the world has none
  std::vector<JointAxis> axes;                        // by joint; empty without couplings
  std::vector<Frame> frames;                          // by body, at the start of this step; empty without couplings
  Solver solver;
  btContactSolverInfo solver_info;
  std::vector<btCollisionObject*> solver_bodies;
  std::vector<btTypedConstraint*> active;  // the constraints of this step, in a fixed order; capacity for all

  void add_joint(const state::JointDescription& from);
  Expected<void> add_couplings(const state::WorldState& state);
  void add_grips();
  void warm_up(double dt_s);
  void load_bodies(const state::WorldState& state);
  void apply_forces(state::WorldState& state, double dt_s);
  void apply_axis_force(const Joint& joint, const JointMeasure& now, double force);
  static double most_viscous(const Joint& joint, const JointMeasure& now, double dt_s);
  void gather_joints(state::WorldState& state, double dt_s);
  void gather_grasps(state::WorldState& state, double dt_s);
  void gather_couplings(const state::WorldState& state, double dt_s);
  void integrate(double dt_s);
  void store_bodies(state::WorldState& state);
  void store_joints(state::WorldState& state);
  void store_grasps(state::WorldState& state);
  void store_couplings(state::WorldState& state, double dt_s);
  void solve(std::span<btPersistentManifold*> manifolds, double dt_s);

  RowConstraint& grip(std::size_t user, std::size_t body) { return *grips[user * bodies.size() + body]; }
};

DynamicsWorld::DynamicsWorld(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DynamicsWorld::~DynamicsWorld() = default;

Expected<std::unique_ptr<DynamicsWorld>> DynamicsWorld::create(const state::WorldDescription& description,
                                                               const state::WorldState& state) {
  MECHANE_ASSERT(state.bodies.size() == description.bodies.size() && state.joints.size() == description.joints.size());
  auto impl = std::make_unique<Impl>();
  impl->gravity_W = description.gravity_W;
  state::BodyDescription ground;
  ground.fixed = true;
  impl->ground = std::make_unique<Body>(ground, 0.0, Vec3::Zero(), Pose{});
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
  impl->add_grips();
  if (const auto good = impl->add_couplings(state); !good) return tl::unexpected(good.error());
  impl->warm_up(1e-3);
  return std::unique_ptr<DynamicsWorld>(new DynamicsWorld(std::move(impl)));
}

void DynamicsWorld::Impl::add_joint(const state::JointDescription& from) {
  Body* body1 = from.body1 ? bodies[from.body1.index()].get() : ground.get();
  Body* body2 = bodies[from.body2.index()].get();
  joints.push_back({from, body1, body2, std::make_unique<RowConstraint>(body1->bullet, body2->bullet), nullptr});
}

Expected<void> DynamicsWorld::Impl::add_couplings(const state::WorldState& state) {
  if (state.couplings.empty()) return {};
  auto made = CouplingRows::create(state);
  if (!made) return tl::unexpected(made.error());
  couplings = std::make_unique<CouplingRows>(std::move(*made));
  frames.resize(bodies.size());
  axes.resize(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const state::JointDescription& joint = joints[i].description;
    axes[i].body1 = joint.body1 ? joint.body1.index() : kGround;
    axes[i].body2 = joint.body2.index();
  }
  for (const state::Coupling& coupling : state.couplings) {
    if (coupling.kind != state::CouplingKind::watch) continue;
    Joint& joint = joints[coupling.joint1.index()];
    if (!joint.feedback) joint.feedback = std::make_unique<btJointFeedback>();
    joint.constraint->setJointFeedback(joint.feedback.get());
  }
  solver.train = &couplings->train;
  solver.reserve(bodies.size());
  return {};
}

void DynamicsWorld::Impl::add_grips() {
  for (auto& body : bodies)
    solver_bodies.push_back(&body->bullet);
  for (Hand& hand : hands) {
    hand.proxy.setDamping(0, 0);
    hand.proxy.setFlags(0);
    solver_bodies.push_back(&hand.proxy);
    for (auto& body : bodies) {
      grips.push_back(std::make_unique<RowConstraint>(hand.proxy, body->bullet));
      grips.back()->setJointFeedback(&hand.feedback);
    }
  }
  active.reserve(joints.size() + grips.size());
  solver_info.m_numIterations = kSolverIterations;
  solver_info.m_leastSquaresResidualThreshold = kSolverResidual;
  set_contact_solver(solver_info);
}

/// Bullet's solver keeps its tables from step to step: one solve with every row that can ever be asked for at once sizes them, so
/// that no later step allocates.
void DynamicsWorld::Impl::warm_up(double dt_s) {
  active.clear();
  for (Joint& joint : joints)
    active.push_back(joint.constraint.get());
  for (auto& grip : grips)
    active.push_back(grip.get());
  for (btTypedConstraint* constraint : active) {
    RowSet& rows = static_cast<RowConstraint*>(constraint)->rows;
    rows.clear();
    while (rows.count < rows.rows.size())
      rows.add(angular_row(Vec3::UnitX()));
  }
  solve(contacts ? contacts->fill() : std::span<btPersistentManifold*>(), dt_s);
  active.clear();
}

void DynamicsWorld::step(state::WorldState& state, double dt_s) noexcept {
  MECHANE_ASSERT(dt_s > 0 && state.bodies.size() == impl_->bodies.size() &&
                 state.joints.size() == impl_->joints.size() &&
                 (impl_->couplings != nullptr || state.couplings.empty()));
  impl_->load_bodies(state);
  impl_->apply_forces(state, dt_s);
  impl_->active.clear();
  impl_->gather_joints(state, dt_s);
  impl_->gather_grasps(state, dt_s);
  if (impl_->couplings) impl_->gather_couplings(state, dt_s);
  impl_->solve(impl_->contacts ? impl_->contacts->find(state, dt_s) : std::span<btPersistentManifold*>(), dt_s);
  impl_->integrate(dt_s);
  impl_->store_bodies(state);
  impl_->store_joints(state);
  impl_->store_grasps(state);
  if (impl_->couplings) impl_->store_couplings(state, dt_s);
}

void DynamicsWorld::Impl::load_bodies(const state::WorldState& state) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = *bodies[i];
    const state::BodyState& from = state.bodies[i];
    const bool moves = from.movable && !body.fixed;
    if (moves != body.moves) {
      body.bullet.setMassProps(moves ? body.mass_kg : 0, to_bt(moves ? body.principal_kg_m2 : Vec3::Zero()));
      body.moves = moves;
    }
    const Pose X_WC = from.X_WB * body.X_BC;
    const Twist V_WC = moves ? Twist{from.V_WB.at(X_WC.p - from.X_WB.p), from.V_WB.w} : Twist{};
    const Mat3 R_WC(X_WC.R);
    const Vec3 inverse = moves ? Vec3(body.principal_kg_m2.cwiseInverse()) : Vec3::Zero();
    body.frame = {from.X_WB, X_WC.p, V_WC, moves ? 1 / body.mass_kg : 0,
                  R_WC * inverse.asDiagonal() * R_WC.transpose()};
    body.bullet.setCenterOfMassTransform(to_bt(X_WC));
    body.bullet.setLinearVelocity(to_bt(V_WC.v));
    body.bullet.setAngularVelocity(to_bt(V_WC.w));
    body.bullet.clearForces();
  }
}

void DynamicsWorld::Impl::apply_forces(state::WorldState& state, double dt_s) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = *bodies[i];
    Wrench& load = state.bodies[i].load_W;
    if (body.moves) {
      const Vec3 weight = body.use_gravity ? Vec3(body.mass_kg * gravity_W) : Vec3::Zero();
      const Vec3 arm = body.frame.X_WB.p - body.frame.p_WCm;
      body.bullet.applyCentralForce(to_bt(weight + body.drive.f + load.f));
      body.bullet.applyTorque(to_bt(body.drive.t + load.t + arm.cross(load.f)));
      body.bullet.applyDamping(dt_s);
    }
    load = {};
  }
}

/// Equal and opposite on the two bodies, along (slider) or about (hinge) the joint's axis.
void DynamicsWorld::Impl::apply_axis_force(const Joint& joint, const JointMeasure& now, double force) {
  for (const auto& [body, sign] : {std::pair{joint.body2, 1.0}, std::pair{joint.body1, -1.0}}) {
    if (!body->moves) continue;
    const Vec3 along_W = sign * force * now.axis_W;
    if (joint.description.kind == state::JointKind::hinge) {
      body->bullet.applyTorque(to_bt(along_W));
    } else {
      body->bullet.applyCentralForce(to_bt(along_W));
      body->bullet.applyTorque(to_bt((now.p_WJ - body->frame.p_WCm).cross(along_W)));
    }
  }
}

/// The coefficient that stops the joint in one step; a larger one would reverse it. From the bodies' own mass or inertia, which is at
/// most the joint's.
double DynamicsWorld::Impl::most_viscous(const Joint& joint, const JointMeasure& now, double dt_s) {
  double inverse = 0;
  for (const Body* body : {joint.body1, joint.body2}) {
    const Frame& f = body->frame;
    inverse += joint.description.kind == state::JointKind::hinge ? now.axis_W.dot(f.inverse_inertia_W * now.axis_W)
                                                                 : f.inverse_mass;
  }
  return inverse > 0 ? 1 / (dt_s * inverse) : 0;
}

void DynamicsWorld::Impl::gather_joints(state::WorldState& state, double dt_s) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    Joint& joint = joints[i];
    state::JointState& at = state.joints[i];
    JointAxis* axis = couplings ? &axes[i] : nullptr;
    if (axis != nullptr) axis->on = false;
    if (at.enabled) {
      const JointMeasure now = measure_joint(joint.description, joint.body1->frame, joint.body2->frame, at.position);
      const double drag = -std::min(at.viscous, most_viscous(joint, now, dt_s)) * now.velocity;
      apply_axis_force(joint, now, at.load + drag);
      joint_rows(joint.description, at, joint.body1->frame, joint.body2->frame, dt_s, joint.constraint->rows,
                 axis != nullptr ? &axis->row : nullptr);
      if (joint.constraint->rows.count > 0) active.push_back(joint.constraint.get());
      if (axis != nullptr) {
        axis->on = joint.constraint->rows.count > 0 && joint.description.kind != state::JointKind::ball;
        axis->now = now;
        axis->raw = joint_axis_row(joint.description, joint.body1->frame, joint.body2->frame, now);
      }
    }
    at.load = 0;
    at.resistance = 0;
  }
}

void DynamicsWorld::Impl::gather_grasps(state::WorldState& state, double dt_s) {
  for (std::size_t u = 0; u < state.users.size(); ++u) {
    state::UserState& user = state.users[u];
    btRigidBody& proxy = hands[u].proxy;
    proxy.clearForces();
    proxy.setLinearVelocity({0, 0, 0});
    proxy.setAngularVelocity({0, 0, 0});
    if (!user.present || !user.grasp.active || !user.grasp.body) continue;
    const std::size_t held = user.grasp.body.index();
    MECHANE_ASSERT(held < bodies.size());
    const Body& body = *bodies[held];
    RowConstraint& constraint = grip(u, held);
    const GripStep step = grasp_rows(grip_spring(body.grip, user.grasp.p_BG), body.frame, user, dt_s, constraint.rows);
    if (constraint.rows.count == 0) continue;
    const double inertia = 1 / step.inverse_inertia;
    proxy.setMassProps(1 / step.inverse_mass, {inertia, inertia, inertia});
    proxy.setCenterOfMassTransform(to_bt(Pose{step.p_WG, Quat::Identity()}));
    proxy.setLinearVelocity(to_bt(step.V_WG.v));
    proxy.setAngularVelocity(to_bt(step.V_WG.w));
    active.push_back(&constraint);
  }
}

void DynamicsWorld::Impl::gather_couplings(const state::WorldState& state, double dt_s) {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    frames[i] = bodies[i]->frame;
  couplings->gather(state, frames, axes, dt_s);
}

void DynamicsWorld::Impl::solve(std::span<btPersistentManifold*> manifolds, double dt_s) {
  solver_info.m_timeStep = dt_s;
  solver.solveGroup(solver_bodies.data(), static_cast<int>(solver_bodies.size()), manifolds.data(),
                    static_cast<int>(manifolds.size()), active.data(), static_cast<int>(active.size()), solver_info,
                    nullptr, nullptr);
}

void DynamicsWorld::Impl::integrate(double dt_s) {
  if (contacts) contacts->note_rest();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    btRigidBody& body = bodies[i]->bullet;
    if (!bodies[i]->moves || (contacts && contacts->rests(i))) continue;
    btTransform next;
    body.predictIntegratedTransform(dt_s, next);
    body.setCenterOfMassTransform(next);
  }
}

void DynamicsWorld::Impl::store_bodies(state::WorldState& state) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = *bodies[i];
    state::BodyState& to = state.bodies[i];
    if (!body.moves) {
      to.V_WB = {};
      continue;
    }
    const btTransform& X = body.bullet.getCenterOfMassTransform();
    const btQuaternion q = X.getRotation();
    const Pose X_WC{from_bt(X.getOrigin()), Quat(q.w(), q.x(), q.y(), q.z()).normalized()};
    Pose X_WB = X_WC * body.X_CB;
    if (X_WB.R.dot(to.X_WB.R) < 0) X_WB.R.coeffs() = -X_WB.R.coeffs();  // the same rotation, without a jump of sign
    const Twist V_WC{from_bt(body.bullet.getLinearVelocity()), from_bt(body.bullet.getAngularVelocity())};
    to.X_WB = X_WB;
    to.V_WB = {V_WC.at(X_WB.p - X_WC.p), V_WC.w};
    body.frame.X_WB = X_WB;
    body.frame.p_WCm = X_WC.p;
    body.frame.V_WCm = V_WC;
  }
}

void DynamicsWorld::Impl::store_joints(state::WorldState& state) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    state::JointState& to = state.joints[i];
    to.velocity = 0;
    if (!to.enabled) continue;
    const JointMeasure now =
        measure_joint(joints[i].description, joints[i].body1->frame, joints[i].body2->frame, to.position);
    to.position = now.position;
    to.velocity = now.velocity;
  }
}

void DynamicsWorld::Impl::store_grasps(state::WorldState& state) {
  for (std::size_t u = 0; u < state.users.size(); ++u) {
    state::Grasp& grasp = state.users[u].grasp;
    grasp.reaction_W = {};
    const btJointFeedback& feedback = hands[u].feedback;
    const bool solved =
        state.users[u].present && grasp.active && grasp.body && grip(u, grasp.body.index()).rows.count > 0;
    if (solved) grasp.reaction_W = {from_bt(feedback.m_appliedForceBodyB), from_bt(feedback.m_appliedTorqueBodyB)};
  }
}

/// What a joint bears is what its own rows gave to body2, and what couplings along its axis left to its locks.
void DynamicsWorld::Impl::store_couplings(state::WorldState& state, double dt_s) {
  couplings->store(state, axes, dt_s);
  for (state::Coupling& watch : state.couplings) {
    if (watch.kind != state::CouplingKind::watch || !watch.joint1 || !state[watch.joint1].enabled) continue;
    const std::size_t i = watch.joint1.index();
    if (joints[i].constraint->rows.count == 0) continue;
    const JointAxis& axis = axes[i];
    const double extra = axis.on ? axis.extra_impulse / dt_s : 0;
    const Vec3 f = from_bt(joints[i].feedback->m_appliedForceBodyA) + extra * (axis.row.n_W - axis.raw.n_W);
    const Vec3 t = from_bt(joints[i].feedback->m_appliedTorqueBodyA) + extra * (axis.row.a2_W - axis.raw.a2_W);
    const Vec3 arm = axis.now.p_WJ - frames[joints[i].description.body2.index()].p_WCm;
    watch.force_n = f.norm();
    watch.torque_nm = (t - arm.cross(f)).norm();
  }
}

}  // namespace mechane::dynamics
