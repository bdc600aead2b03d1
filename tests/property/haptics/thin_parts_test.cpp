// A finger at up to 2 m/s cannot pass a thin part unfelt. The exact side is this file's own: a thin part is known by the sheet or the
// line in its middle, a finger by its gauge (1 on its surface, in proportion along rays), and the gauge is convex, so that its least
// value over the middle is found by ternary search.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/collision_build/object_builder.hpp"
#include "server/haptics/contact_patch.hpp"
#include "server/haptics/hand_model.hpp"
#include "tests/support/property_draw.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/shapes.hpp"

namespace mechane::haptics {
namespace {

using collision::Object;
using test::any_unit;
using test::between;

/// A thin part: the object that the product builds of it, and the middle between its sides: a rectangle, or a line where `low.x()` is
/// `high.x()`, in the plane z = 0.
struct ThinPart {
  std::string name;
  double thickness_m = 0;
  Eigen::Vector2d low, high;
  Object object;
};

Object built(const geometry::Mesh& mesh) {
  const geometry::NamedMesh part{"thin", mesh};
  auto object = collision_build::build_object({&part, 1}, {});
  EXPECT_TRUE(object.has_value()) << object.error().to_string();
  return *object;
}

geometry::Mesh blade(double back_m) {
  // The edge along y at x = 0, 0.04 mm wide.
  return test::hexahedron({Vec3(0, -0.06, -2e-5), Vec3(0.04, -0.06, -back_m / 2), Vec3(0.04, -0.06, back_m / 2),
                           Vec3(0, -0.06, 2e-5), Vec3(0, 0.06, -2e-5), Vec3(0.04, 0.06, -back_m / 2),
                           Vec3(0.04, 0.06, back_m / 2), Vec3(0, 0.06, 2e-5)});
}

/// Along y.
geometry::Mesh rod(double diameter_m) {
  geometry::Mesh mesh = test::cylinder(0.5 * diameter_m, 0.06, 12);
  for (Vec3& v : mesh.vertices)
    v = Vec3(v.x(), v.z(), -v.y());
  return mesh;
}

/// Each made once: plates from 0.2 to 4 mm, rods from 0.5 to 4 mm, two blades.
const ThinPart& any_thin_part(bool plates_only) {
  static const std::vector<ThinPart> parts = [] {
    std::vector<ThinPart> made;
    for (const double t : {0.0002, 0.0005, 0.001, 0.002, 0.004})
      made.push_back({"plate", t, {-0.05, -0.06}, {0.05, 0.06}, built(test::box({0.05, 0.06, t / 2}))});
    for (const double t : {0.0005, 0.001, 0.002, 0.004})
      made.push_back({"rod", t, {0, -0.06}, {0, 0.06}, built(rod(t))});
    for (const double t : {0.001, 0.003})
      made.push_back({"blade", t, {0, -0.06}, {0.04, 0.06}, built(blade(t))});
    return made;
  }();
  return parts[*rc::gen::inRange<std::size_t>(0, plates_only ? 5 : parts.size())];
}

/// The finger's shape by its own formula (paper, equation 1, to the power e1 / 2).
double gauge(const geometry::Superquadric& s, const Vec3& p) {
  const double across = std::pow(std::abs(p.x() / s.a.x()), 2 / s.e2) + std::pow(std::abs(p.y() / s.a.y()), 2 / s.e2);
  return std::pow(std::pow(across, s.e2 / s.e1) + std::pow(std::abs(p.z() / s.a.z()), 2 / s.e1), s.e1 / 2);
}

template <class F>
double least_over(double low, double high, const F& f) {
  for (int i = 0; i < 22 && low < high; ++i) {
    const double third = (high - low) / 3;
    if (f(low + third) < f(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return f(0.5 * (low + high));
}

/// One tick's place on the way of a segment of the hand through a part.
struct Passing {
  const ThinPart* part = nullptr;
  const Object* segment = nullptr;
  Quat R_WF;
  Vec3 target_W, way;
  double speed_m_per_s = 0;
  double phase = 0;

  [[nodiscard]] const geometry::Superquadric& shape() const { return segment->parts[0].superquadric; }
  [[nodiscard]] double radius_m() const { return shape().a.minCoeff(); }
  /// `ticks` before the centre reaches the target.
  [[nodiscard]] Pose X_WF(double ticks) const {
    return {target_W - (ticks - phase) * speed_m_per_s * kTickSeconds * way, R_WF};
  }
  [[nodiscard]] int ticks_outside() const { return static_cast<int>(0.12 / (speed_m_per_s * kTickSeconds)); }
  [[nodiscard]] bool may_overlap(const Pose& X_WF) const {
    const Vec3 near(std::clamp(X_WF.p.x(), part->low.x(), part->high.x()),
                    std::clamp(X_WF.p.y(), part->low.y(), part->high.y()), 0);
    return (near - X_WF.p).norm() < shape().a.norm() + part->thickness_m;
  }
  /// 1: the segment just touches the part's middle; 0: its centre lies on it.
  [[nodiscard]] double least_gauge(const Pose& X_WF) const {
    const Pose X_FT = X_WF.inverse();
    return least_over(part->low.x(), part->high.x(), [&](double x) {
      return least_over(part->low.y(), part->high.y(), [&](double y) { return gauge(shape(), X_FT * Vec3(x, y, 0)); });
    });
  }
  [[nodiscard]] std::vector<collision::PointContact> contacts(const Pose& X_WF) const {
    std::array<collision::PointContact, 64> storage;
    collision::ContactBuffer buffer(storage);
    collision::find_contacts(*segment, X_WF, part->object, {}, buffer);
    return {buffer.contacts().begin(), buffer.contacts().end()};
  }
};

/// Any segment of a hand of any size, or the tip of a one-point device, on any way through the part.
Passing any_passing(const ThinPart& part, bool with_palm) {
  static const HandModel hand = *HandModel::create({});
  hand::HandSample sample;
  sample.kind = *rc::gen::inRange(0, 4) == 0 ? hand::HandKind::one_point : hand::HandKind::glove;
  sample.hand_scale = HandModel::kScales[*rc::gen::inRange<std::size_t>(0, HandModel::kScales.size())];
  const std::size_t segments = hand::segment_count(sample.kind);
  const std::size_t first = !with_palm && segments > 1 ? 1 : 0;
  Passing passing;
  passing.part = &part;
  passing.segment = &hand.segment(sample, *rc::gen::inRange(first, segments));
  passing.R_WF = quat_from_rotation_vector(kPi * any_unit());
  passing.target_W = {*between(0.6 * part.low.x(), 0.6 * part.high.x()),
                      *between(0.6 * part.low.y(), 0.6 * part.high.y()), 0};
  passing.way = any_unit();
  passing.speed_m_per_s = *between(0.5, 2);
  passing.phase = *between(0, 1);
  return passing;
}

// How deep a finger may sink into the middle of a thin part before a sample finds it: samples lie 5 mm apart on the part, 3 to 4 mm
// on the hand. The worst of 24 000 passes: 2.7 mm.
constexpr double kUnfelt_m = 0.003;
// From this depth on the push leads back. In one place of a thousand it already leads through, by at most 0.7 mm in 24 000 passes.
constexpr double kFelt_m = 0.002;
constexpr double kMostThrough_m = 0.001;
// Once the centre is this near, the part is as close to the finger's far side, so that the push may lead through.
constexpr double kTurning = 0.6;

constexpr const char* kSlow = "it samples a thousand times what its neighbours sample";

RC_GTEST_PROP(ThinParts, AreFeltInEveryTickUntilTheFingersCentreHasPassed, ()) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER(kSlow);
  const Passing passing = any_passing(any_thin_part(false), true);
  int felt = 0;
  bool entered = false;
  for (int ticks = passing.ticks_outside(); ticks > 0; --ticks) {
    const Pose X_WF = passing.X_WF(ticks);
    if (!passing.may_overlap(X_WF)) {
      RC_ASSERT(passing.contacts(X_WF).empty());
      continue;
    }
    const auto contacts = passing.contacts(X_WF);
    felt += contacts.empty() ? 0 : 1;
    if (entered && !contacts.empty()) continue;  // the exact answer is slow, and would say nothing new
    const double depth_m = (1 - passing.least_gauge(X_WF)) * passing.radius_m();
    entered = entered || depth_m > 0;
    if (contacts.empty()) {
      RC_ASSERT(depth_m < kUnfelt_m);
    } else {
      // Half the thickness away from the middle the part ends: in air nothing is felt. A map may err by 1 mm, the builder's own aim.
      RC_ASSERT(depth_m > -0.5 * passing.part->thickness_m - 0.001);
    }
  }
  RC_ASSERT(felt >= 2);  // at 2 m/s the smallest finger's half is over in three ticks
}

/// The place on its way where the finger is so deep in the part's middle, before its centre has come there.
Pose at_depth(const Passing& passing, double depth_m) {
  double outside = passing.ticks_outside(), inside = 0;
  for (int i = 0; i < 24; ++i) {
    const double ticks = 0.5 * (outside + inside);
    (1 - passing.least_gauge(passing.X_WF(ticks)) < depth_m / passing.radius_m() ? outside : inside) = ticks;
  }
  return passing.X_WF(inside);
}

TEST(ThinParts, PushTheFingerBackTheWayThatItCame) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER(kSlow);
  int places = 0, back = 0;
  EXPECT_TRUE(rc::check([&] {
    const Passing passing = any_passing(any_thin_part(true), false);
    RC_PRE(std::abs(passing.way.z()) > 0.5);  // onto the face, and not along it
    const double most_m = (1 - kTurning) * passing.radius_m();
    RC_PRE(most_m > kFelt_m);
    const double depth_m = *between(kFelt_m, most_m);
    const Pose X_WF = at_depth(passing, depth_m);
    ContactPatches patches;
    std::vector<state::Contact> found;
    for (const auto& c : passing.contacts(X_WF))
      found.push_back({BodyId(0), 0, c.p_WC, c.n_BA_W, c.depth_m});
    gather_patches(found, patches);
    if (patches.size() == 0U && depth_m < kUnfelt_m) return;
    RC_ASSERT(patches.size() == 1U);
    const double through_m = patches[0].push_m.z() * std::copysign(1, passing.way.z());
    RC_ASSERT(through_m < kMostThrough_m);
    ++places;
    back += through_m < 0 ? 1 : 0;
  }));
  EXPECT_GT(places, 50);
  EXPECT_GT(back, 0.95 * places);
}

/// Without this the properties above could hold by samples that lie closer than the settings say.
TEST(ThinParts, AreSampledAsWideAsTheBuilderSays) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER(kSlow);
  const Object plate = built(test::box({0.05, 0.06, 0.0001}));
  std::size_t samples = 0;
  for (const auto& cluster : plate.clusters)
    samples += cluster.count;
  const double area_m2 = 4 * 0.05 * 0.06 * 2;
  EXPECT_GT(area_m2 / static_cast<double>(samples), 0.3 * 0.005 * 0.005);
}

}  // namespace
}  // namespace mechane::haptics
