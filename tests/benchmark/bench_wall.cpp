// Bodies on bodies: a leaning wall of 30 blocks falls onto a plate, with our contacts and with Bullet's own, of meshes (GImpact) and of
// convex hulls. What a step takes, and how deep the blocks get into each other and into the plate.
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <CLI/CLI.hpp>
#include <btBulletDynamicsCommon.h>

#include "server/collision_build/object_builder.hpp"
#include "server/dynamics/dynamics_world.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include "tests/support/shapes.hpp"

namespace mechane::benchmark {
namespace {

constexpr double kStep_s = 1e-3;
constexpr int kRows = 6;
constexpr int kColumns = 5;
constexpr double kGap_m = 5e-4;     // between neighbours in a row
constexpr double kLean_rad = 0.25;  // far enough to fall
constexpr double kDensity_kg_per_m3 = 700;
constexpr double kFriction = 0.5;
constexpr double kMargin_m = 1e-3;  // of Bullet's shapes; its default of 40 mm is for things of metres
const Vec3 kHalf_m(0.05, 0.03, 0.025);
const Vec3 kPlateHalf_m(0.8, 0.05, 0.8);  // its top is at y = 0
const Pose kPlate_WB{Vec3(0, -kPlateHalf_m.y(), 0), Quat::Identity()};

double mass_kg() {
  return kDensity_kg_per_m3 * 8 * kHalf_m.prod();
}

/// A running bond; every other row stands half a block aside. It leans about the lower edge of its front.
std::vector<Pose> wall() {
  const Quat lean(Eigen::AngleAxisd(kLean_rad, Vec3::UnitX()));
  std::vector<Pose> X_WB;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double x_m =
          (2 * kHalf_m.x() + kGap_m) * (column - 0.5 * (kColumns - 1)) + (row % 2 == 0 ? 0 : kHalf_m.x());
      X_WB.push_back({lean * Vec3(x_m, (2 * row + 1) * kHalf_m.y(), -kHalf_m.z()), lean});
    }
  }
  return X_WB;
}

/// Along `axis`: half the width of a box.
double half_width_m(const Mat3& R, const Vec3& half_m, const Vec3& axis) {
  return (R.transpose() * axis).cwiseAbs().dot(half_m);
}

/// By how much two boxes overlap: the shortest way that parts them, along a normal of a face or across two edges. 0: they do not.
double overlap_m(const Pose& X_WA, const Vec3& a_m, const Pose& X_WB, const Vec3& b_m) {
  const Mat3 A = X_WA.R.toRotationMatrix();
  const Mat3 B = X_WB.R.toRotationMatrix();
  const Vec3 way = X_WB.p - X_WA.p;
  double least_m = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vec3& axis) {
    const double length = axis.norm();
    if (length < 1e-6) return;  // edges that are parallel
    const Vec3 n = axis / length;
    least_m = std::min(least_m, half_width_m(A, a_m, n) + half_width_m(B, b_m, n) - std::abs(way.dot(n)));
  };
  for (Eigen::Index i = 0; i < 3; ++i) {
    offer(A.col(i));
    offer(B.col(i));
    for (Eigen::Index j = 0; j < 3; ++j)
      offer(A.col(i).cross(B.col(j)));
  }
  return std::max(least_m, 0.0);
}

/// The deepest overlap of each pair that overlaps.
void add_overlaps(const std::vector<Pose>& blocks, std::vector<double>& overlaps_m) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto add = [&](const Pose& other, const Vec3& half_m) {
      if (const double by_m = overlap_m(blocks[i], kHalf_m, other, half_m); by_m > 0) overlaps_m.push_back(by_m);
    };
    add(kPlate_WB, kPlateHalf_m);
    for (std::size_t k = 0; k < i; ++k)
      add(blocks[k], kHalf_m);
  }
}

/// Something that lets the wall fall.
class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;
  virtual void step() = 0;
  [[nodiscard]] virtual std::vector<Pose> blocks() const = 0;
};

