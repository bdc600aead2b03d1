// Our collisions against Bullet's own: the same boxes as btBoxShape in a plain btDiscreteDynamicsWorld.
#include <cmath>

#include <btBulletDynamicsCommon.h>

#include "tests/support/sanitizers.hpp"
#include "tests/unit/dynamics/blocks.hpp"

namespace mechane::dynamics::test {
namespace {

const Vec3 kHalf_m(0.05, 0.03, 0.04);
constexpr double kFriction = 0.35;

/// A box on a fixed box, all of it Bullet's.
class PlainBullet {
 public:
  PlainBullet(const state::BodyDescription& table, const state::BodyDescription& block) {
    world_.setGravity({0, -9.81, 0});
    table_ = add(table, kTableHalf_m, table_shape_, 1);  // Bullet multiplies the two
    block_ = add(block, kHalf_m, block_shape_, kFriction);
  }
  ~PlainBullet() {
    world_.removeRigidBody(block_.get());
    world_.removeRigidBody(table_.get());
  }
  PlainBullet(const PlainBullet&) = delete;
  PlainBullet& operator=(const PlainBullet&) = delete;

  btRigidBody& block() { return *block_; }
  void run(double seconds) {
    for (int n = static_cast<int>(std::lround(seconds / kStep)); n > 0; --n)
      world_.stepSimulation(kStep, 0);
  }

 private:
  std::unique_ptr<btRigidBody> add(const state::BodyDescription& from, const Vec3& half, btBoxShape& shape,
                                   double friction) {
    shape = btBoxShape({half.x(), half.y(), half.z()});
    shape.setMargin(1e-3);
    const double mass = from.fixed ? 0 : from.mass_kg;
    btVector3 inertia(0, 0, 0);
    if (!from.fixed) shape.calculateLocalInertia(mass, inertia);
    auto body = std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia);
    const Quat& q = from.X_WB.R;
    const Vec3& p = from.X_WB.p;
    body->setCenterOfMassTransform(btTransform({q.x(), q.y(), q.z(), q.w()}, {p.x(), p.y(), p.z()}));
    body->setFriction(friction);
    body->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(body.get());
    return body;
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btBoxShape table_shape_{{1, 1, 1}};
  btBoxShape block_shape_{{1, 1, 1}};
  std::unique_ptr<btRigidBody> table_;
  std::unique_ptr<btRigidBody> block_;
};

TEST(AgainstBulletsBoxes, ADroppedBlockRestsAtTheSameHeight) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("thousands of ticks");
  const auto fixed = table(0, kFriction);
  for (const Vec3& turn : {Vec3(0, 0.3, 0), Vec3(0.15, 0.3, 0.1), Vec3(kPi / 2, 0, 0.1)}) {
    const auto falling = block("BLOCK", kHalf_m, {{0.01, 0.1, 0.02}, quat_from_rotation_vector(turn)}, kFriction);
    PlainBullet theirs(fixed, falling);
    Scene ours(world_of({fixed, falling}));
    theirs.run(2);
    ours.run(2);
    EXPECT_NEAR(ours.at(1).X_WB.p.y(), theirs.block().getCenterOfMassPosition().y(), 5e-4) << turn.transpose();
  }
}

TEST(AgainstBulletsBoxes, APushedBlockSlidesAsFar) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("thousands of ticks");
  const auto fixed = table(0, kFriction);
  for (const double speed : {0.3, 0.7, 1.2}) {
    const auto sliding = block("BLOCK", kHalf_m, {{-0.2, kHalf_m.y(), 0}, Quat::Identity()}, kFriction);
    PlainBullet theirs(fixed, sliding);
    theirs.block().setLinearVelocity({speed, 0, 0});
    Scene ours(world_of({fixed, sliding}));
    ours.at(1).V_WB.v = Vec3(speed, 0, 0);
    theirs.run(1);
    ours.run(1);
    const double their_way = theirs.block().getCenterOfMassPosition().x() + 0.2;
    const double our_way = ours.at(1).X_WB.p.x() + 0.2;
    const double closed_form = speed * speed / (2 * kFriction * 9.81);
    EXPECT_NEAR(our_way, their_way, 0.02 * closed_form + 2e-4) << speed;
    EXPECT_NEAR(our_way, closed_form, 0.02 * closed_form + 2e-4) << speed;
    EXPECT_LT(ours.at(1).V_WB.v.norm(), 1e-3);
  }
}

}  // namespace
}  // namespace mechane::dynamics::test
