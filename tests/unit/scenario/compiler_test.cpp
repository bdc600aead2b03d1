#include "server/scenario/compiler.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "server/machines/screw_geometry.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

const double kSlope = 37 * kPi / 180;

double number(const state::ComponentDescription& component, const std::string& name) {
  return std::get<std::vector<double>>(component.parameters.at(name)).front();
}

class ArchimedesScrew : public ::testing::Test {
 protected:
  void SetUp() override {
    Outcome outcome = compile_text(text_of(shipped_file()), loader);
    ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
    EXPECT_TRUE(outcome.problems.empty()) << to_string(outcome.problems.front());
    world = std::move(*outcome.world);
  }
  FakeLoader loader;
  state::WorldDescription world;
};

TEST_F(ArchimedesScrew, BodiesStandAsTheModelWasMade) {
  EXPECT_EQ(world.id, "archimedes-screw");
  EXPECT_EQ(world.languages, (std::vector<std::string>{"el", "en"}));
  ASSERT_EQ(world.bodies.size(), 2u);
  const auto& inner = world.bodies[world.find_body("INNER").index()];
  const auto& outer = world.bodies[world.find_body("OUTER").index()];
  EXPECT_TRUE(outer.fixed);
  EXPECT_TRUE(inner.graspable);
  EXPECT_FALSE(inner.use_gravity);
  EXPECT_EQ(inner.mesh.node, "INNER");
  EXPECT_EQ(inner.mesh.uri, "../models/archimedes-screw.glb");
  EXPECT_EQ(loader.loaded, (std::vector<std::string>{"archimedes-screw.glb#OUTER", "archimedes-screw.glb#INNER"}));
  // In its place the screw has its barrel's pose: z up the slope, x square to it in the upright plane, origin half way.
  const Vec3 u(std::cos(kSlope), std::sin(kSlope), 0);
  for (const auto* body : {&inner, &outer}) {
    EXPECT_LT((body->X_WB.R * Vec3::UnitZ() - u).norm(), 1e-8);
    EXPECT_LT((body->X_WB.R * Vec3::UnitX() - Vec3(-u.y(), u.x(), 0)).norm(), 1e-8);
    EXPECT_EQ(body->X_WB.p, Vec3(0, 0.55, 0));
  }
  const Vec3 p_WGrip = inner.X_WB * Vec3(0.25, 0, 1.36);
  EXPECT_LT((p_WGrip - Vec3(0.9357, 1.5681, 0)).norm(), 1e-4);
}

TEST_F(ArchimedesScrew, TheAxleJoinsBothAndTurnsOn) {
  const auto& axle = world.joints[world.find_joint("AXLE").index()];
  EXPECT_EQ(axle.kind, state::JointKind::hinge);
  EXPECT_GT(axle.min_position, axle.max_position);
  EXPECT_FALSE(axle.enabled_at_start);
  const Pose X_WJ1 = world.bodies[axle.body1.index()].X_WB * axle.X_B1J;
  const Pose X_WJ2 = world.bodies[axle.body2.index()].X_WB * axle.X_B2J;
  EXPECT_LT((X_WJ1.p - X_WJ2.p).norm(), 1e-12);
  EXPECT_LT(X_WJ1.R.angularDistance(X_WJ2.R), 1e-7);
  EXPECT_LT((X_WJ1.R * Vec3::UnitZ() + Vec3(std::cos(kSlope), std::sin(kSlope), 0)).norm(), 1e-8);
}

TEST_F(ArchimedesScrew, ActivitiesLeadFromStepToStep) {
  const auto& assemble = world.activities[world.find_activity("assemble").index()];
  const auto& take = world.steps[assemble.first.index()];
  EXPECT_EQ(take.name, "take");
  ASSERT_EQ(take.bodies.size(), 1u);
  EXPECT_EQ(take.bodies[0].X_WB->p, Vec3(0, 0.8, 0.75));
  EXPECT_EQ(take.triggers[0].next, world.find_step("seat"));
  const auto& seat = world.steps[take.triggers[0].next.index()];
  EXPECT_EQ(seat.triggers[0].comparison, state::Comparison::equal);
  EXPECT_EQ(seat.triggers[0].hold_s, 0.3);
  EXPECT_FALSE(seat.triggers[0].next);
  const auto& use = world.activities[world.find_activity("use").index()];
  EXPECT_EQ(world.steps[use.first.index()].name, "grasp");
  EXPECT_EQ(world.steps[use.first.index()].texts.at("caption").size(), 2u);
  for (const auto& activity : world.activities) {
    EXPECT_TRUE(std::any_of(world.visits.begin(), world.visits.end(),
                            [&](const auto& v) { return v.activity == world.find_activity(activity.name); }));
  }
}

