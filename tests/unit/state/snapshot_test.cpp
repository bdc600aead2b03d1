#include "server/state/snapshot.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::state {
namespace {

WorldDescription two_bodies() {
  WorldDescription world;
  world.bodies.resize(2);
  world.joints.resize(1);
  world.agents.resize(3);
  world.quantities.resize(2);
  return world;
}

WorldState sample_state(double x) {
  WorldState state(two_bodies());
  state.tick = 42;
  state.bodies[1].X_WB.p = Vec3(x, 2, 3);
  state.joints[0].position = 4.5;
  state.memory = {1.0, x};
  state.users[2].present = true;
  state.users[2].grasp.active = true;
  state.users[2].grasp.body = BodyId(1);
  state.progress.step = StepId(3);
  state.users[2].age = Duration(12'345);
  state.governors[2].last.force_W.f = Vec3(0.5, x, 0);
  state.governors[2].credit_j = 0.25;
  state.governors[2].lifted_j = 0.125;
  state.governors[2].counts[4] = 7;
  return state;
}

WorldState empty_state() {
  WorldState state(two_bodies());
  state.memory = {0.0, 0.0};
  return state;
}

RC_GTEST_PROP(Snapshot, RoundTripGivesTheSameHash, ()) {
  const double x = *rc::gen::arbitrary<int>() * 1e-3;
  const WorldState written = sample_state(x);
  std::vector<std::byte> bytes;
  write_snapshot(written, bytes);
  WorldState read = empty_state();
  RC_ASSERT(read_snapshot(bytes, read).has_value());
  RC_ASSERT(state_hash(read) == state_hash(written));
}

RC_GTEST_PROP(Snapshot, AnyChangedByteIsFoundAndChangesNothing, ()) {
  std::vector<std::byte> bytes;
  write_snapshot(sample_state(1), bytes);
  const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
  const auto flip = *rc::gen::inRange(1, 256);
  bytes[at] ^= static_cast<std::byte>(flip);
  WorldState state = empty_state();
  const std::uint64_t before = state_hash(state);
  RC_ASSERT(!read_snapshot(bytes, state).has_value());
  RC_ASSERT(state_hash(state) == before);
}

TEST(Snapshot, ACutFileIsAnErrorThatSaysWhatToDo) {
  std::vector<std::byte> bytes;
  write_snapshot(sample_state(1), bytes);
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    WorldState state = empty_state();
    const auto read = read_snapshot(std::span(bytes).first(size), state);
    ASSERT_FALSE(read.has_value()) << size;
    EXPECT_EQ(read.error().code, ErrorCode::damaged);
    EXPECT_FALSE(read.error().remedy.empty());
  }
}

TEST(Snapshot, TellsAnotherVersionFromDamage) {
  std::vector<std::byte> bytes;
  write_snapshot(sample_state(1), bytes);
  const auto code_after = [&](std::size_t at, int value) {
    std::vector<std::byte> changed = bytes;
    changed[at] = static_cast<std::byte>(value);
    WorldState state = empty_state();
    const auto read = read_snapshot(changed, state);
    EXPECT_FALSE(read.has_value());
    return read ? ErrorCode{} : read.error().code;
  };
  EXPECT_EQ(code_after(0, 'X'), ErrorCode::damaged);
  EXPECT_EQ(code_after(8, 99), ErrorCode::wrong_version);
  EXPECT_EQ(code_after(bytes.size() - 1, 77), ErrorCode::damaged);
}

TEST(Snapshot, AnotherScenariosSnapshotIsRefused) {
  std::vector<std::byte> bytes;
  write_snapshot(sample_state(1), bytes);
  WorldDescription other = two_bodies();
  other.bodies.resize(5);
  WorldState state(other);
  const auto read = read_snapshot(bytes, state);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().code, ErrorCode::conflict);
}

TEST(StateHash, SeesEveryTable) {
  const WorldState base = sample_state(1);
  const std::uint64_t hash = state_hash(base);
  WorldState changed = base;
  changed.agent_enabled[2] = 1;
  EXPECT_NE(state_hash(changed), hash);
  changed = base;
  changed.bodies[0].V_WB.w.z() = 1e-300;
  EXPECT_NE(state_hash(changed), hash);
  changed = base;
  changed.progress.done = true;
  EXPECT_NE(state_hash(changed), hash);
  changed = base;
  changed.memory[0] = -changed.memory[0];
  EXPECT_NE(state_hash(changed), hash);
  changed = base;
  changed.users[3].age = Duration(1);
  EXPECT_NE(state_hash(changed), hash);
}

TEST(StateHash, SeesAllThatAGovernorRemembers) {
  const WorldState base = sample_state(1);
  const std::uint64_t hash = state_hash(base);
  const auto differs = [&](auto change) {
    WorldState changed = base;
    change(changed.governors[1]);
    return state_hash(changed) != hash;
  };
  EXPECT_TRUE(differs([](hand::GovernorState& g) { g.last.force_W.f.x() = 1e-300; }));
  EXPECT_TRUE(differs([](hand::GovernorState& g) { g.last.force_W.t.z() = 1e-300; }));
  EXPECT_TRUE(differs([](hand::GovernorState& g) { g.last.finger_force_n[4] = 1e-300; }));
  EXPECT_TRUE(differs([](hand::GovernorState& g) { g.last.reasons = hand::kDamped; }));
  EXPECT_TRUE(differs([](hand::GovernorState& g) { g.ramp = 1e-300; }));
  EXPECT_TRUE(differs([](hand::GovernorState& g) { g.gain = 1e-300; }));
  EXPECT_TRUE(differs([](hand::GovernorState& g) { g.credit_j = 1e-300; }));
  EXPECT_TRUE(differs([](hand::GovernorState& g) { g.lifted_j = 1e-300; }));
  EXPECT_TRUE(differs([](hand::GovernorState& g) { g.counts[5] = 1; }));
}

