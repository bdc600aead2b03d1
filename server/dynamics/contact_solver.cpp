#include "server/dynamics/contact_solver.hpp"

#include <algorithm>
#include <limits>

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "server/dynamics/body_contacts.hpp"
#include "server/dynamics/bullet_math.hpp"

namespace mechane::dynamics {
namespace {

constexpr int kContactSweeps = 60;
constexpr double kContactResidual = 1e-20;  // (m/s)^2: the sweeps end when no contact changes by more than 1e-10 m/s
constexpr int kFrictionDirections = 2;      // that set_contact_solver() asks Bullet for, at each contact

std::size_t index_of(const btCollisionObject& body) {
  return static_cast<std::size_t>(body.getUserIndex());
}

}  // namespace

class ContactSolver::Rows final : public btSequentialImpulseConstraintSolver {
 public:
  Rows(Mechanism& mechanism, const std::vector<Frame>& frames, const std::vector<Twist>& free);

  void reserve(std::size_t bodies);
  void clear() noexcept;
  void add(const btCollisionObject& body) noexcept;
  [[nodiscard]] bool has_bodies() const noexcept { return !touching_.empty(); }
  void solve(std::span<btCollisionObject*> bodies, std::span<btPersistentManifold*> manifolds, double dt_s);

 protected:
  btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int body_count,
                                btPersistentManifold** manifolds, int manifold_count, btTypedConstraint** constraints,
                                int constraint_count, const btContactSolverInfo& info, btIDebugDraw* draw) override;
  btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int body_count,
                                         const btContactSolverInfo& info) override;

 private:
  void begin() noexcept;
  void take_over(btSolverConstraint& contact) noexcept;
  void add_row(btSolverConstraint& from, MechanismRow row) noexcept;
  [[nodiscard]] std::size_t body_of(int id) const noexcept;
  [[nodiscard]] btSolverBody& solver_body(std::size_t i) noexcept;
  double give_changes() noexcept;

  Mechanism& mechanism_;
  const std::vector<Frame>& frames_;
  const std::vector<Twist>& free_;
  btContactSolverInfo info_;
  std::vector<std::size_t> touching_;              // bodies of the mechanism that have contacts
  std::vector<const btCollisionObject*> bullets_;  // theirs
  std::vector<Twist> pushes_;                      // what Bullet's rows do to them
  std::vector<Twist> V_;                           // by body, without the mechanism's impulses
  bool in_turn_ = false;                           // a contact of theirs is Bullet's in this step
};

ContactSolver::ContactSolver(Mechanism& mechanism, const std::vector<Frame>& frames, const std::vector<Twist>& free)
    : rows_(std::make_unique<Rows>(mechanism, frames, free)) {}
ContactSolver::~ContactSolver() = default;

void ContactSolver::reserve(std::size_t bodies) {
  rows_->reserve(bodies);
}
void ContactSolver::clear() noexcept {
  rows_->clear();
}
void ContactSolver::add(const btCollisionObject& body) noexcept {
  rows_->add(body);
}
bool ContactSolver::has_bodies() const noexcept {
  return rows_->has_bodies();
}
void ContactSolver::solve(std::span<btCollisionObject*> bodies, std::span<btPersistentManifold*> manifolds,
                          double dt_s) {
  rows_->solve(bodies, manifolds, dt_s);
}

ContactSolver::Rows::Rows(Mechanism& mechanism, const std::vector<Frame>& frames, const std::vector<Twist>& free)
    : mechanism_(mechanism), frames_(frames), free_(free) {
  info_.m_numIterations = kContactSweeps;
  info_.m_leastSquaresResidualThreshold = kContactResidual;
  set_contact_solver(info_);
}

void ContactSolver::Rows::solve(std::span<btCollisionObject*> bodies, std::span<btPersistentManifold*> manifolds,
                                double dt_s) {
  info_.m_timeStep = dt_s;
  solveGroup(bodies.data(), static_cast<int>(bodies.size()), manifolds.data(), static_cast<int>(manifolds.size()),
             nullptr, 0, info_, nullptr, nullptr);
}

void ContactSolver::Rows::reserve(std::size_t bodies) {
  touching_.reserve(bodies);
  bullets_.reserve(bodies);
  pushes_.reserve(bodies);
  V_.resize(bodies);
}

void ContactSolver::Rows::clear() noexcept {
  touching_.clear();
  bullets_.clear();
  pushes_.clear();
}

void ContactSolver::Rows::add(const btCollisionObject& body) noexcept {
  touching_.push_back(index_of(body));
  bullets_.push_back(&body);
  pushes_.emplace_back();
}