TEST_F(ArchimedesScrew, AVisitorsHandCanDoIt) {
  const auto& pump = world.machines[0];
  const machines::ScrewShape shape{number(pump, "diameter") / 2, number(pump, "coreDiameter") / 2,
                                   number(pump, "pitch"), static_cast<int>(number(pump, "blades")),
                                   number(pump, "slope")};
  EXPECT_NEAR(number(pump, "diameter"), number(pump, "length") / 8, 1e-12);  // Vitruvius' proportions
  EXPECT_NEAR(shape.pitch_m, 2 * kPi * shape.core_radius_m, 1e-6);
  const double volume = machines::volume_per_turn_m3(shape);
  const double torque = volume * 1000 * 9.81 * number(pump, "lift") / (2 * kPi) / number(pump, "efficiency");
  const auto& hinge = world.agents[world.find_agent("AXLE").index()];
  const auto& hold = world.agents[world.find_agent("HOLD").index()];
  const double force_n =
      (world.effort_scale * (torque + number(hinge, "frictionTorque")) + number(hold, "torqueLimit")) / 0.25;
  EXPECT_LT(force_n, 0.88);  // what a Touch bears for long, see deploy/decisions/034
  EXPECT_GT(force_n, 0.5);   // and still felt
  // The scripted visit turns far enough: the screw fills first, then every turn pours.
  const auto& fill = world.steps[world.find_step("fill").index()];
  const double needed = number(pump, "length") / shape.pitch_m + fill.triggers[0].value / 1000 / volume;
  const auto& moves = world.visits[1].moves;
  const auto turn =
      std::find_if(moves.begin(), moves.end(), [](const auto& m) { return m.kind == state::VisitMove::Kind::turn; });
  ASSERT_NE(turn, moves.end());
  EXPECT_GT(turn->turns, needed + 0.3);
  EXPECT_LT(turn->rate_rpm, 50 / std::pow(number(pump, "diameter"), 2.0 / 3));
}

TEST_F(ArchimedesScrew, TheHashFollowsWhatThePhysicsDependsOn) {
  EXPECT_EQ(compile_text(text_of(shipped_file())).world->content_hash, world.content_hash);
  FakeLoader other;
  other.hash = std::string(32, 'b');
  EXPECT_NE(compile_text(text_of(shipped_file()), other).world->content_hash, world.content_hash);
  EXPECT_NE(compile_text(edited("mass='42'", "mass='43'")).world->content_hash, world.content_hash);
}

using enum ErrorCode;

// Every fault: what is edited, where the error must point, its code, and a name or number that it must hold.
struct Fault {
  const char* from;
  const char* to;
  const char* at;  // text on the line that the error names
  ErrorCode code;
  const char* name;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.to;
}

class Faults : public ::testing::TestWithParam<Fault> {};

TEST_P(Faults, HaveCodeLineNodeAndRemedy) {
  const Fault& fault = GetParam();
  const std::string text = edited(fault.from, fault.to);
  const Outcome outcome = compile_text(text);
  ASSERT_FALSE(outcome.world) << fault.to;
  const x3d::Problem problem = outcome.find(fault.code, line_of(text, fault.at), fault.name);
  EXPECT_EQ(problem.severity, x3d::Severity::error);
  EXPECT_FALSE(problem.node.empty());
  const auto first = std::ranges::find(outcome.problems, x3d::Severity::error, &x3d::Problem::severity);
  ASSERT_NE(first, outcome.problems.end());
  EXPECT_EQ(outcome.world.error().code, first->code) << "the Error is the first problem";
  EXPECT_EQ(outcome.world.error().line, first->line);
}

