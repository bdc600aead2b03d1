// Trains of couplings, drawn at random, never create energy.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/property_draw.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/unit/dynamics/coupled.hpp"

namespace mechane::dynamics::test {
namespace {

using mechane::test::between;

/// Each couples joint i to joint i + 1, or holds joint i + 1 against the world.
state::Coupling any_coupling(std::size_t i) {
  const double sign = *rc::gen::element(-1.0, 1.0);
  switch (*rc::gen::inRange(0, 5)) {
    case 0:
      return gear(i, i + 1, sign * *between(0.2, 5));
    case 1:
      return gear(i, i + 1, sign * *between(0.2, 5), *between(0.3, 0.95));
    case 2:
      return gear(i, i + 1, sign * *between(0.01, 0.2), 0.4);  // a worm
    case 3: {
      state::Coupling tooth = one_tooth(i, i + 1, sign * *between(0.02, 1), *between(0.1, 1.5));
      tooth.lock = *rc::gen::element(false, true);
      return tooth;
    }
    default:
      return stop(i + 1, 0, sign);
  }
}

RC_GTEST_PROP(Couplings, ATrainOfThemNeverCreatesEnergy, ()) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("thousands of ticks");
  const int count = *rc::gen::inRange(2, 6);
  std::vector<double> inertias;
  std::vector<state::Coupling> couplings;
  for (int i = 0; i < count; ++i) {
    inertias.push_back(std::pow(10, *between(-3, 0)));
    if (i > 0) couplings.push_back(any_coupling(static_cast<std::size_t>(i - 1)));
  }
  state::WorldDescription world = wheels(inertias);
  // A weight on a rope from the last wheel, over a sheave.
  add_weight(world, *between(0.5, 5), Vec3(static_cast<double>(count) + 2, -1, 0));
  const Scene at(world);
  state::Coupling over = rope(at,
                              {node(BodyId(static_cast<std::size_t>(count)), Vec3::Zero(), 0.1, -1),
                               node({}, Vec3(static_cast<double>(count) + 1, 3, 0), 0.1, -1, *between(0.7, 1)),
                               node(BodyId(static_cast<std::size_t>(count) + 1), Vec3::Zero())},
                              0);
  over.drum = true;
  over.joint1 = JointId(static_cast<std::size_t>(count) - 1);
  over.body1 = BodyId(0);
  std::array<Pose, state::kMaxRopeNodes> X_WN;
  X_WN[0] = world.bodies[static_cast<std::size_t>(count)].X_WB;
  X_WN[2] = world.bodies[static_cast<std::size_t>(count) + 1].X_WB;
  const state::RopePath path = state::measure_rope(over, X_WN, Quat::Identity());
  over.drum_start_1 = (path.p_out_W[0] - X_WN[0].p).normalized();
  over.offset = path.length_m + *between(0, 0.3);
  couplings.push_back(over);

  Coupled scene(world, couplings);
  for (int i = 1; i <= count; ++i)
    scene.at(static_cast<std::size_t>(i)).V_WB.w.z() = *between(-10, 10);
  for (std::size_t i = 0; i + 1 < couplings.size(); ++i) {
    state::Coupling& c = scene.coupling(i);
    if (c.kind == state::CouplingKind::intermittent) c.offset = state::intermittent_position(c, 0);
  }
  const double deepest = -world.bodies.back().mass_kg * 9.81 * 100;
  double last = energy_of(scene);
  for (int n = 0; n < 1500; ++n) {
    scene.run(kStep);
    const double now = energy_of(scene);
    if (now < deepest) break;
    RC_ASSERT(now <= last + 2e-3 * (std::abs(last) + 1));
    last = std::min(last, now);
  }
}

}  // namespace
}  // namespace mechane::dynamics::test
