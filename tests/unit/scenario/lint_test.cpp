// Warnings of bodies that fall or stay immovable, of units that do not fit, of masses that no thing has; and the inertia that is computed.
#include <gtest/gtest.h>

#include "tests/support/shapes.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

using Edits = std::vector<std::pair<std::string, std::string>>;

std::string with_edits(const Edits& edits) {
  std::string text = text_of(shipped_file());
  for (const auto& [from, to] : edits) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "the shipped file no longer holds: " << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
  }
  return text;
}

/// The line, severity and remedy of the one problem in a file with these edits.
void expect_one_warning(const std::string& text, const std::string& at, const std::string& part,
                        FakeLoader loader = {}) {
  const Outcome outcome = compile_text(text, loader);
  EXPECT_TRUE(outcome.world) << outcome.world.error().to_string();
  ASSERT_EQ(outcome.problems.size(), 1u) << (outcome.problems.empty() ? part : to_string(outcome.problems.back()));
  const x3d::Problem& problem = outcome.problems.front();
  EXPECT_EQ(problem.severity, x3d::Severity::warning);
  EXPECT_EQ(problem.line, line_of(text, at)) << to_string(problem);
  EXPECT_FALSE(problem.node.empty());
  EXPECT_FALSE(problem.remedy.empty());
  EXPECT_NE(to_string(problem).find(part), std::string::npos) << to_string(problem);
}

void expect_nothing(const std::string& text, FakeLoader loader = {}) {
  const Outcome outcome = compile_text(text, loader);
  EXPECT_TRUE(outcome.problems.empty()) << to_string(outcome.problems.front());
}

const std::pair<std::string, std::string> kHeavy{"useGlobalGravity='false' autoDamp", "autoDamp"};
const std::pair<std::string, std::string> kAxleLater{"value='\"AXLE\" \"HOLD\" \"COUNTER\"'",
                                                     "value='\"HOLD\" \"COUNTER\"'"};
const std::pair<std::string, std::string> kAxleInTurn{
    "<MetadataSet containerField='value' name='turn'>\n",
    "<MetadataSet containerField='value' name='turn'>\n<MetadataString containerField='value' name='enable' "
    "value='\"AXLE\"'/>\n"};

TEST(Lint, ABodyThatFallsUntilALaterStepHoldsItIsNamed) {
  const std::string falls = with_edits({kHeavy, kAxleLater, kAxleInTurn});
  expect_one_warning(falls, "name='grasp'>", "'INNER'");
  expect_nothing(with_edits({kHeavy}));                   // its first step enables what holds it
  expect_nothing(with_edits({kAxleLater, kAxleInTurn}));  // it has no weight
  // A step that holds it still, and an agent that is on from the start for no step enables it.
  expect_nothing(with_edits(
      {kHeavy,
       kAxleLater,
       kAxleInTurn,
       {"value='\"HOLD\" \"COUNTER\"'/>\n                <MetadataSet containerField='value' name='object:INNER'>\n "
        "                 <MetadataBoolean containerField='value' name='movable' value='true'/>",
        "value='\"HOLD\" \"COUNTER\"'/>\n                <MetadataSet containerField='value' name='object:INNER'>\n "
        "                 <MetadataBoolean containerField='value' name='movable' value='false'/>"}}));
  expect_nothing(with_edits({kHeavy, kAxleLater}));
}

TEST(Lint, ABodyThatAnAgentOfAnotherActivityAloneHoldsFallsToo) {
  // Without its snap nothing holds the screw while it is put together.
  const std::string text = with_edits({kHeavy,
                                       {"value='\"CARRY\" \"SEAT\"'", "value='\"CARRY\"'"},
                                       {"name='seat'>\n",
                                        "name='seat'>\n<MetadataString containerField='value' "
                                        "name='enable' value='\"SEAT\"'/>\n"}});
  expect_one_warning(text, "name='take'>", "is off");
}

