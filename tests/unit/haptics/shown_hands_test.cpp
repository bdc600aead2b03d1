#include "server/haptics/shown_hands.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/floor_server.hpp"
#include "tests/support/property_draw.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/touch.hpp"

namespace mechane::haptics {
namespace {

constexpr double kShownTip_m = 0.008;
constexpr int kPicture = 16;  // ticks

/// A stylus above a plate, seen by somebody.
class Seen {
 public:
  Seen() : server_(shared_plate()) {}
  /// One tick with the tip's middle there; every 16th makes a picture.
  void go(const Vec3& p_WT) {
    sample_.X_WH.p = p_WT;
    server_.answer(sample_);
    if (++ticks_ % kPicture == 0) shown_.follow(*test::shared_hand(), server_.state());
  }
  [[nodiscard]] bool picture() const { return ticks_ % kPicture == 0; }
  [[nodiscard]] const Vec3& out_W() const { return shown_.out_W()[0]; }
  [[nodiscard]] Vec3 p_WT() const { return sample_.X_WH.p + out_W(); }
  [[nodiscard]] state::UserState& user() { return server_.user(); }
  [[nodiscard]] hand::HandSample& sample() { return sample_; }

 private:
  static const std::shared_ptr<const collision::Object>& shared_plate() {
    static const auto kPlate = test::built(test::box(Vec3(0.06, 0.0015, 0.06), Vec3(0, -0.0015, 0)));
    return kPlate;
  }
  test::FloorServer server_;
  ShownHands shown_;
  hand::HandSample sample_;
  int ticks_ = 0;
};

/// As fast as a plate of 3 mm can hold it (faster, it is past the middle before it is first felt), and until walls let go.
RC_GTEST_PROP(ShownHands, APressedTipIsSeenOnTheSurface, ()) {
  const double speed_m_per_s = *test::between(0.2, 1), deep_m = *test::between(0.001, 0.045);
  const double slant = *test::between(-0.5, 0.5);
  Seen tip;
  double y_m = kShownTip_m + 0.01;
  for (int i = 0; i < 160; ++i) {
    y_m = std::max(y_m - 1e-3 * speed_m_per_s, kShownTip_m - deep_m);
    tip.go({slant * (kShownTip_m - y_m), y_m, 0});
    if (!tip.picture()) continue;
    RC_ASSERT(tip.p_WT().y() > kShownTip_m - 1e-3);
    RC_ASSERT(tip.p_WT().y() < std::max(y_m, kShownTip_m) + 1e-3);
  }
}

/// Through contacts that come and go, and after walls have let go.
RC_GTEST_PROP(ShownHands, WhatIsSeenNeverJumps, ()) {
  constexpr int kStroke = 60;  // ticks
  Seen tip;
  Vec3 from_W(0, 0.03, 0), to_W = from_W, pictured_W = from_W, out_W = Vec3::Zero();
  for (int i = 0; i < 4 * kStroke; ++i) {
    if (i % kStroke == 0) {
      from_W = to_W;
      to_W = Vec3(*test::between(-0.08, 0.08), *test::between(-0.07, 0.03), *test::between(-0.02, 0.02));
    }
    const Vec3 p_WT = from_W + (to_W - from_W) * (i % kStroke + 1) / kStroke;
    tip.go(p_WT);
    if (!tip.picture()) continue;
    const double may_m = (p_WT - pictured_W).norm() + ShownHands::kCatchesUp_m_per_s * kPicture * kTickSeconds;
    RC_ASSERT((tip.out_W() - out_W).norm() <= may_m + 1e-9);
    pictured_W = p_WT;
    out_W = tip.out_W();
  }
}

TEST(ShownHands, FreeHandsAndThoseThatHoldAreShownWhereTheyAre) {
  Seen tip;
  for (int i = 0; i < 200; ++i) {
    tip.go({0, 0.02 + 1e-4 * i, 0});
    EXPECT_TRUE(tip.out_W().isZero(0));
  }
  for (int i = 0; i < 200; ++i)
    tip.go({0, 0.02 - 1e-4 * i, 0});
  EXPECT_GT(tip.out_W().y(), 0.007);
  tip.user().grasp.active = true;
  tip.user().grasp.body = BodyId(0);
  for (int i = 0; i < 200; ++i)
    tip.go({0, 0, 0});
  EXPECT_TRUE(tip.out_W().isZero(0));
}

TEST(ShownHands, AnotherVisitorsHandBeginsWhereItIs) {
  Seen tip;
  for (int i = 0; i < 320; ++i)
    tip.go({0, 0.02 - 1e-4 * i, 0});
  EXPECT_GT(tip.out_W().y(), 0.015);
  tip.user().sample.session = 7;
  for (int i = 0; i < kPicture; ++i)
    tip.go({0, 0.2, 0});
  EXPECT_TRUE(tip.out_W().isZero(0));
}

/// Pressed flat on the plate, a whole hand is seen on it.
TEST(ShownHands, AWholeHandIsSeenOnTheSurface) {
  constexpr double kPalmHalf_m = 0.014;
  Seen seen;
  seen.sample().kind = hand::HandKind::glove;
  for (int i = 0; i < 640; ++i)
    seen.go({-0.05, 0.045 - 1e-4 * i, 0});
  EXPECT_NEAR(seen.p_WT().y(), kPalmHalf_m, 1.5e-3);
}

}  // namespace
}  // namespace mechane::haptics