state::BodyDescription described(const std::string& name, const Pose& X_WB,
                                 std::shared_ptr<const collision::Object> object) {
  state::BodyDescription body;
  body.name = name;
  body.mass_kg = mass_kg();
  const Vec3 square = kHalf_m.cwiseProduct(kHalf_m);
  body.inertia_kg_m2 = (mass_kg() / 3 * (Vec3::Constant(square.sum()) - square)).asDiagonal();
  body.linear_damping = body.angular_damping = 0;
  body.X_WB = X_WB;
  body.object = std::move(object);
  body.collides = true;
  body.haptic.static_friction = body.haptic.dynamic_friction = kFriction;
  return body;
}

Expected<std::shared_ptr<const collision::Object>> built_box(const Vec3& half_m) {
  const std::vector<geometry::NamedMesh> parts{{"box", test::box(half_m)}};
  auto object = collision_build::build_object(parts, {});
  if (!object) return tl::unexpected(object.error());
  return std::make_shared<const collision::Object>(std::move(*object));
}

class Ours : public Method {
 public:
  static Expected<std::unique_ptr<Method>> create() {
    const auto plate = built_box(kPlateHalf_m);
    if (!plate) return tl::unexpected(plate.error());
    const auto block = built_box(kHalf_m);
    if (!block) return tl::unexpected(block.error());
    state::WorldDescription description;
    description.bodies.push_back(described("PLATE", kPlate_WB, *plate));
    description.bodies.back().fixed = true;
    for (const Pose& X_WB : wall())
      description.bodies.push_back(described("BLOCK" + std::to_string(description.bodies.size()), X_WB, *block));
    auto state = std::make_unique<state::WorldState>(description);
    auto world = dynamics::DynamicsWorld::create(description, *state);
    if (!world) return tl::unexpected(world.error());
    return std::unique_ptr<Method>(new Ours(std::move(state), std::move(*world)));
  }
  void step() override { world_->step(*state_, kStep_s); }
  [[nodiscard]] std::vector<Pose> blocks() const override {
    std::vector<Pose> X_WB;
    for (std::size_t i = 1; i < state_->bodies.size(); ++i)
      X_WB.push_back(state_->bodies[i].X_WB);
    return X_WB;
  }

 private:
  Ours(std::unique_ptr<state::WorldState> state, std::unique_ptr<dynamics::DynamicsWorld> world)
      : state_(std::move(state)), world_(std::move(world)) {}
  std::unique_ptr<state::WorldState> state_;
  std::unique_ptr<dynamics::DynamicsWorld> world_;
};