const Fault kFaults[] = {
    {"mass='42'", "mass='nan'", "mass='nan'", invalid_value, "mass: 'nan'"},
    {"mass='42'", "mass='-3'", "mass='-3'", invalid_value, "mass: -3 kg"},
    {"mass='42'", "mass='0'", "mass='0'", invalid_value, "the mass is 0 kg"},
    {"mass='42'", "mass='1 2'", "mass='1 2'", invalid_value, "mass: it has 2"},
    {"inertia='20.4 0 0 0 20.3", "inertia='20.4 0 0 0 200", "inertia=", invalid_value, "principal moment"},
    {"value='\"turn\"'/>\n              <MetadataString containerField='value' name='joint' value='\"AXLE\"'/>\n"
     "              <MetadataDouble containerField='value' name='turns' value='9'",
     "value='\"swing\"'/>\n              <MetadataString containerField='value' name='joint' value='\"AXLE\"'/>\n"
     "              <MetadataDouble containerField='value' name='angle' value='0'",
     "name='angle' value='0'", invalid_value, "swing is 0"},
    {"axis='-0.79", "axis='0 0 0' class='", "<SingleAxisHingeJoint", invalid_value, "axis"},
    {"containerField='body2' USE='INNER'", "containerField='body2' USE='INER'", "USE='INER'", unknown_name,
     "did you mean 'INNER'?"},
    {"containerField='body2' USE='INNER'", "containerField='body2' USE='OUTER'", "<SingleAxisHingeJoint", conflict,
     "to itself"},
    {"name='quantity' value='\"turns\"'", "name='quantity' value='\"trns\"'", "value='\"trns\"'", unknown_name,
     "did you mean 'turns'?"},
    {"value='\"PUMP.basin_l\"'", "value='\"PUMP.basin\"'", "PUMP.basin\"", unknown_name, "did you mean 'basin_l'?"},
    {"value='\"PUMP.basin_l\"'", "value='\"PMP.basin_l\"'", "PMP.basin_l", unknown_name, "did you mean 'PUMP'?"},
    {"name='op' value='\"=\"'", "name='op' value='\"==\"'", "value='\"==\"'", invalid_value, "one of: < = >"},
    {"name='next' value='\"fill\"'", "name='next' value='\"fil\"'", "value='\"fil\"'", unknown_name,
     "did you mean 'fill'?"},
    {"name='format' value='1'", "name='format' value='2'", "name='format'", wrong_version, "version 2"},
    {"name='id' value='\"archimedes-screw\"'", "name='id' value='\"../etc\"'", "../etc", invalid_value, "'../etc'"},
    {"value='\"CARRY\" \"SEAT\"'", "value='\"CARRY\" \"SEAL\"'", "\"SEAL\"", unknown_name, "did you mean 'SEAT'?"},
    {"name='object:INNER'", "name='object:INNR'", "object:INNR", unknown_name, "did you mean 'INNER'?"},
    {"value='\"geometry.snap\"'", "value='\"geometry.snop\"'", "geometry.snop", unknown_name,
     "did you mean 'geometry.snap'?"},
    {"name='model' value='\"MODEL\"'", "name='model' value='\"MODLE\"'", "MODLE", unknown_name,
     "did you mean 'MODEL'?"},
    {"../models/archimedes-screw.glb", "https://example.org/a.glb", "https://example.org", invalid_value,
     "'https://example.org/a.glb'"},
    {"name='joint' value='\"AXLE\"'", "name='joint' value='\"AXEL\"'", "AXEL", unknown_name, "did you mean 'AXLE'?"},
    {"name='tolerance' value='0.06 0.26'", "name='tolerance' value='0.06 -1'", "value='0.06 -1'", invalid_value,
     "tolerance is -1"},
    {"<MetadataDouble containerField='value' name='tolerance' value='0.06 0.26'/>\n", "", "name='SEAT'>",
     ErrorCode::missing, "'tolerance'"},
    {"name='node' value='\"INNER\"'/>",
     "name='node' value='\"INNER\"'/>\n<MetadataBoolean containerField='value' name='touchable' value='false'/>"
     "<MetadataBoolean containerField='value' name='collides' value='true'/>",
     "name='collides'", conflict, "touchable"},
    {"name='node' value='\"INNER\"'/>",
     "name='node' value='\"INNER\"'/>\n<MetadataDouble containerField='value' name='restitution' value='1.5'/>",
     "name='restitution'", invalid_value, "'restitution': 1.5"},
    {"name='staticFriction' value='0.6'", "name='grooveDepth' value='0.0001'", "name='grooveDepth'", ErrorCode::missing,
     "grooveDirection"},
    {"<MetadataDouble containerField='value' name='staticFriction' value='0.6'/>",
     "<MetadataDouble containerField='value' name='grooveDepth' value='0.001'/>"
     "<MetadataDouble containerField='value' name='grooveDirection' value='0 0 1'/>",
     "name='grooveDepth'", conflict, "at most 0.000081"},
    {"name='staticFriction' value='0.6'", "name='viscosity' value='50'", "name='viscosity'", invalid_value, "0 to 2"},
    {"<MetadataSet containerField='value' name='SEATED'>",
     "<MetadataSet containerField='value' name='WET'>"
     "<MetadataString containerField='value' name='type' value='\"touch.surface\"'/>"
     "<MetadataString containerField='value' name='object' value='\"INNER\"'/>\n"
     "<MetadataDouble containerField='value' name='dynamicFriction' value='3'/></MetadataSet>"
     "<MetadataSet containerField='value' name='SEATED'>",
     "name='dynamicFriction' value='3'", conflict, "agent WET: the dynamicFriction"},
    {"name='grip' value='0.25 0 1.36'", "name='grip' value='0.25 0'", "value='0.25 0'", invalid_value, "3 numbers"},
};

