#include "server/dynamics/body_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <set>
#include <string>

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletDynamics/ConstraintSolver/btContactSolverInfo.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "server/base/assert.hpp"
#include "server/dynamics/body_samples.hpp"
#include "server/dynamics/bullet_math.hpp"
#include "server/dynamics/pair_contacts.hpp"

namespace mechane::dynamics {
namespace {

constexpr double kSlop_m = 1e-4;            // bodies at rest overlap by this much: far more than the maps' noise
constexpr double kContactErrorShare = 0.2;  // of any further overlap, taken back in a step
constexpr double kMaxContactCorrection_m_per_s = 1.0;  // as a joint's
constexpr double kBounceFrom_m_per_s = 0.05;           // slower bodies do not bounce: gravity adds 0.01 in a tick
constexpr double kSlipsFrom_m_per_s = 1e-3;            // a faster contact has dynamic friction
constexpr double kStill_m_per_s = 2e-3;          // at the outermost point; the solver's own error is a tenth of it
constexpr std::size_t kMaxTouchingPerBody = 12;  // in one step; further ones are left out, in the order of the pairs
constexpr int kShapeType = CUSTOM_CONCAVE_SHAPE_TYPE;

Pose pose_of(const btTransform& X) {
  const btVector3& p = X.getOrigin();
  const btQuaternion q = X.getRotation();
  return {Vec3(p.x(), p.y(), p.z()), Quat(q.w(), q.x(), q.y(), q.z()).normalized()};
}

/// Our own kind of shape for Bullet: a collision object. The object's frame is the body's.
class ObjectShape final : public btCollisionShape {
 public:
  ObjectShape(const state::BodyDescription& from, std::shared_ptr<const collision::Object> object_in,
              const Pose& X_CB_in)
      : object(std::move(object_in)), X_CB(X_CB_in), material(from.haptic), restitution(from.restitution) {
    m_shapeType = kShapeType;
  }

  const std::shared_ptr<const collision::Object> object;
  const Pose X_CB;
  const state::HapticMaterial material;
  const double restitution;

  void getAabb(const btTransform& X_WC, btVector3& low, btVector3& high) const override {
    const btVector3 center = X_WC * to_bt(X_CB * object->bound_O.center);
    const btScalar r = object->bound_O.radius;
    low = center - btVector3(r, r, r);
    high = center + btVector3(r, r, r);
  }
  /// Of the bounding ball. Our bodies bring their own.
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override {
    const btScalar i = 0.4 * mass * object->bound_O.radius * object->bound_O.radius;
    inertia = {i, i, i};
  }
  void setLocalScaling(const btVector3& /*a map has its size*/) override {}
  [[nodiscard]] const btVector3& getLocalScaling() const override { return scale_; }
  void setMargin(btScalar /*the map is the surface itself*/) override {}
  [[nodiscard]] btScalar getMargin() const override { return 0; }
  [[nodiscard]] const char* getName() const override { return "MechaneObject"; }

 private:
  btVector3 scale_{1, 1, 1};
};

const ObjectShape& shape_of(const btCollisionObjectWrapper& wrap) {
  return static_cast<const ObjectShape&>(*wrap.getCollisionShape());
}

/// A coefficient of a pair of surfaces: the geometric mean of theirs.
double combined(double first, double second) {
  return std::sqrt(first * second);
}

Vec3 velocity_at(const btCollisionObject* object, const Vec3& p_W) {
  const btRigidBody& body = *btRigidBody::upcast(object);
  const btVector3 v = body.getVelocityInLocalPoint(to_bt(p_W) - body.getCenterOfMassPosition());
  return from_bt(v);
}

/// The algorithm of a pair of our shapes. Its manifold is made anew in each step, because a snapshot does not hold what it would
/// remember.
class ObjectAlgorithm final : public btCollisionAlgorithm {
 public:
  ObjectAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper& a,
                  const btCollisionObjectWrapper& b, PairContacts& contacts)
      : btCollisionAlgorithm(info),
        contacts_(contacts),
        manifold_(m_dispatcher->getNewManifold(a.getCollisionObject(), b.getCollisionObject())) {}
  ~ObjectAlgorithm() override { m_dispatcher->releaseManifold(manifold_); }

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                        const btDispatcherInfo& info, btManifoldResult* result) override {
    manifold_->clearManifold();
    result->setPersistentManifold(manifold_);
    const ObjectShape& shape_a = shape_of(*a);
    const ObjectShape& shape_b = shape_of(*b);
    const Pose X_WA = pose_of(a->getWorldTransform()) * shape_a.X_CB;
    const Pose X_WB = pose_of(b->getWorldTransform()) * shape_b.X_CB;
    for (const collision::PointContact& contact : contacts_.find(*shape_a.object, X_WA, *shape_b.object, X_WB))
      add(contact, *a, *b, info.m_timeStep);
  }
  btScalar calculateTimeOfImpact(btCollisionObject* /*a*/, btCollisionObject* /*b*/, const btDispatcherInfo& /*info*/,
                                 btManifoldResult* /*result*/) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override { manifolds.push_back(manifold_); }