btVector3 to_bullet(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// Bullet's world as it comes, with its own shapes of the blocks.
class Bullet : public Method {
 public:
  Bullet(const std::vector<Pose>& wall, bool meshes) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
    world_.setGravity({0, -9.81, 0});
    plate_shape_.setMargin(kMargin_m);
    add(kPlate_WB, 0, plate_shape_, {0, 0, 0});
    make_shape(meshes);
    btVector3 inertia;
    btBoxShape(to_bullet(kHalf_m)).calculateLocalInertia(mass_kg(), inertia);
    for (const Pose& X_WB : wall)
      add(X_WB, mass_kg(), *shape_, inertia);
  }
  ~Bullet() override {
    for (const auto& body : bodies_)
      world_.removeRigidBody(body.get());
  }
  void step() override { world_.stepSimulation(kStep_s, 0); }
  [[nodiscard]] std::vector<Pose> blocks() const override {
    std::vector<Pose> X_WB;
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
      const btTransform& at = bodies_[i]->getCenterOfMassTransform();
      const btQuaternion q = at.getRotation();
      const btVector3& p = at.getOrigin();
      X_WB.push_back({{p.x(), p.y(), p.z()}, Quat(q.w(), q.x(), q.y(), q.z())});
    }
    return X_WB;
  }

 private:
  /// A margin lies around a mesh, so that its triangles stand by so much further in; a hull's lies within.
  void make_shape(bool meshes) {
    const geometry::Mesh box = test::box(kHalf_m - Vec3::Constant(kMargin_m));
    if (meshes) {
      for (const auto& t : box.triangles)
        triangles_.addTriangle(to_bullet(box.vertices[t[0]]), to_bullet(box.vertices[t[1]]),
                               to_bullet(box.vertices[t[2]]));
      auto shape = std::make_unique<btGImpactMeshShape>(&triangles_);
      shape->setMargin(kMargin_m);
      shape->updateBound();
      shape_ = std::move(shape);
      return;
    }
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& v : box.vertices)
      hull->addPoint(to_bullet(v));
    hull->setMargin(kMargin_m);
    shape_ = std::move(hull);
  }

  void add(const Pose& X_WB, double mass, btCollisionShape& shape, const btVector3& inertia) {
    auto body = std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia);
    const Quat& q = X_WB.R;
    body->setCenterOfMassTransform(btTransform({q.x(), q.y(), q.z(), q.w()}, to_bullet(X_WB.p)));
    body->setFriction(std::sqrt(kFriction));  // Bullet multiplies the two
    world_.addRigidBody(body.get());
    bodies_.push_back(std::move(body));
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btBoxShape plate_shape_{to_bullet(kPlateHalf_m)};
  btTriangleMesh triangles_;
  std::unique_ptr<btCollisionShape> shape_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

Duration cpu_now() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

/// Returns the median of a step, microseconds.
double measure(const std::string& name, Method& method, std::size_t steps, Report& report) {
  constexpr std::size_t kEach = 10;  // steps
  Samples took(steps);
  std::vector<double> overlaps_m;
  for (std::size_t i = 1; i <= steps; ++i) {
    const Duration start = cpu_now();
    method.step();
    took.add(cpu_now() - start);
    if (i % kEach == 0) add_overlaps(method.blocks(), overlaps_m);
  }
  report.distribution("wall_step_us." + name, took);
  std::sort(overlaps_m.begin(), overlaps_m.end());
  const std::string place = "wall." + name + ".";
  report.metric(place + "overlaps", static_cast<double>(overlaps_m.size()));
  if (!overlaps_m.empty()) {
    report.metric(place + "overlap_mm.median", 1e3 * overlaps_m[overlaps_m.size() / 2]);
    report.metric(place + "overlap_mm.p99", 1e3 * overlaps_m[overlaps_m.size() * 99 / 100]);
    report.metric(place + "overlap_mm.max", 1e3 * overlaps_m.back());
  }
  double highest_m = 0;  // of a block's middle, in the end: where one leans on another, it is above the half height
  for (const Pose& X_WB : method.blocks())
    highest_m = std::max(highest_m, X_WB.p.y());
  report.metric(place + "highest_mm", 1e3 * highest_m);
  return took.quantile_us(0.5);
}

Expected<void> run(std::size_t steps, Report& report) {
  auto ours = Ours::create();
  if (!ours) return tl::unexpected(ours.error());
  Bullet gimpact(wall(), true);
  Bullet hulls(wall(), false);
  const double ours_us = measure("ours", **ours, steps, report);
  report.metric("ratio_wall.gimpact", measure("gimpact", gimpact, steps, report) / ours_us);
  report.metric("ratio_wall.hulls", measure("hulls", hulls, steps, report) / ours_us);
  return {};
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  std::size_t steps = 2000;
  CLI::App app{"A falling wall of 30 blocks: our contacts between bodies, and Bullet's"};
  app.add_option("--steps", steps, "of 1 ms")->check(CLI::Range(10, 1'000'000));
  CLI11_PARSE(app, argc, argv);
  mechane::benchmark::Report report;
  if (const auto ok = mechane::benchmark::run(steps, report); !ok) {
    std::cerr << "bench_wall: " << ok.error().to_string() << "\n";
    return 2;
  }
  std::cout << report.text() << "\n";
  return 0;
}