INSTANTIATE_TEST_SUITE_P(OfAnAuthor, Faults, ::testing::ValuesIn(kFaults));

TEST(Compiler, MeshesThatAreMissing) {
  const std::string text = text_of(shipped_file());
  FakeLoader empty;
  empty.no_files = true;
  const Outcome none = compile_text(text, empty);
  EXPECT_FALSE(none.world);
  static_cast<void>(none.find(not_found, line_of(text, "<Inline"), "archimedes-screw.glb"));
  FakeLoader partial;
  partial.missing_node = "INNER";
  const Outcome outcome = compile_text(text, partial);
  EXPECT_FALSE(outcome.world);
  static_cast<void>(outcome.find(unknown_name, line_of(text, "name='node' value='\"INNER\"'"), "'INNER'"));
}

TEST(Compiler, BodiesCollideWhenAskedToAndWhatSnapsTogetherIsMated) {
  const Outcome plain = compile_text(text_of(shipped_file()));
  ASSERT_TRUE(plain.world);
  const Outcome outcome = compile_text(
      edited("name='node' value='\"INNER\"'/>",
             "name='node' value='\"INNER\"'/><MetadataBoolean containerField='value' name='collides' value='true'/>"
             "<MetadataDouble containerField='value' name='restitution' value='0.25'/>"));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  const auto inner = outcome.world->find_body("INNER"), outer = outcome.world->find_body("OUTER");
  EXPECT_FALSE(plain.world->bodies[inner.index()].collides) << "a body must be asked to";
  EXPECT_TRUE(outcome.world->bodies[inner.index()].collides);
  EXPECT_EQ(outcome.world->bodies[inner.index()].restitution, 0.25);
  EXPECT_FALSE(outcome.world->bodies[outer.index()].collides);
  ASSERT_EQ(outcome.world->mates.size(), 1u) << "SEAT snaps INNER into OUTER";
  EXPECT_EQ(outcome.world->mates[0].body1, inner);
  EXPECT_EQ(outcome.world->mates[0].body2, outer);
}