btScalar ContactSolver::Rows::solveSingleIteration(int iteration, btCollisionObject** bodies, int body_count,
                                                   btPersistentManifold** manifolds, int manifold_count,
                                                   btTypedConstraint** constraints, int constraint_count,
                                                   const btContactSolverInfo& info, btIDebugDraw* draw) {
  if (iteration == 0) begin();
  const btScalar residual = btSequentialImpulseConstraintSolver::solveSingleIteration(
      iteration, bodies, body_count, manifolds, manifold_count, constraints, constraint_count, info, draw);
  if (!in_turn_) return residual;
  for (std::size_t i = 0; i < touching_.size(); ++i) {
    const btSolverBody& body = solver_body(i);
    pushes_[i].v = from_bt(body.m_deltaLinearVelocity) - mechanism_.change(touching_[i]).v;
    pushes_[i].w = from_bt(body.m_deltaAngularVelocity) - mechanism_.change(touching_[i]).w;
  }
  mechanism_.respond(pushes_);
  return std::max(residual, give_changes());
}

/// With Bullet's rows made, and what overlaps moved apart.
void ContactSolver::Rows::begin() noexcept {
  in_turn_ = false;
  if (touching_.empty()) return;
  const std::size_t before = mechanism_.size();
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    btSolverConstraint& contact = m_tmpSolverContactConstraintPool[i];
    const std::size_t a = body_of(contact.m_solverBodyIdA), b = body_of(contact.m_solverBodyIdB);
    if (!mechanism_.moves(a) && !mechanism_.moves(b)) continue;
    const bool alone = (a == kGround || mechanism_.moves(a)) && (b == kGround || mechanism_.moves(b));
    const bool room = mechanism_.size() + 1 + kFrictionDirections <= before + kMostOwnRows;
    if (alone && room) {
      take_over(contact);
    } else {
      in_turn_ = true;
    }
  }
  mechanism_.factor();
  mechanism_.solve(free_);
  if (in_turn_) mechanism_.condense(touching_, frames_);
  give_changes();
}

/// Makes a contact's row, and those of its friction, the mechanism's. Bullet's then do nothing.
void ContactSolver::Rows::take_over(btSolverConstraint& contact) noexcept {
  const std::size_t leader = mechanism_.size();
  add_row(contact, {0, RowLimit::range, 0, 0, std::numeric_limits<double>::infinity()});
  for (int k = 0; k < kFrictionDirections; ++k) {
    btSolverConstraint& rubs = m_tmpSolverContactFrictionConstraintPool[contact.m_frictionIndex + k];
    add_row(rubs, {0, RowLimit::friction, leader, 0, rubs.m_friction});
  }
}

void ContactSolver::Rows::add_row(btSolverConstraint& from, MechanismRow row) noexcept {
  const std::size_t a = body_of(from.m_solverBodyIdA), b = body_of(from.m_solverBodyIdB);
  const Vec3 n_a = from_bt(from.m_contactNormal1), a_a = from_bt(from.m_relpos1CrossNormal);
  const Vec3 n_b = from_bt(from.m_contactNormal2), a_b = from_bt(from.m_relpos2CrossNormal);
  row.target = from.m_rhs / from.m_jacDiagABInv;  // Bullet's rows want a change of the velocity, ours a velocity
  if (a != kGround) row.target += n_a.dot(free_[a].v) + a_a.dot(free_[a].w);
  if (b != kGround) row.target += n_b.dot(free_[b].v) + a_b.dot(free_[b].w);
  mechanism_.add(row);
  mechanism_.add_term(a, n_a, a_a, frames_);
  mechanism_.add_term(b, n_b, a_b, frames_);
  from.m_rhs = from.m_jacDiagABInv = 0;
}

/// Of Bullet's solver body; the ground where it does not move.
std::size_t ContactSolver::Rows::body_of(int id) const noexcept {
  const btRigidBody* body = m_tmpSolverBodyPool[id].m_originalBody;
  return body == nullptr || body->getInvMass() == 0 ? kGround : index_of(*body);
}

btScalar ContactSolver::Rows::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int body_count,
                                                            const btContactSolverInfo& info) {
  if (in_turn_) {
    for (const std::size_t body : mechanism_.bodies())
      V_[body] = free_[body];
    for (std::size_t i = 0; i < touching_.size(); ++i) {
      V_[touching_[i]].v += pushes_[i].v;
      V_[touching_[i]].w += pushes_[i].w;
    }
    mechanism_.solve(V_);
    give_changes();
  }
  return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, body_count, info);
}

btSolverBody& ContactSolver::Rows::solver_body(std::size_t i) noexcept {
  return m_tmpSolverBodyPool[bullets_[i]->getCompanionId()];
}

/// Writes what contacts and the mechanism do to the touching bodies to Bullet's. Returns the square of the greatest change.
double ContactSolver::Rows::give_changes() noexcept {
  double most = 0;
  for (std::size_t i = 0; i < touching_.size(); ++i) {
    btSolverBody& body = solver_body(i);
    const Twist& change = mechanism_.change(touching_[i]);
    const Vec3 v = change.v + pushes_[i].v, w = change.w + pushes_[i].w;
    most = std::max({most, (v - from_bt(body.m_deltaLinearVelocity)).squaredNorm(),
                     (w - from_bt(body.m_deltaAngularVelocity)).squaredNorm()});
    body.m_deltaLinearVelocity = to_bt(v);
    body.m_deltaAngularVelocity = to_bt(w);
  }
  return most;
}

}  // namespace mechane::dynamics
