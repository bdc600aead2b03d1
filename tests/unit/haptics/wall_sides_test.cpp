#include "server/haptics/wall_sides.hpp"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "server/collision_build/object_builder.hpp"
#include "tests/support/floor_server.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/touch.hpp"

namespace mechane::haptics {
namespace {

constexpr double kLedTip_m = 0.008;
constexpr double kPlateHalf_m = 0.05;  // of the plates

std::shared_ptr<const collision::Object> plate(double thickness_m) {
  return test::built(test::box(Vec3(kPlateHalf_m, 0.5 * thickness_m, kPlateHalf_m), Vec3(0, -0.5 * thickness_m, 0)));
}

/// The tip of a stylus that is led slowly along straight lines.
class Led {
 public:
  explicit Led(const std::shared_ptr<const collision::Object>& object, bool walls_hold = true)
      : server_(object, config(walls_hold)) {}

  /// Starts there, out of all contact.
  void begin(const Vec3& p_WT) { sample_.X_WH.p = p_WT; }
  /// Goes there in steps of 0.2 mm; see(force on the hand, contact or null) at each.
  template <class See>
  void go(const Vec3& to_W, const See& see) {
    const Vec3 way = to_W - sample_.X_WH.p, from = sample_.X_WH.p;
    const int steps = static_cast<int>(std::ceil(way.norm() / 2e-4));
    for (int i = 1; i <= steps; ++i) {
      sample_.X_WH.p = from + way * i / steps;
      const hand::HapticOutput& output = server_.answer(sample_);
      see(output.force_W.f, output.contact_count > 0 ? &output.contacts[0] : nullptr);
    }
  }
  void go(const Vec3& to_W) {
    go(to_W, [](const Vec3&, const hand::LocalContact*) {});
  }