TEST(Compiler, ABodySaysWhatOfItsMeshIsSolid) {
  const std::string node = "name='node' value='\"INNER\"'/>";
  const auto with = [&](const std::string& value) {
    return edited(node, node + "<MetadataString containerField='value' name='solid' value='\"" + value + "\"'/>");
  };
  FakeLoader loader;
  ASSERT_TRUE(compile_text(with("sheet 0.002"), loader).world);
  EXPECT_EQ(loader.solids,
            (std::vector<geometry::SolidChoice>{{}, {.kind = geometry::SolidKind::sheet, .thickness_m = 0.002}}));
  const std::string wrong = with("hollow");
  const Outcome outcome = compile_text(wrong);
  EXPECT_FALSE(outcome.world);
  static_cast<void>(outcome.find(ErrorCode::invalid_value, line_of(wrong, "name='solid'"), "'hollow'"));
}

TEST(Compiler, ABodyHasATitleForVisitorsWhereTheAuthorGivesOne) {
  const std::string greek = "<MetadataString containerField='value' name='title.el' value='\"Ο κύλινδρος\"'/>";
  const std::string english = "<MetadataString containerField='value' name='title.en' value='\"The barrel\"'/>";
  const auto title_of = [](const Outcome& outcome) {
    return outcome.world ? outcome.world->bodies[outcome.world->find_body("OUTER").index()].title : state::Texts{};
  };
  EXPECT_EQ(title_of(compile_text(text_of(shipped_file()))),
            (state::Texts{{"el", "Ο κύλινδρος"}, {"en", "The barrel"}}));
  const Outcome one = compile_text(edited(greek, ""));
  EXPECT_EQ(title_of(one), (state::Texts{{"en", "The barrel"}}));
  const int line = line_of(edited(greek, ""), "<RigidBody DEF='OUTER'");
  EXPECT_NE(one.find(ErrorCode::missing, line, ": el").node.find("mechane:body of OUTER"), std::string::npos);
  std::string none = edited(greek, "");
  none.replace(none.find(english), english.size(), "");
  const Outcome untitled = compile_text(none);
  EXPECT_TRUE(untitled.world && title_of(untitled).empty());
  EXPECT_TRUE(untitled.problems.empty()) << "not every body is one for visitors";
  const std::string misspelt = edited("name='title.el' value='\"Ο κύλινδρος", "name='titel.el' value='\"Ο κύλινδρος");
  static_cast<void>(compile_text(misspelt).find(unknown_name, line_of(misspelt, "titel.el"), "'title.el'"));
}

TEST(Compiler, SlidersAndBallsStandWhereTheirBodiesDo) {
  const std::string joints =
      "<SliderJoint DEF='SLIDE' axis='0 1 0' minSeparation='0' maxSeparation='2'><RigidBody containerField='body1' "
      "USE='OUTER'/>"
      "<RigidBody containerField='body2' USE='INNER'/></SliderJoint>"
      "<BallJoint DEF='BALL' anchorPoint='1 2 3'><RigidBody containerField='body1' "
      "USE='INNER'/></BallJoint></RigidBodyCollection>";
  const Outcome outcome = compile_text(edited("</RigidBodyCollection>", joints));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  const auto& slide = outcome.world->joints[outcome.world->find_joint("SLIDE").index()];
  EXPECT_EQ(slide.max_position, 2);
  EXPECT_LT((outcome.world->bodies[slide.body2.index()].X_WB * slide.X_B2J * Vec3::UnitX() - Vec3(0, 1.55, 0)).norm(),
            1e-9);
  const auto& ball = outcome.world->joints[outcome.world->find_joint("BALL").index()];
  EXPECT_FALSE(ball.body1);  // the world
  EXPECT_EQ(ball.X_B1J.p, Vec3(1, 2, 3));
}

TEST(CompileJoints, OneMoreThanAWorldTakesIsRefusedAtItsLine) {
  std::string text = "<X3D version='4.0'><Scene><RigidBodyCollection><RigidBody DEF='A'/>\n";
  for (std::size_t i = 0; i <= state::kMaxJoints; ++i)
    text += "<BallJoint><RigidBody containerField='body1' USE='A'/></BallJoint>\n";
  const Outcome outcome = compile_text(text + "</RigidBodyCollection></Scene></X3D>");
  EXPECT_FALSE(outcome.world);
  static_cast<void>(outcome.find(ErrorCode::too_large, static_cast<int>(state::kMaxJoints) + 2, "256 joints"));
}

}  // namespace
}  // namespace mechane::scenario