 private:
  void add(const collision::PointContact& contact, const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
           double dt_s) {
    const ObjectShape& shape_a = shape_of(a);
    const ObjectShape& shape_b = shape_of(b);
    const double most_m = kSlop_m + kMaxContactCorrection_m_per_s * dt_s / kContactErrorShare;
    // One point for both bodies, half way between the surfaces: impulses at two different points would turn the pair.
    const Vec3 p_W = contact.p_WC - 0.5 * contact.depth_m * contact.n_BA_W;
    const btVector3 p = to_bt(p_W);
    btManifoldPoint point(a.getWorldTransform().invXform(p), b.getWorldTransform().invXform(p), to_bt(contact.n_BA_W),
                          -std::min(contact.depth_m, most_m));
    point.m_positionWorldOnA = p;
    point.m_positionWorldOnB = p;
    const Vec3 v_BA_W = velocity_at(a.getCollisionObject(), p_W) - velocity_at(b.getCollisionObject(), p_W);
    const Vec3 slip_W = v_BA_W - v_BA_W.dot(contact.n_BA_W) * contact.n_BA_W;
    const bool slips = slip_W.norm() > kSlipsFrom_m_per_s;
    const state::HapticMaterial& one = shape_a.material;
    const state::HapticMaterial& other = shape_b.material;
    point.m_combinedFriction = slips ? combined(one.dynamic_friction, other.dynamic_friction)
                                     : combined(one.static_friction, other.static_friction);
    point.m_combinedRestitution = combined(shape_a.restitution, shape_b.restitution);
    manifold_->addManifoldPoint(point);
  }

  PairContacts& contacts_;
  btPersistentManifold* manifold_;
};

struct CreateObjectAlgorithm final : btCollisionAlgorithmCreateFunc {
  explicit CreateObjectAlgorithm(PairContacts& contacts_in) : contacts(contacts_in) {}
  PairContacts& contacts;

  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* a,
                                                 const btCollisionObjectWrapper* b) override {
    void* place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(ObjectAlgorithm));
    return new (place) ObjectAlgorithm(info, *a, *b, contacts);
  }
};

btDefaultCollisionConstructionInfo sized_for(std::size_t pairs) {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = static_cast<int>(pairs);
  info.m_defaultMaxCollisionAlgorithmPoolSize = static_cast<int>(pairs);
  info.m_customCollisionAlgorithmMaxElementSize = sizeof(ObjectAlgorithm);
  return info;
}

using BodyPair = std::pair<std::size_t, std::size_t>;

BodyPair ordered(BodyId one, BodyId other) {
  return std::minmax({one.index(), other.index()});
}

/// The pairs of bodies that may ever meet, by index.
std::vector<BodyPair> pairs_that_meet(const state::WorldDescription& description) {
  std::set<BodyPair> apart;
  for (const state::JointDescription& joint : description.joints) {
    if (joint.body1 && joint.body2) apart.insert(ordered(joint.body1, joint.body2));
  }
  for (const state::Mates& mates : description.mates)
    apart.insert(ordered(mates.body1, mates.body2));
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < description.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < description.bodies.size(); ++j) {
      const state::BodyDescription& one = description.bodies[i];
      const state::BodyDescription& other = description.bodies[j];
      if (one.collides && other.collides && !(one.fixed && other.fixed) && !apart.contains({i, j}))
        pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

Expected<void> check_collider(const state::BodyDescription& body) {
  const std::string where = "body " + body.name;
  if (!body.object)
    return fail(ErrorCode::conflict, "the body collides with others, but has no shape to touch", where,
                "give it a shape that can be touched, or set collides to false");
  if (!(body.restitution >= 0 && body.restitution <= 1))
    return fail(ErrorCode::invalid_value, "the restitution is " + std::to_string(body.restitution), where,
                "give a number from 0 to 1");
  const bool rubs = std::isfinite(body.haptic.static_friction) && body.haptic.static_friction >= 0 &&
                    std::isfinite(body.haptic.dynamic_friction) && body.haptic.dynamic_friction >= 0;
  if (!rubs)
    return fail(ErrorCode::invalid_value, "the static or dynamic friction is negative or not a number", where,
                "give numbers of 0 or more");
  return {};
}

}  // namespace

