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
    config.thin_walls = walls_hold ? ThinWalls::hold_hands : ThinWalls::let_through;
    return config;
  }
  test::FloorServer server_;
  hand::HandSample sample_;
};

/// How deep the tip gets from above before something pushes it down, or no longer up; of 40 mm.
double holds_to_m(const std::shared_ptr<const collision::Object>& plate, bool walls_hold) {
  Led tip(plate, walls_hold);
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
    const auto thin = plate(thickness_m);
    EXPECT_GT(holds_to_m(thin, true), 0.0395) << thickness_m;
    EXPECT_LT(holds_to_m(thin, false), 0.025) << thickness_m << ": what it was before, or this tests nothing";
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

/// Of two plates of 3 mm that meet at x = y = 0, with the open side towards -x and +y, turned by so much about z.
std::shared_ptr<const collision::Object> thin_corner(double lean_rad) {
  geometry::Mesh wall = test::box(Vec3(0.0015, 0.05, 0.05), Vec3(0.0015, 0.05, 0));
  for (Vec3& v : wall.vertices)
    v = Quat(Eigen::AngleAxisd(lean_rad, Vec3::UnitZ())) * v;
  return test::built(
      std::array{geometry::NamedMesh{"floor", test::box(Vec3(0.05, 0.0015, 0.05), Vec3(-0.05, -0.0015, 0))},
                 geometry::NamedMesh{"wall", wall}});
}

/// With the wall upright and leaning away from the floor; entered along the floor, along the wall and between them; in each the tip is then
/// led behind both walls, back along one, and again behind both.
TEST(WallSides, InACornerOfThinWallsBothHold) {
  constexpr double kBehind_m = 0.012;
  for (const double lean_deg : {0, -25}) {
    const double lean_rad = lean_deg * kPi / 180;
    const Vec3 n_W(-std::cos(lean_rad), -std::sin(lean_rad), 0);  // of the wall
    const auto at = [&](double floor_m, double wall_m) {          // so far in front of both
      const double y = floor_m;
      return Vec3((wall_m - y * n_W.y()) / n_W.x(), y, 0);
    };
    const auto corner = thin_corner(lean_rad);
    const Vec3 deep_W = at(kLedTip_m - kBehind_m, kLedTip_m - kBehind_m);
    for (const Vec3& start_W : {at(0.004, 0.04), at(0.04, 0.004), at(0.02, 0.0201)}) {
      Led tip(corner);
      tip.begin(at(0.04, 0.04));
      tip.go(start_W);
      const auto see_both = [&](const Vec3&, const hand::LocalContact* contact) {
        ASSERT_NE(contact, nullptr);
        EXPECT_GT(contact->n_W.y(), -0.02) << "never down through the floor";
        EXPECT_GT(contact->n_W.dot(n_W), -0.02) << "nor through the wall";
      };
      const auto expect_both = [&] {
        tip.go(deep_W, see_both);
        tip.go(deep_W + Vec3(0, 1e-4, 0), [&](const Vec3&, const hand::LocalContact* contact) {
          ASSERT_NE(contact, nullptr);
          EXPECT_NEAR(contact->n_W.y(), contact->n_W.dot(n_W), 0.1) << lean_deg << " from " << start_W.transpose();
          EXPECT_GT(contact->depth_m, 0.0079);
        });
      };
      expect_both();
      tip.go(at(kLedTip_m - kBehind_m, 0.02), see_both);
      expect_both();
      tip.go(at(0.02, kLedTip_m - kBehind_m), see_both);
      expect_both();
    }
  }
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

/// A whole hand that comes down on a plate, rocks on it and moves its fingers, until its palm's middle is 6 mm below the surface.
TEST(WallSides, ThinPlatesHoldPalmAndTipsOfARockingHand) {
  constexpr int kTicks = 400;
  constexpr double kPalmHalf_m = 0.014, kBends = 0.12;
  const auto board = test::built(test::box(Vec3(0.2, 0.0015, 0.2), Vec3(0, -0.0015, 0)));
  for (const Vec3& rocks_W : {Vec3(0, 0, 0), Vec3(0.12, 0, 0.03), Vec3(-0.04, 0.3, 0.1)}) {
    test::FloorServer server(board);
    hand::HandSample sample;
    sample.kind = hand::HandKind::glove;
    for (int i = 0; i <= kTicks; ++i) {
      const double sway = std::sin(2 * kPi * 1.5 * i / kTicks);
      for (std::size_t f = 0; f < hand::kFingers; ++f)
        test::close_finger(sample, f, kBends * std::abs(sway));
      sample.X_WH.R =
          Quat(Eigen::AngleAxisd(rocks_W.norm() * sway, rocks_W.isZero() ? Vec3::UnitX() : rocks_W.normalized()));
      sample.X_WH.p = Vec3(0, 0.08 - 0.086 * i / kTicks, 0) - sample.X_WH.rotate(Vec3(0.05, 0, 0));
      const hand::HapticOutput& output = server.answer(sample);
      EXPECT_GE(output.force_W.f.y(), -1e-6);
      if (server.user().X_WS[0].p.y() > kPalmHalf_m - 1e-3) continue;
      ASSERT_TRUE(has_side(server.user(), 0, BodyId(0))) << i << " about " << rocks_W.transpose();
      EXPECT_GT(output.force_W.f.y(), 0.1);
    }
    for (std::size_t f = 1; f < hand::kFingers; ++f) {
      EXPECT_TRUE(has_side(server.user(), hand::first_segment(f) + hand::kPhalanges - 1, BodyId(0)))
          << "finger " << f << " about " << rocks_W.transpose();
    }
  }
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
