// A small world for tests: a ball that floats in the first step and falls from the second on, and a stone the other way round.
#pragma once

#include <memory>

#include "server/state/description.hpp"

namespace mechane::test {

inline constexpr double kFloats_s = 0.2;
inline const Vec3 kBall_W(0, 2, 0), kStone_W(1, 2, 0);

/// Ball and stone are bodies 0 and 1; nothing slows them down. `by_step`: the steps say so; else the description says it once for all.
inline std::shared_ptr<state::WorldDescription> make_floating_ball(bool by_step = true) {
  auto world = std::make_shared<state::WorldDescription>();
  world->id = "floating-ball";
  world->content_hash = "test";
  state::BodyDescription ball;
  ball.name = "BALL";
  ball.mass_kg = 0.5;
  ball.linear_damping = ball.angular_damping = 0;
  ball.use_gravity = false;
  ball.X_WB.p = kBall_W;
  state::BodyDescription stone = ball;
  stone.name = "STONE";
  stone.use_gravity = true;
  stone.X_WB.p = kStone_W;
  world->bodies = {ball, stone};
  state::StepDescription floats, falls, rests;
  floats.name = "floats";
  falls.name = "falls";
  rests.name = "rests";
  floats.activity = falls.activity = rests.activity = ActivityId(0);
  floats.timeout_s = kFloats_s;
  floats.timeout_next = StepId(1);
  falls.timeout_s = 1;
  falls.timeout_next = StepId(2);
  if (by_step) {
    falls.bodies.resize(2);
    falls.bodies[0].body = BodyId(0);
    falls.bodies[0].use_gravity = true;
    falls.bodies[1].body = BodyId(1);
    falls.bodies[1].use_gravity = false;
  }
  world->steps = {floats, falls, rests};
  world->activities = {{.name = "watch", .first = StepId(0), .title = {}}};
  return world;
}

}  // namespace mechane::test
