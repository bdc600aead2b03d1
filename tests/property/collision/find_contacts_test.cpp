#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/base/random.hpp"
#include "server/collision/object.hpp"
#include "server/collision/samples.hpp"
#include "server/collision/superquadric_object.hpp"
#include "server/geometry/mesh_query.hpp"
#include "server/geometry/superquadric_mesh.hpp"
#include "tests/support/property_draw.hpp"

namespace mechane::collision {
namespace {

using test::any_unit;
using test::between;

struct Convex {
  geometry::Superquadric shape;
  Object object;
  geometry::MeshQuery exact;
};

/// Superquadrics of a hand's kind, with their exact meshes: a dozen, made once.
const Convex& any_convex() {
  static const std::vector<Convex> shapes = [] {
    std::vector<Convex> made;
    Random random(21);
    for (int i = 0; i < 12; ++i) {
      geometry::Superquadric s;
      s.a = Vec3(0.008 + 0.012 * random.unit(), 0.008 + 0.012 * random.unit(), 0.01 + 0.03 * random.unit());
      s.e1 = 0.4 + 0.8 * random.unit();
      s.e2 = 0.4 + 0.8 * random.unit();
      made.push_back({s, make_superquadric_object(s, 0.003), geometry::MeshQuery(geometry::tessellate(s, 48))});
    }
    return made;
  }();
  return shapes[*rc::gen::inRange<std::size_t>(0, shapes.size())];
}

struct Touch {
  Pose X_WA;
  Pose X_WB;
};

/// A touching B: A comes nearer to B until its deepest sample lies `depth_m` inside.
Touch any_touch(const Convex& a, const Convex& b, double depth_m) {
  Touch touch;
  touch.X_WB = {Vec3(*between(-1, 1), *between(-1, 1), *between(-1, 1)), quat_from_rotation_vector(3 * any_unit())};
  const Quat R_WA = quat_from_rotation_vector(3 * any_unit());
  const Vec3 direction = any_unit();
  const auto overlap_of = [&](double distance) {
    const Pose X_BA = touch.X_WB.inverse() * Pose{touch.X_WB.p + distance * direction, R_WA};
    double deepest = 0;
    for_each_sample(a.object, [&](const Cluster& cluster, std::size_t lane) {
      const Vec3 p_B = X_BA * cluster.sample_O(lane).cast<double>();
      if (geometry::inside_outside(b.shape, p_B) < 1) deepest = std::max(deepest, b.exact.closest(p_B).distance_m);
    });
    return deepest;
  };
  double inside = 0;
  double outside = 0.12;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (inside + outside);
    (overlap_of(middle) > depth_m ? inside : outside) = middle;
  }
  touch.X_WA = {touch.X_WB.p + inside * direction, R_WA};
  return touch;
}

std::vector<PointContact> contacts_of(const Object& a, const Pose& X_WA, const Object& b, const Pose& X_WB) {
  std::vector<PointContact> storage(4096);
  ContactBuffer buffer(storage);
  find_contacts(a, X_WA, b, X_WB, buffer);
  return {buffer.contacts().begin(), buffer.contacts().end()};
}

// Stated bound for shapes of a hand's size, at depths up to 4 mm: 0.35 mm. (The worst of twenty thousand cases: 0.301 mm.)
constexpr double kDepthBound_m = 0.00035;

RC_GTEST_PROP(FindContacts, DepthAndSideAgreeWithTheExactDistance, ()) {
  const Convex& a = any_convex();
  const Convex& b = any_convex();
  const Touch touch = any_touch(a, b, *between(0.0005, 0.004));
  const auto contacts = contacts_of(a.object, touch.X_WA, b.object, touch.X_WB);
  RC_ASSERT(!contacts.empty());
  for (const PointContact& c : contacts) {
    // The two ends of a contact: p on B's surface, and the point of A that reaches deepest below it.
    const Vec3 p_on_a = c.p_WC - c.depth_m * c.n_BA_W;
    const double from_b = b.exact.signed_distance(touch.X_WB.inverse() * c.p_WC);
    const double from_a = a.exact.signed_distance(touch.X_WA.inverse() * p_on_a);
    RC_ASSERT(std::abs(from_b) < kDepthBound_m);
    RC_ASSERT(std::abs(from_a) < kDepthBound_m);
    // One end is a sample, so its depth in the other object is exact, and ours must be near it.
    const double in_b = -b.exact.signed_distance(touch.X_WB.inverse() * p_on_a);
    const double in_a = -a.exact.signed_distance(touch.X_WA.inverse() * c.p_WC);
    RC_ASSERT(std::min(std::abs(c.depth_m - in_b), std::abs(c.depth_m - in_a)) < kDepthBound_m);
  }
}

RC_GTEST_PROP(FindContacts, TheNormalLeadsOutOfBOrBackwardsOutOfA, ()) {
  const Convex& a = any_convex();
  const Convex& b = any_convex();
  const Touch touch = any_touch(a, b, *between(0.0005, 0.004));
  const double step = 0.001;
  for (const PointContact& c : contacts_of(a.object, touch.X_WA, b.object, touch.X_WB)) {
    RC_ASSERT(c.depth_m > 0);
    RC_ASSERT(std::abs(c.n_BA_W.norm() - 1) < 1e-4);
    // From a convex surface a step along the normal leads away by nearly its whole length, one along any other way by less.
    const Vec3 p_on_a = c.p_WC - c.depth_m * c.n_BA_W;
    const double out_of_b = b.exact.signed_distance(touch.X_WB.inverse() * (c.p_WC + step * c.n_BA_W));
    const double out_of_a = a.exact.signed_distance(touch.X_WA.inverse() * (p_on_a - step * c.n_BA_W));
    RC_ASSERT(std::max(out_of_b, out_of_a) > 0.9 * step - 0.5 * kDepthBound_m);
  }
}

RC_GTEST_PROP(FindContacts, MovingAByTheDeepestContactLeavesLittleOverlap, ()) {
  const Convex& a = any_convex();
  const Convex& b = any_convex();
  const Touch touch = any_touch(a, b, *between(0.0005, 0.002));
  const auto contacts = contacts_of(a.object, touch.X_WA, b.object, touch.X_WB);
  RC_ASSERT(!contacts.empty());
  const auto deepest = *std::max_element(contacts.begin(), contacts.end(),
                                         [](const auto& l, const auto& r) { return l.depth_m < r.depth_m; });
  Pose moved = touch.X_WA;
  moved.p += deepest.depth_m * deepest.n_BA_W;
  double left = 0;
  for (const auto& c : contacts_of(a.object, moved, b.object, touch.X_WB))
    left = std::max(left, c.depth_m);
  RC_ASSERT(left < 0.5 * deepest.depth_m + kDepthBound_m);
}

}  // namespace
}  // namespace mechane::collision
