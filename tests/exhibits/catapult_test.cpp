// The stone-thrower, debugging
#include <gtest/gtest.h>
#include <cstdio>
#include <cstdlib>
#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

TEST(CatapultDebug, Trace) {
  const test::Exhibit exhibit("catapult");
  const state::WorldDescription& world = exhibit.description();
  test::PlayOptions options;
  int n = 0;
  const char* every = std::getenv("EVERY");
  const int each = every ? std::atoi(every) : 500;
  const auto q = [&](const state::WorldState& s, const char* name) { return s.quantities[world.find_quantity(name).index()]; };
  const auto b = [&](const state::WorldState& s, const char* name) { return s[world.find_body(name)].X_WB.p; };
  options.watch = [&](const state::WorldState& s) {
    const bool fine = q(s, "shots") > 0.5 && q(s, "flight") < 0.3 && n % 20 == 0;
    if (n++ % each && !fine) return;
    const Vec3 stone = b(s, "STONE"), nock = b(s, "STRING_R"), nl = b(s, "STRING_L"), sl = b(s, "SLIDER");
    std::printf("%6d drawn %.4f turns %.3f ang %.3f/%.3f tq %.0f E %.0f T %.0f pawl %.1f held %.0f carr %.0f pull %.0f latch %.3f fired %.0f | stone %.3f %.3f %.3f | nock-claw %.4f nocks %.4f | v %.2f top %.2f %.2f %.2f w32z %.2f\n",
                n, q(s, "drawn"), q(s, "turns"), s[world.find_joint("TURN_R")].position, s[world.find_joint("TURN_L")].position, q(s, "torque"), q(s, "energy"), q(s, "tension"), q(s, "pawl"),
                q(s, "held"), q(s, "carried"), q(s, "pulled"), s[world.find_joint("LATCH")].position, q(s, "fired"), stone.x(), stone.y(), stone.z(), (nock - sl - Vec3(0, 0.04, 0)).norm(),
                (nock - nl).norm(), q(s, "speed"), q(s, "top_left"), q(s, "top_middle"), q(s, "top_right"), b(s, "WALL_32").z());
  };
  const char* name = std::getenv("VISIT");
  const test::PlayedVisit visit = exhibit.play(name ? name : "shooting", options);
  std::ostringstream out;
  out << visit;
  std::printf("%s\ntick %.1f us\n", out.str().c_str(), visit.tick_us_median);
  for (const auto& body : world.bodies)
    if (body.name.rfind("WALL", 0) == 0) {}
}

}  // namespace
}  // namespace mechane