/// Whether what `change` does to the second user shows.
template <class Change>
bool changes_hash(const WorldState& base, const Change& change) {
  WorldState changed = base;
  change(changed.users[1]);
  return state_hash(changed) != state_hash(base);
}

TEST(StateHash, SeesWhereFrictionHolds) {
  WorldState base = sample_state(1);
  base.users[1].anchor_count = 2;
  const auto differs = [&](auto change) { return changes_hash(base, change); };
  EXPECT_TRUE(differs([](UserState& user) { user.anchor_count = 1; }));
  EXPECT_TRUE(differs([](UserState& user) { user.anchors[1].body = BodyId(0); }));
  EXPECT_TRUE(differs([](UserState& user) { user.anchors[1].segment = 3; }));
  EXPECT_TRUE(differs([](UserState& user) { user.anchors[1].slides = true; }));
  EXPECT_TRUE(differs([](UserState& user) { user.anchors[1].p_SA.x() = 1e-300; }));
  EXPECT_TRUE(differs([](UserState& user) { user.anchors[1].p_BA.z() = 1e-300; }));
  EXPECT_FALSE(differs([](UserState& user) { user.anchors[2].slides = true; })) << "it is not one of the two";
  WorldState changed = base;
  changed.users[1].anchors[1].slides = true;
  EXPECT_EQ(state_hash(changed, StateVersion::with_governors), state_hash(base, StateVersion::with_governors));
}

TEST(StateHash, SeesTheSidesOfWalls) {
  WorldState base = sample_state(1);
  base.users[1].side_count = 2;
  const auto differs = [&](auto change) { return changes_hash(base, change); };
  EXPECT_TRUE(differs([](UserState& user) { user.side_count = 1; }));
  EXPECT_TRUE(differs([](UserState& user) { user.sides[1].body = BodyId(0); }));
  EXPECT_TRUE(differs([](UserState& user) { user.sides[1].segment = 3; }));
  EXPECT_TRUE(differs([](UserState& user) { user.sides[1].n_B.y() = 1e-300; }));
  EXPECT_TRUE(differs([](UserState& user) { user.sides[1].height_m = 1e-300; }));
  EXPECT_FALSE(differs([](UserState& user) { user.sides[2].height_m = 1; })) << "it is not one of the two";
  WorldState changed = base;
  changed.users[1].sides[1].height_m = 1;
  EXPECT_EQ(state_hash(changed, StateVersion::with_anchors), state_hash(base, StateVersion::with_anchors));
}

TEST(StateHash, SeesWhichHandItIsAndHowLongItsFingersAre) {
  const WorldState base = sample_state(1);
  EXPECT_TRUE(changes_hash(base, [](UserState& user) { user.sample.side = hand::HandSide::left; }));
  EXPECT_TRUE(changes_hash(base, [](UserState& user) { user.sample.finger_scale[4] = 1.01; }));
  WorldState changed = base;
  changed.users[1].sample.side = hand::HandSide::left;
  EXPECT_EQ(state_hash(changed, StateVersion::with_sides), state_hash(base, StateVersion::with_sides));
}

TEST(Snapshot, FromBeforeThereWereSidesHasRightHandsOfTheModelsLengths) {
  WorldState written = sample_state(1);
  written.users[2].sample.kind = hand::HandKind::glove;
  std::vector<std::byte> bytes;
  write_snapshot(written, bytes, StateVersion::with_sides);
  WorldState read = empty_state();
  ASSERT_TRUE(read_snapshot(bytes, read));
  EXPECT_EQ(static_cast<const hand::HandBuild&>(read.users[2].sample), hand::HandBuild{});
}

/// As a damaged file may be, with a checksum that fits.
TEST(Snapshot, WithTouchesThatCannotBeIsRefused) {
  const auto is_read = [](auto change) {
    WorldState state = sample_state(1);
    change(state.users[0]);
    std::vector<std::byte> bytes;
    write_snapshot(state, bytes);
    WorldState read = sample_state(2);
    return read_snapshot(bytes, read).has_value();
  };
  EXPECT_FALSE(is_read([](UserState& user) { user.sample.side = static_cast<hand::HandSide>(2); }));
  EXPECT_FALSE(is_read([](UserState& user) { user.anchor_count = kMaxPatches + 1; }));
  EXPECT_FALSE(is_read([](UserState& user) { user.side_count = kMaxSides + 1; }));
  const auto with_side = [&](BodyId body, std::uint8_t segment) {
    return is_read([=](UserState& user) {
      user.side_count = 1;
      user.sides[0].body = body;
      user.sides[0].segment = segment;
    });
  };
  EXPECT_TRUE(with_side(BodyId(0), 0));
  EXPECT_FALSE(with_side(BodyId(1'000'000), 0));
  EXPECT_FALSE(with_side(BodyId(0), hand::kHandSegments));
}

TEST(StateHash, OfVersion1KnowsNoGovernor) {
  const WorldState base = sample_state(1);
  WorldState changed = base;
  changed.governors[1].credit_j = 1;
  changed.users[1].age = Duration(1);
  EXPECT_EQ(state_hash(changed, StateVersion::without_governors), state_hash(base, StateVersion::without_governors));
  EXPECT_NE(state_hash(base, StateVersion::without_governors), state_hash(base));
  changed.bodies[0].X_WB.p.x() = 1e-300;
  EXPECT_NE(state_hash(changed, StateVersion::without_governors), state_hash(base, StateVersion::without_governors));
}

}  // namespace
}  // namespace mechane::state