struct BodyContacts::Impl {
  enum class Rest : std::uint8_t { free, rests, moves };
  struct Pair {
    std::size_t a;
    std::size_t b;
    btCollisionAlgorithm* algorithm;
  };

  explicit Impl(std::size_t pair_count)
      : configuration(sized_for(pair_count)), dispatcher(&configuration), create_algorithm(contacts) {
    dispatcher.registerCollisionCreateFunc(kShapeType, kShapeType, &create_algorithm);
  }
  ~Impl() {
    for (const Pair& pair : pairs) {
      pair.algorithm->~btCollisionAlgorithm();
      dispatcher.freeCollisionAlgorithm(pair.algorithm);
    }
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void add_pair(std::size_t a, std::size_t b);
  [[nodiscard]] btCollisionObjectWrapper wrap(std::size_t body) const;
  [[nodiscard]] bool is_still(std::size_t body) const noexcept;
  [[nodiscard]] bool may_touch(const Pair& pair, const state::WorldState& state) const noexcept;
  void note_held(const state::WorldState& state) noexcept;

  PairContacts contacts;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  CreateObjectAlgorithm create_algorithm;
  std::vector<btRigidBody*> bodies;                  // by index in the world; null: does not collide
  std::vector<std::unique_ptr<ObjectShape>> shapes;  // likewise
  std::vector<std::uint8_t> held;                    // likewise: in a hand, this step
  std::vector<Rest> rest;                            // likewise
  std::vector<Pair> pairs;
  std::size_t most_touching = 0;                // in one step
  std::vector<btPersistentManifold*> touching;  // has the capacity for these
  std::vector<const Pair*> touching_pairs;      // theirs
};

BodyContacts::BodyContacts(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
BodyContacts::~BodyContacts() = default;

Expected<std::unique_ptr<BodyContacts>> BodyContacts::create(const state::WorldDescription& description,
                                                             std::span<const Collider> bodies) {
  MECHANE_ASSERT(bodies.size() == description.bodies.size());
  std::size_t colliders = 0;
  for (const state::BodyDescription& body : description.bodies) {
    if (!body.collides) continue;
    if (const auto good = check_collider(body); !good) return tl::unexpected(good.error());
    ++colliders;
  }
  if (colliders > kMaxColliders)
    return fail(ErrorCode::too_large, std::to_string(colliders) + " bodies collide", "world " + description.id,
                "let at most " + std::to_string(kMaxColliders) + " of them collide");
  const std::vector<BodyPair> pairs = pairs_that_meet(description);
  if (pairs.empty()) return std::unique_ptr<BodyContacts>();

  auto impl = std::make_unique<Impl>(pairs.size());
  impl->bodies.resize(bodies.size(), nullptr);
  impl->shapes.resize(bodies.size());
  impl->held.resize(bodies.size(), 0);
  impl->rest.resize(bodies.size(), Impl::Rest::free);
  std::map<const collision::Object*, std::shared_ptr<const collision::Object>> thinned;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const state::BodyDescription& from = description.bodies[i];
    if (!from.collides) continue;
    auto& object = thinned[from.object.get()];
    if (object == nullptr) object = std::make_shared<const collision::Object>(with_fewer_samples(*from.object));
    impl->shapes[i] = std::make_unique<ObjectShape>(from, object, bodies[i].X_CB);
    impl->bodies[i] = bodies[i].bullet;
    impl->bodies[i]->setCollisionShape(impl->shapes[i].get());
  }
  for (const auto& [a, b] : pairs)
    impl->add_pair(a, b);
  impl->most_touching = std::min(pairs.size(), kMaxTouchingPerBody * colliders);
  impl->touching.reserve(impl->most_touching);
  impl->touching_pairs.reserve(impl->most_touching);
  return std::unique_ptr<BodyContacts>(new BodyContacts(std::move(impl)));
}

btCollisionObjectWrapper BodyContacts::Impl::wrap(std::size_t body) const {
  return {nullptr, shapes[body].get(), bodies[body], bodies[body]->getWorldTransform(), -1, -1};
}

void BodyContacts::Impl::add_pair(std::size_t a, std::size_t b) {
  const btCollisionObjectWrapper wrap_a = wrap(a);
  const btCollisionObjectWrapper wrap_b = wrap(b);
  pairs.push_back({a, b, dispatcher.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CONTACT_POINT_ALGORITHMS)});
}

