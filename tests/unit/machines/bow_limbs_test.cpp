// A bow's limbs and string: stiff, not stretched, and where the draw has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/machines/machine_bench.hpp"

namespace mechane::machines::test {
namespace {

const Vec3 kLimbTip(0, 0.6, 0), kLimbRoot(-0.15, 0.12, -0.08);

Vec3 to_side(const Vec3& p, double side) {
  return {p.x(), side * p.y(), p.z()};
}

/// A crossbow that draws along its stock's x, the string along y. The stock stands askew.
state::WorldDescription limbed_world() {
  state::WorldDescription world;
  const Pose X_WS{Vec3(1, 2, 3), Quat(Eigen::AngleAxisd(0.8, Vec3(1, 2, -1).normalized()))};
  const BodyId stock = add_body(world, "STOCK", 1, 1, true);
  world.bodies[stock.index()].X_WB = X_WS;
  const BodyId slider = add_body(world, "SLIDER", 2, 0.1);
  world.bodies[slider.index()].X_WB = X_WS;
  add_joint(world, "SLIDE", state::JointKind::slider, stock, slider);
  for (const auto& [name, p, side] : {std::tuple{"LIMB_A", kLimbRoot, 1}, std::tuple{"LIMB_B", kLimbRoot, -1},
                                      std::tuple{"STRING_A", kLimbTip, 1}, std::tuple{"STRING_B", kLimbTip, -1}})
    world.bodies[add_body(world, name, 1, 0.1).index()].X_WB = X_WS * Pose{to_side(p, side), Quat::Identity()};
  add_quantity(world, "trigger");
  world.machines = {{"BOW",
                     "machine.bow",
                     {{"joint", text("SLIDE")},
                      {"fullForce", number(1000)},
                      {"drawLength", number(0.45)},
                      {"release", text("trigger")},
                      {"limbs", std::vector<std::string>{"LIMB_A", "LIMB_B"}},
                      {"strings", std::vector<std::string>{"STRING_A", "STRING_B"}}},
                     3}};
  return world;
}

/// A point that is fixed in a body, by where it was at the start; in the stock's frame.
Vec3 carried(Bench& bow, const std::string& body, const Vec3& p_S) {
  const Pose X_SW = bow.body("STOCK").X_WB.inverse();
  const Pose X_WB0 = bow.world.bodies[bow.world.find_body(body).index()].X_WB;
  return X_SW * (bow.body(body).X_WB * (X_WB0.inverse() * (X_SW.inverse() * p_S)));
}

RC_GTEST_PROP(BowLimbs, TipsHoldTheStringAndTheStringEndsInTheClaw, ()) {
  const double draw_m = 0.45 * *rc::gen::inRange(0, 1001) / 1000.0;
  Bench bow(limbed_world());
  bow.hold_at(0);
  bow.hold_at(draw_m);
  for (const auto& [limb, string, side] : {std::tuple{"LIMB_A", "STRING_A", 1}, std::tuple{"LIMB_B", "STRING_B", -1}}) {
    const Vec3 root = to_side(kLimbRoot, side), tip = to_side(kLimbTip, side);
    RC_ASSERT((carried(bow, limb, root) - root).norm() < 1e-9);
    RC_ASSERT((carried(bow, limb, tip) - carried(bow, string, tip)).norm() < 1e-9);
    RC_ASSERT((carried(bow, string, Vec3::Zero()) - Vec3(draw_m, 0, 0)).norm() < 1e-9);
    RC_ASSERT(carried(bow, limb, tip).x() >= -1e-9);
    RC_ASSERT(side * carried(bow, limb, tip).y() > 0.3);
  }
}

TEST(BowLimbs, LeapHomeAtTheShotAndACutStringIsGone) {
  Bench bow(limbed_world());
  bow.hold_at(0);
  bow.hold_at(0.4);
  EXPECT_GT(carried(bow, "LIMB_A", kLimbTip).x(), 0.05) << "bent";
  bow.quantity("trigger") = 1;
  bow.tick();
  EXPECT_LT((carried(bow, "LIMB_A", kLimbTip) - kLimbTip).norm(), 1e-9);
  EXPECT_TRUE(bow.body("STRING_A").visible);

  state::WorldDescription cut = limbed_world();
  cut.machines[0].parameters["strung"] = false;
  Bench bare(cut);
  bare.hold_at(0.4);
  EXPECT_FALSE(bare.body("STRING_A").visible);
  EXPECT_LT((carried(bare, "LIMB_A", kLimbTip) - kLimbTip).norm(), 1e-9);
}

TEST(BowLimbs, ErrorsSayWhatToWrite) {
  state::WorldDescription world = limbed_world();
  world.machines[0].parameters.erase("strings");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, world.machines[0].line, {"'strings'", "limbs"}));
  world = limbed_world();
  world.bodies[world.find_body("STRING_B").index()].X_WB.p += Vec3(0.1, 0.1, 0.2);
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("strings")));
  world = limbed_world();
  world.bodies[world.find_body("LIMB_A").index()].fixed = true;
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("limbs"), {"'LIMB_A'"}));
}

}  // namespace
}  // namespace mechane::machines::test
