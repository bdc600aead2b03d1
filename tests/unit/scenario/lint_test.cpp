// Warnings of bodies that fall, drift away, stay immovable or tied; of units that do not fit and impossible masses; and computed inertias.
#include <gtest/gtest.h>

#include "tests/support/shapes.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

const std::pair<std::string, std::string> kHeavy{"useGlobalGravity='false' autoDamp", "autoDamp"};
const std::pair<std::string, std::string> kAxleLater{"value='\"AXLE\" \"HOLD\" \"COUNTER\"'",
                                                     "value='\"HOLD\" \"COUNTER\"'"};
const std::pair<std::string, std::string> kAxleInTurn{
    "<MetadataSet containerField='value' name='turn'>\n",
    "<MetadataSet containerField='value' name='turn'>\n<MetadataString containerField='value' name='enable' "
    "value='\"AXLE\"'/>\n"};

TEST(Lint, ABodyThatFallsUntilALaterStepHoldsItIsNamed) {
  const std::string falls = with_edits({kHeavy, kAxleLater, kAxleInTurn});
  expect_one_warning(falls, "name='grasp'>", ErrorCode::conflict, "'INNER'");
  expect_nothing(with_edits({kHeavy}));                   // its first step enables what holds it
  expect_nothing(with_edits({kAxleLater, kAxleInTurn}));  // it has no weight
  // A step that holds it still; and an agent that is on from the start, because no step enables it.
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

TEST(Lint, ABodyFallsWhereItsFirstStepGivesItWeightAndNotWhereItTakesIt) {
  const std::string held =
      "value='\"HOLD\" \"COUNTER\"'/>\n                <MetadataSet containerField='value' name='object:INNER'>";
  const auto weight = [&](const std::string& value) {
    return std::pair(held,
                     held + "<MetadataBoolean containerField='value' name='useGlobalGravity' value='" + value + "'/>");
  };
  expect_one_warning(with_edits({kAxleLater, kAxleInTurn, weight("true")}), "name='grasp'>", ErrorCode::conflict,
                     "'INNER'");
  expect_nothing(with_edits({kHeavy, kAxleLater, kAxleInTurn, weight("false")}));
}

TEST(Lint, ABodyThatAnAgentOfAnotherActivityAloneHoldsFallsToo) {
  // Without its snap nothing holds the screw while it is put together.
  const std::string text = with_edits({kHeavy,
                                       {"value='\"CARRY\" \"SEAT\"'", "value='\"CARRY\"'"},
                                       {"name='seat'>\n",
                                        "name='seat'>\n<MetadataString containerField='value' "
                                        "name='enable' value='\"SEAT\"'/>\n"}});
  expect_one_warning(text, "name='take'>", ErrorCode::conflict, "'INNER'");
}

const std::string kSeatStep = "<MetadataSet containerField='value' name='seat'>\n";
const std::string kNoSeat = "<MetadataString containerField='value' name='disable' value='\"SEAT\"'/>\n";
std::string movable(const std::string& value) {
  return "<MetadataSet containerField='value' name='object:INNER'><MetadataBoolean containerField='value' "
         "name='movable' value='" +
         value + "'/></MetadataSet>\n";
}

const std::string kObject = "name='object' value='\"INNER\"'/>";
const std::pair<std::string, std::string> kTied{
    kObject, kObject + "<MetadataBoolean containerField='value' name='tied' value='true'/>"};

/// What the checker says of the snap SEAT, which the step `seat` switches off, with more keys in that step and more edits.
std::vector<x3d::Problem> of_snap_that_is_off(const std::string& keys, Edits edits = {}) {
  edits.emplace_back(kSeatStep, kSeatStep + kNoSeat + keys);
  const std::string text = with_edits(edits);
  std::vector<x3d::Problem> all = compile_text(text).problems;
  std::erase_if(all, [&](const x3d::Problem& p) {
    return !is_problem(p, ErrorCode::conflict, line_of(text, "name='seat'>"), "'INNER'");
  });
  for (const x3d::Problem& p : all) {
    EXPECT_EQ(p.severity, x3d::Severity::warning) << to_string(p);
    EXPECT_NE(p.what.find("'SEAT'"), std::string::npos) << to_string(p);
    EXPECT_NE(p.remedy.find("object:INNER"), std::string::npos) << to_string(p);
  }
  return all;
}

TEST(Lint, ABodyThatStaysImmovableAfterItsSnapIsOffIsNamed) {
  const std::vector<x3d::Problem> stuck = of_snap_that_is_off("");
  ASSERT_EQ(stuck.size(), 1u);
  EXPECT_NE(stuck[0].remedy.find("movable"), std::string::npos) << stuck[0].remedy;
  EXPECT_TRUE(of_snap_that_is_off(movable("true")).empty()) << "it is freed";
  EXPECT_TRUE(of_snap_that_is_off(movable("false")).empty()) << "its author wants it so";
  // In the first step of an activity nothing has been placed yet.
  const std::string first = "<MetadataSet containerField='value' name='grasp'>\n";
  const Outcome early = compile_text(with_edits({{first, first + kNoSeat}}));
  EXPECT_TRUE(std::ranges::none_of(early.problems, [](const x3d::Problem& p) {
    return is_problem(p, ErrorCode::conflict, kAnyLine, "'SEAT' is switched off");
  }));
}

TEST(Lint, ABodyThatStaysTiedAfterItsSnapIsOffIsNamed) {
  for (const std::string& keys : {std::string(), movable("true")}) {
    const std::vector<x3d::Problem> tied = of_snap_that_is_off(keys, {kTied});
    ASSERT_EQ(tied.size(), 1u) << keys;
    EXPECT_NE(tied[0].what.find("'OUTER'"), std::string::npos) << tied[0].what;
    EXPECT_NE(tied[0].remedy.find("geometry.breakable"), std::string::npos) << tied[0].remedy;
  }
  EXPECT_TRUE(of_snap_that_is_off(movable("false"), {kTied}).empty()) << "its author wants it held";
  EXPECT_TRUE(of_snap_that_is_off("<MetadataSet containerField='value' name='object:INNER'><MetadataDouble "
                                  "containerField='value' name='position' value='0 0.8 0.75'/></MetadataSet>\n",
                                  {kTied})
                  .empty())
      << "it is moved to another place";
  const std::string seated = "<MetadataSet containerField='value' name='SEATED'>";
  const std::string breaks =
      "<MetadataSet containerField='value' name='BREAK'>\n<MetadataString containerField='value' name='type' "
      "value='\"geometry.breakable\"'/>\n<MetadataString containerField='value' name='agent' "
      "value='\"SEAT\"'/>\n<MetadataDouble containerField='value' name='force' value='100'/>\n</MetadataSet>\n";
  EXPECT_TRUE(of_snap_that_is_off("", {kTied, {seated, breaks + seated}}).empty()) << "a strong pull parts it";
}

TEST(Lint, ABodyThatDriftsAwayOnceItIsPushedIsNamed) {
  const std::string damping = "autoDamp='true' linearDampingFactor='0.9'";
  const std::string at = "<RigidBody DEF='INNER'";
  const std::string weightless = "useGlobalGravity='false' ";
  const std::string there = "name='position' value='0 0.8 0.75'";
  const std::pair<std::string, std::string> undamped{damping, "autoDamp='false'"};
  expect_one_warning(with_edits({undamped}), at, ErrorCode::conflict, "'take'");
  expect_one_warning(with_edits({{damping, "autoDamp='true' linearDampingFactor='0'"}}), at, ErrorCode::conflict,
                     "'INNER'");
  expect_one_warning(
      with_edits({{weightless + damping, "autoDamp='false'"}, {"gravity='0 -9.81 0'", "gravity='0 0 0'"}}), at,
      ErrorCode::conflict, "'INNER'");
  expect_nothing(with_edits({{damping, "autoDamp='true' linearDampingFactor='0.2'"}}));  // it glides for 2 m
  expect_nothing(with_edits({{weightless + damping, "autoDamp='false'"}}));              // it has weight
  expect_nothing(with_edits({undamped, {there, "name='position' value='0 0.55 0'"}}));   // its snap takes it at once
  expect_nothing(
      with_edits({undamped, {"name='movable' value='true'", "name='movable' value='false'"}}));  // it is held still
  expect_nothing(with_edits({undamped,
                             {"name='node' value='\"INNER\"'/>",
                              "name='node' value='\"INNER\"'/><MetadataBoolean containerField='value' "
                              "name='touchable' value='false'/>"}}));  // no hand can push it
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
  expect_one_warning(unit("AXLE.rate", "rpm", "m"), "class='here'", ErrorCode::conflict, "rad/s or rpm");
  expect_one_warning(unit("COUNTER.turns", "", "rad"), "class='here'", ErrorCode::conflict, "'rad'");
  expect_one_warning(unit("PUMP.lifted_l", "l", "m3"), "class='here'", ErrorCode::conflict, "write l");
  expect_nothing(unit("AXLE.rate", "rpm", "rad/s"));
  expect_nothing(unit("COUNTER.turns", "", "turns"));
  const std::string angle = "value='\"AXLE.rate\"'";
  const auto of_joint = [&](const std::string& value, const std::string& its_unit) {
    return with_edits({{angle, "value='\"AXLE." + value + "\"'"},
                       {"name='unit' value='\"rpm\"'", "name='unit' value='\"" + its_unit + "\"'"}});
  };
  expect_one_warning(of_joint("angle", "m"), "name='unit' value='\"m\"'", ErrorCode::conflict, "rad or deg");
  expect_one_warning(of_joint("position", "deg"), "name='unit' value='\"deg\"'", ErrorCode::conflict, "write rad");
  expect_nothing(of_joint("angle", "deg"));
}

/// A loader that knows a mesh: a cube of 1 m about `at`, or one without its last two triangles.
FakeLoader cube(bool closed = true, const Vec3& at = Vec3::Zero()) {
  geometry::NamedMesh part{"part_1", test::box({0.5, 0.5, 0.5}, at)};
  if (!closed) part.mesh.triangles.resize(part.mesh.triangles.size() - 2);
  FakeLoader loader;
  loader.shape = solid_of(std::span(&part, 1));
  return loader;
}

TEST(Lint, AMassThatIsImpossibleForItsShapeIsNamed) {
  const std::string at = "<RigidBody DEF='INNER'";
  const auto mass = [](const std::string& kg) { return with_edits({{"mass='42'", "mass='" + kg + "'"}}); };
  expect_one_warning(mass("0.001"), at, ErrorCode::invalid_value, "less than that of air", cube());
  expect_one_warning(mass("1000000"), at, ErrorCode::invalid_value, "any metal: the mesh encloses 1 m^3", cube());
  expect_one_warning(mass("1000000"), at, ErrorCode::invalid_value, "any metal: the mesh fits into 1 m^3", cube(false));
  for (const char* kg : {"42", "700", "7800"})
    expect_nothing(mass(kg), cube());
  expect_nothing(mass("0.001"), cube(false));  // a skin of paper weighs little
  expect_one_warning(mass("0.00001"), at, ErrorCode::invalid_value, "1e-05 kg");
  expect_one_warning(mass("1000000"), at, ErrorCode::invalid_value, "1e+06 kg");
}

TEST(Inertia, IsComputedFromTheMeshWhereItIsNotGiven) {
  const std::string bare = with_edits({{" inertia='20.4 0 0 0 20.3 0 0 0 0.35'", ""}});
  const auto inertia = [](const Outcome& outcome) {
    return outcome.world->bodies[outcome.world->find_body("INNER").index()].inertia_kg_m2;
  };
  FakeLoader closed = cube(true, {3, 0, 0});
  const Outcome computed = compile_text(bare, closed);
  ASSERT_TRUE(computed.world);
  EXPECT_TRUE(computed.problems.empty()) << to_string(computed.problems.front());
  EXPECT_TRUE(inertia(computed).isApprox(42.0 / 6 * Mat3::Identity(), 1e-9)) << inertia(computed);
  const int line = line_of(bare, "<RigidBody DEF='INNER'");
  FakeLoader open = cube(false);
  const Outcome shell = compile_text(bare, open);
  ASSERT_TRUE(shell.world);
  EXPECT_TRUE(inertia(shell).isApprox(42 * open.shape->inertia_per_kg_m2, 1e-9)) << inertia(shell);
  EXPECT_EQ(shell.problems.size(), 1u);
  static_cast<void>(shell.find(ErrorCode::missing, line, "4 open edges"));
  FakeLoader flat, blind;
  flat.shape = Solid{.open_edges = 3};  // without area
  for (FakeLoader* loader : {&flat, &blind}) {
    const Outcome taken = compile_text(bare, *loader);
    ASSERT_TRUE(taken.world);
    EXPECT_EQ(inertia(taken), Mat3::Identity());
    EXPECT_EQ(taken.problems.size(), loader == &flat ? 1u : 0u) << "a loader that does not read meshes reports nothing";
    if (loader == &flat) static_cast<void>(taken.find(ErrorCode::missing, line, "1 kg m^2"));
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

TEST(Solid, ThatIsOpenHasTheMomentsOfAThinShell) {
  geometry::NamedMesh plate{"part_1",
                            {{{5, 5, 7}, {7, 5, 7}, {7, 9, 7}, {5, 9, 7}}, {{0, 1, 2}, {0, 2, 3}}}};  // 2 m by 4 m
  const Solid flat = solid_of(std::span(&plate, 1));
  EXPECT_LT((flat.p_OC - Vec3(6, 7, 7)).norm(), 1e-9);
  const Mat3 of_plate = Vec3(16 / 12.0, 4 / 12.0, 20 / 12.0).asDiagonal();
  EXPECT_TRUE(flat.inertia_per_kg_m2.isApprox(of_plate, 1e-9)) << flat.inertia_per_kg_m2;

  // Five sides of a cube of 1 m, the one at -x missing. The middle is at x = 0.5 / 5; xx^T spreads by (0.25 + 4 / 12) / 5 - 0.01 along x,
  // and by (0.5 + 3 / 12) / 5 along y and z.
  const Solid box = *cube(false, {3, 0, 0}).shape;
  EXPECT_LT((box.p_OC - Vec3(3.1, 0, 0)).norm(), 1e-9);
  const Mat3 of_box = Vec3(0.3, 77 / 300.0, 77 / 300.0).asDiagonal();
  EXPECT_TRUE(box.inertia_per_kg_m2.isApprox(of_box, 1e-9)) << box.inertia_per_kg_m2;
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
