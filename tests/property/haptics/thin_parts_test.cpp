// A finger at up to 2 m/s cannot pass a thin part unfelt. The exact side is this file's own: a thin part is known by the sheet or the
// line in its middle, a finger by its gauge (1 on its surface, in proportion along rays), and the gauge is convex, so that its least
// value over the middle is found by ternary search.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/collision/object_builder.hpp"
#include "server/haptics/contact_patch.hpp"
#include "server/haptics/hand_model.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"

namespace mechane::haptics {
namespace {

using collision::Object;

rc::Gen<double> thin_between(double low, double high) {
  return rc::gen::map(rc::gen::inRange(0, 1'000'001), [=](int i) { return low + (high - low) * i / 1e6; });
}

Vec3 thin_unit() {
  const double z = *thin_between(-1, 1);
  const double angle = *thin_between(-kPi, kPi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

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
  auto object = collision::build_object({&part, 1}, {});
  EXPECT_TRUE(object.has_value()) << object.error().to_string();
  return *object;
}

geometry::Mesh blade(double back_m) {
  // The edge along y at x = 0; z grows towards the back.
  return test::hexahedron({Vec3(0, -0.06, -2e-5), Vec3(0.04, -0.06, -back_m / 2), Vec3(0.04, -0.06, back_m / 2), Vec3(0, -0.06, 2e-5),
                           Vec3(0, 0.06, -2e-5), Vec3(0.04, 0.06, -back_m / 2), Vec3(0.04, 0.06, back_m / 2), Vec3(0, 0.06, 2e-5)});
}

geometry::Mesh rod(double diameter_m) {
  geometry::Mesh mesh = test::cylinder(0.5 * diameter_m, 0.06, 12);
  for (Vec3& v : mesh.vertices)
    v = Vec3(v.z(), v.x(), v.y());
  for (Vec3& v : mesh.vertices)
    v = Vec3(v.y(), v.x(), -v.z());  // along y
  return mesh;
}

const std::vector<ThinPart>& thin_parts() {
  static const std::vector<ThinPart> parts = [] {
    std::vector<ThinPart> made;
    for (const double mm : {0.2, 0.5, 1.0, 2.0, 4.0}) {
      const double t = 0.001 * mm;
      const std::string size = " of " + std::to_string(mm) + " mm";
      made.push_back({"plate" + size, t, {-0.05, -0.06}, {0.05, 0.06}, built(test::box({0.05, 0.06, t / 2}))});
      made.push_back({"rod" + size, t, {0, -0.06}, {0, 0.06}, built(rod(t))});
    }
    made.push_back({"blade", 0.001, {0, -0.06}, {0.04, 0.06}, built(blade(0.001))});
    made.push_back({"blade", 0.003, {0, -0.06}, {0.04, 0.06}, built(blade(0.003))});
    return made;
  }();
  return parts;
}

/// The finger's shape as its own formula (paper, equation 1, to the power e1 / 2).
double gauge(const geometry::Superquadric& s, const Vec3& p) {
  const double across =
      std::pow(std::abs(p.x() / s.a.x()), 2 / s.e2) + std::pow(std::abs(p.y() / s.a.y()), 2 / s.e2);
  return std::pow(std::pow(across, s.e2 / s.e1) + std::pow(std::abs(p.z() / s.a.z()), 2 / s.e1), s.e1 / 2);
}

template <class F>
double least_over(double low, double high, const F& f) {
  if (low == high) return f(low);
  for (int i = 0; i < 34; ++i) {
    const double third = (high - low) / 3;
    (f(low + third) < f(high - third) ? high : low) = f(low + third) < f(high - third) ? high - third : low + third;
  }
  return f(0.5 * (low + high));
}

/// 1: the finger just touches the part's middle; 0: its centre lies on it.
double least_gauge(const ThinPart& part, const geometry::Superquadric& finger, const Pose& X_FT) {
  return least_over(part.low.x(), part.high.x(), [&](double x) {
    return least_over(part.low.y(), part.high.y(), [&](double y) { return gauge(finger, X_FT * Vec3(x, y, 0)); });
  });
}

struct Stats {
  double blind = 0;      // deepest overlap without contact, m
  double turned = 0;     // farthest centre with a push the wrong way
  double turned_depth = 10;
  int fewest = 1000;
  double ghost = 0;
  int cases = 0, ticks = 0;
};

TEST(Explore, Thin) {
  auto hand = HandModel::create({});
  ASSERT_TRUE(hand.has_value());
  std::map<std::string, Stats> stats;
  srand(1);
  auto u = [](double a, double b) { return a + (b - a) * rand() / RAND_MAX; };
  auto unit = [&] { Vec3 v; do v = Vec3(u(-1, 1), u(-1, 1), u(-1, 1)); while (v.norm() > 1 || v.norm() < 0.1); return Vec3(v.normalized()); };
  for (const ThinPart& part : thin_parts()) {
    std::printf("%s %zu parts %s\n", part.name.c_str(), part.object.parts.size(), part.object.parts[0].map.name().c_str());
    for (int c = 0; c < 400; ++c) {
      state::HandSample sample;
      const bool tip = c % 4 == 0;
      sample.kind = tip ? state::HandKind::one_point : state::HandKind::glove;
      sample.hand_scale = HandModel::kScales[rand() % 5];
      const std::size_t seg = tip ? 0 : rand() % 16;
      const Object& finger = hand->segment(sample, seg);
      const auto& shape = finger.parts[0].superquadric;
      const std::string key = part.name + (tip ? " tip" : seg == 0 ? " palm" : " finger");
      Stats& s = stats[key];
      ++s.cases;
      const Quat R_WF = quat_from_rotation_vector(3 * unit());
      const Vec3 dir = unit();
      const double speed = u(0.05, 2);
      const Vec3 target(u(0.9 * part.low.x(), 0.9 * part.high.x()), u(0.6 * part.low.y(), 0.6 * part.high.y()), 0);
      const double r = shape.a.minCoeff();
      int contacts_seen = 0;
      for (double way = -0.08 - u(0, 1) * speed * 0.001; way < 0; way += speed * 0.001) {
        const Pose X_WF{target + way * dir, R_WF};
        if (!tip && seg == 0 && false) continue;
        const double g = least_gauge(part, shape, X_WF.inverse());
        std::array<collision::PointContact, 64> storage;
        collision::ContactBuffer buffer(storage);
        collision::find_contacts(finger, X_WF, part.object, {}, buffer);
        const double depth = (1 - g) * r;
        ++s.ticks;
        if (buffer.contacts().empty()) {
          s.blind = std::max(s.blind, depth);
          continue;
        }
        s.ghost = std::max(s.ghost, -depth);
        ++contacts_seen;
        Vec3 push = Vec3::Zero();
        for (const auto& k : buffer.contacts()) push += k.depth_m * k.depth_m * k.n_BA_W;
        Vec3 near(std::clamp(X_WF.p.x(), part.low.x(), part.high.x()), std::clamp(X_WF.p.y(), part.low.y(), part.high.y()), 0);
        const Vec3 away = X_WF.p - near;
        if (push.dot(away) <= 0) { s.turned = std::max(s.turned, away.norm() / r); s.turned_depth = std::min(s.turned_depth, depth / r); }
      }
      s.fewest = std::min(s.fewest, contacts_seen);
    }
  }
  for (auto& [k, s] : stats)
    std::printf("%-32s cases %3d ticks %5d blind %.2f mm  ghost %.2f mm turned at %.2f r from centre, least depth %.2f r fewest contact ticks %d\n", k.c_str(), s.cases, s.ticks, 1e3 * s.blind, 1e3 * s.ghost, s.turned, s.turned_depth, s.fewest);
}

}  // namespace
}  // namespace mechane::haptics