const std::string kSeatStep = "<MetadataSet containerField='value' name='seat'>\n";
const std::string kNoSeat = "<MetadataString containerField='value' name='disable' value='\"SEAT\"'/>\n";
std::string movable(const std::string& value) {
  return "<MetadataSet containerField='value' name='object:INNER'><MetadataBoolean containerField='value' "
         "name='movable' value='" +
         value + "'/></MetadataSet>\n";
}

TEST(Lint, ABodyThatStaysImmovableAfterItsSnapIsOffIsNamed) {
  const auto with_step = [&](const std::string& keys) {
    return compile_text(with_edits({{kSeatStep, kSeatStep + keys}}));
  };
  const auto says = [](const Outcome& outcome) {
    return std::ranges::any_of(
        outcome.problems, [](const x3d::Problem& p) { return p.what.find("stays immovable") != std::string::npos; });
  };
  const Outcome stuck = with_step(kNoSeat);
  ASSERT_TRUE(says(stuck));
  const x3d::Problem problem = stuck.find("stays immovable");
  EXPECT_EQ(problem.severity, x3d::Severity::warning);
  EXPECT_EQ(problem.line, line_of(with_edits({{kSeatStep, kSeatStep + kNoSeat}}), "name='seat'>"));
  EXPECT_FALSE(problem.remedy.empty());
  EXPECT_FALSE(says(with_step(kNoSeat + movable("true")))) << "it is freed";
  EXPECT_FALSE(says(with_step(kNoSeat + movable("false")))) << "its author wants it so";
  // In the first step of an activity nothing has been placed yet.
  const std::string first = "<MetadataSet containerField='value' name='grasp'>\n";
  EXPECT_FALSE(says(compile_text(with_edits({{first, first + kNoSeat}}))));
  const Outcome tied =
      compile_text(with_edits({{kSeatStep, kSeatStep + kNoSeat},
                               {"name='object' value='\"INNER\"'/>",
                                "name='object' value='\"INNER\"'/><MetadataBoolean containerField='value' name='tied' "
                                "value='true'/>"}}));
  EXPECT_FALSE(says(tied)) << "what is tied moves with what it is tied to";
}

TEST(Lint, AUnitThatDoesNotFitItsSourceIsNamed) {
  const auto unit = [](const std::string& source, const std::string& from, const std::string& to) {
    return with_edits({{"value='\"" + source +
                            "\"'/>\n            <MetadataString containerField='value' name='unit' "
                            "value='\"" +
                            from + "\"'/>",
                        "value='\"" + source + "\"'/>\n<MetadataString containerField='value' name='unit' value='\"" +
                            to + "\"' class='here'/>"}});
  };
  expect_one_warning(unit("AXLE.rate", "rpm", "m"), "class='here'", "rad/s or rpm");
  expect_one_warning(unit("COUNTER.turns", "", "rad"), "class='here'", "'rad'");
  expect_one_warning(unit("PUMP.lifted_l", "l", "m3"), "class='here'", "write l");
  expect_nothing(unit("AXLE.rate", "rpm", "rad/s"));
  expect_nothing(unit("COUNTER.turns", "", "turns"));
  const std::string angle = "value='\"AXLE.rate\"'";
  const auto of_joint = [&](const std::string& value, const std::string& its_unit) {
    return with_edits({{angle, "value='\"AXLE." + value + "\"'"},
                       {"name='unit' value='\"rpm\"'", "name='unit' value='\"" + its_unit + "\"'"}});
  };
  expect_one_warning(of_joint("angle", "m"), "name='unit' value='\"m\"'", "rad or deg");
  expect_one_warning(of_joint("position", "deg"), "name='unit' value='\"deg\"'", "write rad");
  expect_nothing(of_joint("angle", "deg"));
}

/// A loader that knows a mesh: a cube of 1 m about `at`, or one without its last face.
FakeLoader cube(bool closed = true, const Vec3& at = Vec3::Zero()) {
  geometry::NamedMesh part{"part_1", test::box({0.5, 0.5, 0.5}, at)};
  if (!closed) part.mesh.triangles.pop_back();
  FakeLoader loader;
  loader.shape = solid_of(std::span(&part, 1));
  return loader;
}