 private:
  static ForceConfig config(bool walls_hold) {
    ForceConfig config;
    config.governor.passivity = false;
    config.thin_walls = walls_hold;
    return config;
  }
  test::FloorServer server_;
  hand::HandSample sample_;
};

/// How deep the tip gets from above before something pushes it down, or no longer up; of 40 mm.
double holds_to_m(double thickness_m, bool walls_hold) {
  Led tip(plate(thickness_m), walls_hold);
  tip.begin({0, 0.012, 0});
  double depth_m = kLedTip_m - 0.012, held_m = 0;
  bool holds = true;
  tip.go({0, -0.032, 0}, [&](const Vec3&, const hand::LocalContact* contact) {
    depth_m += 2e-4;
    if (depth_m < 2e-4) return;
    holds = holds && contact != nullptr && contact->n_W.y() > 0.99 && contact->depth_m > 0;
    if (holds) held_m = depth_m;
  });
  return held_m;
}

TEST(WallSides, ThinPlatesHoldATip) {
  for (const double thickness_m : {0.001, 0.002, 0.003, 0.006, 0.012}) {
    EXPECT_GT(holds_to_m(thickness_m, true), 0.0395) << thickness_m;
    EXPECT_LT(holds_to_m(thickness_m, false), 0.025) << thickness_m << ": what it was before, or this tests nothing";
  }
}

TEST(WallSides, ThePressGrowsEvenlyWithTheDepth) {
  Led tip(plate(0.003));
  tip.begin({0, kLedTip_m, 0});
  double before_m = 0;
  tip.go({0, kLedTip_m - 0.04, 0}, [&](const Vec3&, const hand::LocalContact* contact) {
    if (contact == nullptr) return;
    EXPECT_GE(contact->depth_m, before_m - 1e-5);
    EXPECT_LT(contact->depth_m, before_m + 3e-4) << "for 0.2 mm of the tip";
    before_m = contact->depth_m;
  });
  EXPECT_NEAR(before_m, 0.008, 1e-5) << "no more than this, however deep";
}

TEST(WallSides, ATipGoesAlongBehindTheWallAndIsFreeAtItsEnd) {
  Led tip(plate(0.003));
  tip.begin({0, 0.012, 0});
  tip.go({0, -0.02, 0});
  double held_to_m = 0;
  tip.go({kPlateHalf_m + 0.03, -0.02, 0}, [&](const Vec3&, const hand::LocalContact* contact) {
    if (contact == nullptr || contact->depth_m <= 0) return;
    EXPECT_GT(contact->n_W.y(), 0) << "it is never pushed down";
    held_to_m = contact->p_W.x();
  });
  EXPECT_GT(held_to_m, kPlateHalf_m - 2e-3);
  tip.go({0, -0.02, 0}, [&](const Vec3&, const hand::LocalContact* contact) {
    EXPECT_TRUE(contact == nullptr || contact->depth_m <= 0) << "under the plate";
  });
  tip.go({0, -0.004, 0}, [&](const Vec3&, const hand::LocalContact* contact) {
    EXPECT_TRUE(contact == nullptr || contact->n_W.y() < -0.99) << "it came from below";
  });
}

TEST(WallSides, InACornerBothWallsPush) {
  const Vec3 floor_m(0.1, 0.02, 0.05), wall_m(0.02, 0.05, 0.05);
  const std::array corner{geometry::NamedMesh{"floor", test::box(floor_m, Vec3(0, -floor_m.y(), 0))},
                          geometry::NamedMesh{"wall", test::box(wall_m, Vec3(wall_m.x(), wall_m.y(), 0))}};
  Led tip(std::make_shared<collision::Object>(collision_build::build_object(corner, {}).value()));
  tip.begin({-0.03, 0.012, 0});
  tip.go({-0.03, kLedTip_m - 0.005, 0});
  Vec3 push_m = Vec3::Zero();
  tip.go({-kLedTip_m + 0.006, kLedTip_m - 0.005, 0},
         [&](const Vec3&, const hand::LocalContact* contact) { push_m = contact->depth_m * contact->n_W; });
  EXPECT_NEAR(push_m.x(), -kPatchShare * 0.006, 1.8e-3);
  EXPECT_NEAR(push_m.y(), kPatchShare * 0.005, 1e-3);
}

/// As the tip sees it, nothing differs from a plate that lies still.
TEST(WallSides, APlateThatTurnsAndMovesHoldsATip) {
  test::FloorServer server(plate(0.003));
  hand::HandSample sample;
  for (int i = 0; i <= 100; ++i) {
    const Pose X_WB{Vec3(1, 0.002 * i, 0), Quat(Eigen::AngleAxisd(0.02 * i, Vec3(1, 2, 3).normalized()))};
    server.place(X_WB);
    sample.X_WH.p = X_WB * Vec3(0.01, 0.010 - 3e-4 * i, 0);
    const hand::HapticOutput& output = server.answer(sample);
    if (i < 15) continue;
    ASSERT_GT(output.contact_count, 0u) << i;
    EXPECT_LT(test::degrees_between(output.contacts[0].n_W, X_WB.rotate(Vec3::UnitY())), 2) << i;
    EXPECT_NEAR(output.contacts[0].depth_m, std::min(0.008, kPatchShare * (3e-4 * i - 0.002)), 1e-3) << i;
  }
}

TEST(WallSides, AHandThatJumpedOrIsOfAnotherKindHasNoSide) {
  for (const bool jumps : {true, false}) {
    test::FloorServer server(plate(0.003));
    hand::HandSample sample;
    for (int i = 0; i <= 100; ++i) {
      sample.X_WH.p.y() = 0.010 - 3e-4 * i;
      server.answer(sample);
    }
    ASSERT_TRUE(server.user().touches(BodyId(0))) << "wholly behind the plate";
    if (jumps) {
      server.user().jumped = true;
    } else {
      server.user().sides[0].segment = 9;  // of a glove
    }
    EXPECT_EQ(server.answer(sample).force_W.f.y(), 0);
    EXPECT_FALSE(server.user().touches(BodyId(0)));
  }
}

/// It is led out the nearest way, as ever.
TEST(WallSides, ATipThatBeginsInsideHasNoSide) {
  test::FloorServer server(plate(0.02));
  hand::HandSample sample;
  for (int i = 0; i < 50; ++i) {
    sample.X_WH.p.y() = -0.010 - 2e-4 * i;
    server.answer(sample);
    EXPECT_EQ(server.user().side_count, 0u) << i;
  }
}

TEST(WallSides, ATipThatIsFarThroughIsLetGo) {
  Led tip(plate(0.003));
  tip.begin({0, 0.012, 0});
  tip.go({0, -0.06, 0});
  tip.go({0, -0.03, 0}, [&](const Vec3&, const hand::LocalContact* contact) {
    EXPECT_TRUE(contact == nullptr || contact->depth_m <= 0);
  });
}

/// From outside and from inside, across the seams of the staves.
TEST(WallSides, AThinBarrelHoldsATipAllAroundAndAcrossItsSeams) {
  constexpr double kInner_m = 0.050, kOuter_m = 0.053;
  const auto barrel = std::make_shared<collision::Object>(
      collision_build::build_object(test::barrel(8, kInner_m, kOuter_m, 0.05, 3), {}).value());
  const auto at = [](double angle, double from_axis_m) {
    return Vec3(from_axis_m * std::cos(angle), from_axis_m * std::sin(angle), 0);
  };
  for (const double side : {1.0, -1.0}) {
    Led tip(barrel);
    const double surface_m = side > 0 ? kOuter_m : kInner_m;
    tip.begin(at(0, surface_m + side * 0.010));
    tip.go(at(0, surface_m - side * 0.012));
    for (int i = 1; i <= 120; ++i) {
      const double angle = 0.02 * i;
      tip.go(at(angle, surface_m - side * 0.012), [&](const Vec3&, const hand::LocalContact* contact) {
        ASSERT_NE(contact, nullptr);
        EXPECT_GT(contact->depth_m, 0.0079);
        EXPECT_LT(test::degrees_between(contact->n_W, at(angle, side)), 7.5) << angle << " from side " << side;
      });
    }
  }
}

}  // namespace
}  // namespace mechane::haptics
