// A trial that begins at a step: agents and bodies are as the server's own rules have them there.
#include "client-sdk/studio/edits/begin_at.hpp"

#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/agents/progress.hpp"
#include "server/base/clock.hpp"
#include "server/scenario/compiler.hpp"
#include "server/scenario/file_finder.hpp"
#include "tests/support/source_files.hpp"
#include "tests/unit/studio/studio_fixture.hpp"

namespace mechane::studio {
namespace {

state::WorldDescription world_of(const std::string& text, const std::filesystem::path& file) {
  scenario::FileFinder finder;
  x3d::Problems problems(file.string());
  const auto document = x3d::read_document(text, file, problems);
  EXPECT_TRUE(document);
  auto world = scenario::compile(*document, finder, problems);
  EXPECT_TRUE(world) << world.error().to_string();
  return world.value_or(state::WorldDescription{});
}

/// The steps of an exhibit without its machines: nothing moves.
class Visit {
 public:
  explicit Visit(const state::WorldDescription& world) : world_(world), state_(world) {
    state::MemoryLayout layout;
    rules_ = *agents::ProgressRules::create(world, layout);
    rules_.remember_start(layout);
    state_.memory = layout.initial();
    rules_.start(state_);
  }
  /// Whether the visit comes to a step where each one's first trigger leads to the next.
  bool lead_to(ActivityId activity, StepId goal) {
    (void)rules_.run_command(state_,
                             {1, state::CommandKind::start_activity, static_cast<std::uint32_t>(activity.index())});
    for (std::size_t i = 0; i < world_.steps.size() && state_.progress.step != goal; ++i)
      (void)rules_.run_command(state_, {2, state::CommandKind::next_step});
    return state_.progress.step == goal && !state_.progress.done;
  }
  void tick() {
    ++state_.tick;
    rules_.run_triggers(state_, kTickSeconds);
  }
  [[nodiscard]] const state::WorldState& state() const { return state_; }
  [[nodiscard]] std::string step() const { return world_.steps[state_.progress.step.index()].name; }

 private:
  const state::WorldDescription& world_;
  state::WorldState state_;
  agents::ProgressRules rules_;
};

void expect_same(const state::WorldState& trial, const state::WorldState& visit, const std::string& where) {
  EXPECT_EQ(trial.agent_enabled, visit.agent_enabled) << where;
  ASSERT_EQ(trial.bodies.size(), visit.bodies.size());
  for (std::size_t i = 0; i < trial.bodies.size(); ++i) {
    const state::BodyState &a = trial.bodies[i], &b = visit.bodies[i];
    EXPECT_EQ(std::tuple(a.movable, a.visible, a.graspable, a.use_gravity),
              std::tuple(b.movable, b.visible, b.graspable, b.use_gravity))
        << where << i;
    EXPECT_LT((a.X_WB.p - b.X_WB.p).norm(), 1e-9) << where << i;
    EXPECT_LT(a.X_WB.R.angularDistance(b.X_WB.R), 1e-6) << where << i;
  }
}

TEST(BeginAt, EachStepOfEachShippedExhibitIsAsTheServerHasItThere) {
  std::size_t compared = 0;
  for (const std::string& name : shipped_exhibits()) {
    const auto file = test::source_folder() / "scenarios" / name / (name + ".x3d");
    const std::string text = test::text_of(file);
    const state::WorldDescription world = world_of(text, file);
    for (std::size_t i = 0; i < world.steps.size(); ++i) {
      const ActivityId activity = world.steps[i].activity;
      const std::string where = world.activities[activity.index()].name + "/" + world.steps[i].name;
      const auto begun = begin_at(text, file, world, where);
      ASSERT_TRUE(begun) << name << ", " << where << ": " << begun.error().to_string();
      const state::WorldDescription trial_world = world_of(*begun, file);
      Visit trial(trial_world);
      trial.tick();
      EXPECT_EQ(trial.step(), world.steps[i].name) << name;
      EXPECT_EQ(trial_world.activities.front().name, world.activities[activity.index()].name);
      Visit visit(world);
      if (!visit.lead_to(activity, StepId(i))) continue;
      expect_same(trial.state(), visit.state(), name + ", " + where + ", body ");
      ++compared;
    }
  }
  EXPECT_GT(compared, 40U);
}

TEST(BeginAt, WhatWasNotFirstIsAndNothingElseChanges) {
  const auto file = test::shipped_file();
  const std::string text = test::text_of(file);
  const state::WorldDescription world = world_of(text, file);
  const state::ActivityDescription& first = world.activities.front();
  EXPECT_EQ(*begin_at(text, file, world, first.name + "/" + world.steps[first.first.index()].name), text);
  for (const std::string& step : {std::string("nothing"), first.name, first.name + "/nothing", std::string("/")}) {
    const auto begun = begin_at(text, file, world, step);
    ASSERT_FALSE(begun) << step;
    EXPECT_THAT(begun.error(), is_fault(ErrorCode::unknown_name, {step})) << step;
  }
}

}  // namespace
}  // namespace mechane::studio
