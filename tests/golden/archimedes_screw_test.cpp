// The shipped exhibit, ten thousand ticks with a hand that grasps and turns: the same bits every time, on every machine of one kind.
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "server/app/scenario_store.hpp"
#include "server/state/world_state.hpp"
#include "server/world/step.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/golden_machine.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/source_folder.hpp"
#include "tests/support/visit_hand.hpp"

namespace mechane {
namespace {

constexpr std::uint64_t kTicks = 10'000;

const app::ScenarioStore& store() {
  static const app::ScenarioStore kStore = [] {
    app::Settings settings;
    settings.scenarios = {mechane::test::source_folder().string() + "/scenarios/archimedes-screw/archimedes-screw.x3d"};
    return app::ScenarioStore::load(settings).value();
  }();
  return kStore;
}

/// The activity 'use', begun by a command; the hand where the scenario's own visit reaches.
struct Play {
  std::unique_ptr<world::World> world;
  test::ScriptedHand hand;
};

Play make_play() {
  const auto hand = test::visit_hand(*store().first(), "use", 2 * kPi * 0.5);
  if (!hand) throw std::runtime_error("the scenario has no visit that reaches and turns in 'use'");
  return {world::World::create(store().first(), store().world_config()).value(), *hand};
}

std::uint64_t run(Play& play, std::uint64_t* allocations = nullptr) {
  SystemClock clock;
  world::PhaseTimer timer(clock);
  world::NoPublisher publisher;
  state::TickInputs start;
  start.commands[0] = {1, state::CommandKind::start_activity,
                       static_cast<std::uint32_t>(store().first()->find_activity("use").index())};
  start.command_count = 1;
  world::step(*play.world, start, publisher, timer);
  const test::AllocationGuard guard;
  for (std::uint64_t t = 0; t < kTicks; ++t) {
    state::TickInputs inputs;
    inputs.users[0] = play.hand.sample(t);
    world::step(*play.world, inputs, publisher, timer);
  }
  if (allocations != nullptr) *allocations = guard.allocations() + guard.frees();
  return state::state_hash(play.world->state);
}

TEST(ArchimedesScrew, TenThousandTicksGiveTheGoldenHash) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("ten thousand ticks, played twice");
  Play first = make_play();
  const std::uint64_t hash = run(first);
  Play second = make_play();
  EXPECT_EQ(run(second), hash) << "two runs in one process must agree";
  EXPECT_GT(first.world->state.joints[0].position, 2 * kPi) << "the visit must do something worth hashing";
  if (!test::gives_golden_bits()) GTEST_SKIP() << "the golden hash is of processors with FMA";
  std::ostringstream text;
  text << std::hex << hash;
  const std::string path = mechane::test::source_folder().string() + "/tests/golden/archimedes-screw.hash";
  if (std::getenv("MECHANE_ACCEPT_GOLDEN") != nullptr) std::ofstream(path) << text.str() << "\n";
  std::ifstream file(path);
  std::string golden;
  file >> golden;
  EXPECT_EQ(text.str(), golden)
      << "if the physics was meant to change, run this test once with MECHANE_ACCEPT_GOLDEN=1";
}

TEST(ArchimedesScrew, TenThousandTicksAllocateNothing) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("ten thousand ticks");
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  Play play = make_play();
  std::uint64_t allocations = 1;
  (void)run(play, &allocations);
  EXPECT_EQ(allocations, 0u);
}

}  // namespace
}  // namespace mechane