void BodyContacts::Impl::note_held(const state::WorldState& state) noexcept {
  std::fill(held.begin(), held.end(), std::uint8_t{0});
  for (const state::UserState& user : state.users) {
    if (user.present && user.grasp.active && user.grasp.body) held[user.grasp.body.index()] = 1;
  }
}

bool BodyContacts::Impl::may_touch(const Pair& pair, const state::WorldState& state) const noexcept {
  const btRigidBody& a = *bodies[pair.a];
  const btRigidBody& b = *bodies[pair.b];
  if (a.getInvMass() == 0 && b.getInvMass() == 0) return false;
  if (held[pair.a] != 0 && held[pair.b] != 0) return false;
  if (!state.bodies[pair.a].visible || !state.bodies[pair.b].visible) return false;
  const geometry::Sphere& bound_a = shapes[pair.a]->object->bound_O;
  const geometry::Sphere& bound_b = shapes[pair.b]->object->bound_O;
  const double reach = bound_a.radius + bound_b.radius;
  const Vec3 between = state.bodies[pair.a].X_WB * bound_a.center - state.bodies[pair.b].X_WB * bound_b.center;
  return between.squaredNorm() <= reach * reach;
}

std::span<btPersistentManifold*> BodyContacts::find(const state::WorldState& state, double dt_s) noexcept {
  impl_->note_held(state);
  impl_->touching.clear();
  impl_->touching_pairs.clear();
  btDispatcherInfo info;
  info.m_timeStep = dt_s;
  for (const Impl::Pair& pair : impl_->pairs) {
    if (impl_->touching.size() == impl_->most_touching) break;
    if (!impl_->may_touch(pair, state)) continue;
    const btCollisionObjectWrapper a = impl_->wrap(pair.a);
    const btCollisionObjectWrapper b = impl_->wrap(pair.b);
    btManifoldResult result(&a, &b);
    pair.algorithm->processCollision(&a, &b, info, &result);
    if (result.getPersistentManifold()->getNumContacts() == 0) continue;
    impl_->touching.push_back(result.getPersistentManifold());
    impl_->touching_pairs.push_back(&pair);
  }
  return impl_->touching;
}

bool BodyContacts::Impl::is_still(std::size_t body) const noexcept {
  const ObjectShape& shape = *shapes[body];
  const geometry::Sphere& bound = shape.object->bound_O;
  const double reach_m = (shape.X_CB * bound.center).norm() + bound.radius;
  const btRigidBody& b = *bodies[body];
  return b.getLinearVelocity().length() + reach_m * b.getAngularVelocity().length() < kStill_m_per_s;
}

void BodyContacts::note_rest() noexcept {
  using Rest = Impl::Rest;
  std::fill(impl_->rest.begin(), impl_->rest.end(), Rest::free);
  for (const Impl::Pair* pair : impl_->touching_pairs) {
    const bool still = impl_->is_still(pair->a) && impl_->is_still(pair->b);
    for (const std::size_t body : {pair->a, pair->b}) {
      Rest& rest = impl_->rest[body];
      if (!still || rest == Rest::free) rest = still ? Rest::rests : Rest::moves;
    }
  }
}

bool BodyContacts::rests(std::size_t body) const noexcept {
  return impl_->rest[body] == Impl::Rest::rests;
}

std::span<btPersistentManifold*> BodyContacts::fill() {
  impl_->touching.clear();
  btManifoldArray manifolds;
  for (const Impl::Pair& pair : impl_->pairs) {
    if (impl_->touching.size() == impl_->most_touching) break;
    manifolds.clear();
    pair.algorithm->getAllContactManifolds(manifolds);
    btPersistentManifold* manifold = manifolds[0];
    manifold->clearManifold();
    for (std::size_t i = 0; i < kManifoldPoints; ++i) {
      btManifoldPoint point({0, 0, 0}, {0, 0, 0}, {0, 1, 0}, 0);
      point.m_combinedFriction = 1;
      manifold->addManifoldPoint(point);
    }
    impl_->touching.push_back(manifold);
  }
  return impl_->touching;
}

void set_contact_solver(btContactSolverInfo& info) {
  info.m_linearSlop = kSlop_m;
  info.m_erp2 = kContactErrorShare;
  info.m_splitImpulse = 1;  // bodies that overlap are moved apart without gaining speed
  info.m_splitImpulsePenetrationThreshold = 0;
  info.m_restitutionVelocityThreshold = kBounceFrom_m_per_s;
  info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
}

}  // namespace mechane::dynamics