TEST(Lint, AMassThatNoThingOfItsShapeHasIsNamed) {
  const std::string at = "<RigidBody DEF='INNER'";
  const auto mass = [](const std::string& kg) { return with_edits({{"mass='42'", "mass='" + kg + "'"}}); };
  expect_one_warning(mass("0.001"), at, "less than that of air", cube());
  expect_one_warning(mass("1000000"), at, "more than that of any metal", cube());
  expect_one_warning(mass("1000000"), at, "more than that of any metal", cube(false));
  for (const char* kg : {"42", "700", "7800"})
    expect_nothing(mass(kg), cube());
  expect_nothing(mass("0.001"), cube(false));  // a skin of paper weighs little
  expect_one_warning(mass("0.00001"), at, "outside what an exhibit can have");
  expect_one_warning(mass("1000000"), at, "outside what an exhibit can have");
}

TEST(Inertia, IsComputedFromAClosedMeshWhereItIsNotGiven) {
  const std::string bare = with_edits({{" inertia='20.4 0 0 0 20.3 0 0 0 0.35'", ""}});
  const auto inertia = [](const Outcome& outcome) {
    return outcome.world->bodies[outcome.world->find_body("INNER").index()].inertia_kg_m2;
  };
  FakeLoader closed = cube(true, {3, 0, 0});
  const Outcome computed = compile_text(bare, closed);
  ASSERT_TRUE(computed.world);
  EXPECT_TRUE(computed.problems.empty()) << to_string(computed.problems.front());
  EXPECT_TRUE(inertia(computed).isApprox(42.0 / 6 * Mat3::Identity(), 1e-9)) << inertia(computed);
  for (FakeLoader loader : {cube(false), FakeLoader()}) {
    const bool looked = loader.shape.has_value();
    const Outcome taken = compile_text(bare, loader);
    ASSERT_TRUE(taken.world);
    EXPECT_EQ(inertia(taken), Mat3::Identity());
    EXPECT_EQ(taken.problems.size(), looked ? 1u : 0u) << "who has not looked says nothing";
    if (!looked) continue;
    EXPECT_FALSE(taken.find("taken as 1 kg m^2").remedy.empty());
  }
  const Outcome given = compile_text(text_of(shipped_file()), closed);
  EXPECT_EQ(inertia(given)(1, 1), 20.3) << "what is written counts";
}

TEST(Solid, HasTheMomentsOfABox) {
  geometry::NamedMesh box{"part_1", test::box({0.5, 1, 1.5}, {10, -20, 30})};
  for (const bool inside_out : {false, true}) {
    if (inside_out) {
      for (auto& t : box.mesh.triangles)
        std::swap(t[0], t[1]);
    }
    const Solid solid = solid_of(std::span(&box, 1));
    EXPECT_TRUE(solid.is_closed());
    EXPECT_NEAR(solid.volume_m3, 6, 1e-9);
    EXPECT_LT((solid.p_OC - Vec3(10, -20, 30)).norm(), 1e-9);
    const Mat3 wanted = Vec3((4 + 9) / 12.0, (1 + 9) / 12.0, (1 + 4) / 12.0).asDiagonal();
    EXPECT_TRUE(solid.inertia_per_kg_m2.isApprox(wanted, 1e-9)) << solid.inertia_per_kg_m2;
  }
}

TEST(Solid, OfTwoPartsIsAboutTheirCommonMiddle) {
  const std::vector<geometry::NamedMesh> ends{{"part_1", test::box({0.5, 0.5, 0.5}, {-2, 0, 0})},
                                              {"part_2", test::box({0.5, 0.5, 0.5}, {2, 0, 0})}};
  const Solid solid = solid_of(ends);
  EXPECT_LT(solid.p_OC.norm(), 1e-9);
  EXPECT_NEAR(solid.inertia_per_kg_m2(0, 0), 1.0 / 6, 1e-9);
  EXPECT_NEAR(solid.inertia_per_kg_m2(1, 1), 1.0 / 6 + 4, 1e-9);
  EXPECT_FALSE(solid_of({}).is_closed());
}

}  // namespace
}  // namespace mechane::scenario
