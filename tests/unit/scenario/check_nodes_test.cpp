// Elements checked against X3D's tables and ours: typos, types, places; notes of what is not simulated.
#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "server/x3d/schema.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

using enum ErrorCode;

// What an author writes wrong: the edit, where the problem must point, its code, and a name or number that it must hold.
struct Slip {
  const char* from;
  const char* to;
  const char* at;
  ErrorCode code;
  const char* name;
  x3d::Severity severity = x3d::Severity::error;
};

void PrintTo(const Slip& slip, std::ostream* out) {
  *out << slip.to;
}

class Slips : public ::testing::TestWithParam<Slip> {};

TEST_P(Slips, AreNamedWithCodeLineNodeAndRemedy) {
  const Slip& slip = GetParam();
  const std::string text = edited(slip.from, slip.to);
  const Outcome outcome = compile_text(text);
  EXPECT_EQ(outcome.world.has_value(), slip.severity != x3d::Severity::error);
  const x3d::Problem problem = outcome.find(slip.code, line_of(text, slip.at), slip.name);
  EXPECT_EQ(problem.severity, slip.severity) << to_string(problem);
  EXPECT_FALSE(problem.node.empty());
}

const Slip kSlips[] = {
    {"mass='42'", "masss='42'", "masss=", unknown_name, "did you mean 'mass'?"},
    {"mass='42'", "Mass='42'", "Mass=", unknown_name, "did you mean 'mass'?"},
    {"mass='42'", "mass='42 kg'", "mass='42 kg'", invalid_value, "mass: 'kg'"},
    {"mass='42'", "mass='4,2'", "4,2", invalid_value, "4.2"},
    {"position='0 0.55 0'", "position='0 0,55 0'", "0,55", invalid_value, "position: '0,55'"},
    {"position='0 0.55 0'", "position='1e308 0.55 0'", "1e308", invalid_value, "-10000 to 10000"},
    {"axis='-0.79", "axis='1e308 0 0' class='", "1e308", invalid_value, "axis: 1e+308"},
    {"inertia='20.4 0 0 0 20.3", "inertia='1e308 0 0 0 1e308", "1e308", invalid_value, "inertia: 1e+308"},
    {"value='0 0.8 0.75'", "value='0 1e308 0.75'", "1e308", invalid_value, "'position': 1e+308"},
    {"value='0 0.8 0.75'", "value='0 0,8 0.75'", "0,8", invalid_value, "point: 0.8"},
    {"name='lift' value='1.14", "name='lift' value='1,14", "1,14", invalid_value, "point: 1.14"},
    {"name='next' value='\"seat\"'", "name='next' value='\u201cseat\u201d'", "\u201cseat", invalid_value,
     "value='\"seat\"'"},
    {"mass='42'", "mass=\u201c42\u201d", "mass=\u201c", damaged, "write mass='...'"},
    {"fixed='true'", "fixed='yes'", "fixed='yes'", invalid_value, "fixed: 'yes'"},
    {"fixed='true'", "fixed='TRUE'", "fixed='TRUE'", invalid_value, "fixed: 'TRUE'"},
    {"url='\"../models", "url='../models", "<Inline", invalid_value, "url: "},
    {"<RigidBodyCollection DEF='PHYSICS'", "<RigidBodyColection DEF='PHYSICS'", "</RigidBodyCollection>", damaged,
     "</RigidBodyColection>"},
    {"<Background skyColor='0.80 0.88 0.98'/>", "<Backgroud skyColor='0.80 0.88 0.98'/>", "<Backgroud", unknown_name,
     "did you mean 'Background'?"},
    {"<Background skyColor='0.80 0.88 0.98'/>", "<Background skyColor='0.80 88 0.98'/>", "<Background", invalid_value,
     "skyColor: 88"},
    {"<Background skyColor='0.80 0.88 0.98'/>", "<Unheard/>", "<Unheard", unknown_name, "<Unheard>",
     x3d::Severity::warning},
    {"<Background skyColor='0.80 0.88 0.98'/>", "<Background colour='1 1 1'/>", "<Background", unknown_name, "'colour'",
     x3d::Severity::warning},
    {"<RigidBody containerField='body1' USE='OUTER'/>", "<RigidBody containerField='bodyy1' USE='OUTER'/>", "bodyy1",
     conflict, "containerField='body1' or 'body2'"},
    {"<RigidBody containerField='body1' USE='OUTER'/>", "<RigidBody USE='OUTER'/>", "<RigidBody USE='OUTER'/>",
     ErrorCode::missing, "containerField='body1' or 'body2'"},
    {"<SingleAxisHingeJoint DEF", "<Box/>\n<SingleAxisHingeJoint DEF", "<Box/>", conflict, "Shape"},
    {"containerField='metadata' name='mechane:agent'", "containerField='metdata' name='mechane:agent'", "metdata",
     conflict, "write containerField='metadata'"},
    {"name='mechane:haptic'", "name='mechane:hpatic'", "mechane:hpatic", unknown_name,
     "did you mean 'mechane:haptic'?"},
    {"name='mechane:agent'", "name='mechane:haptic'", "name='mechane:haptic'>\n          <MetadataString", conflict,
     "'mechane:haptic'"},
    {"name='mechane:scenario'", "name='mechane:scenaro'", "mechane:scenaro", unknown_name,
     "did you mean 'mechane:scenario'?"},
    {"<MetadataInteger containerField='value' name='format'", "<MetadataInteger name='format'", "name='format'",
     ErrorCode::missing, "1 metadata node", x3d::Severity::warning},
    {"</Scene>", "<ROUTE fromNode='INER' fromField='position' toNode='OUTER' toField='position'/></Scene>", "<ROUTE",
     unknown_name, "fromNode: no element has the DEF 'INER'; did you mean 'INNER'?"},
    {"<MetadataString containerField='value' name='op'", "<MetadataDouble containerField='value' name='op'",
     "<MetadataDouble containerField='value' name='op'", invalid_value, "MetadataString"},
    {"name='next' value='\"seat\"'", "name='next' value='seat'", "value='seat'", invalid_value, "value='\"seat\"'"},
    {"name='next' value='\"seat\"'", "name='next' value='“seat” \"lift\"'", "value='“seat” ", invalid_value,
     "write value='\"seat\" \"lift\"'"},
    {"name='next' value='\"seat\"'", "name='next' value='\"seat\" lift'", "value='\"seat\" lift'", invalid_value,
     "write value='\"seat\" \"lift\"'"},
    {"name='next' value='\"seat\"'", "name='next' value='\"seat\" \"lift'", "value='\"seat\" \"lift'", invalid_value,
     "write value='\"seat\" \"lift\"'"},
    {"</Scene>", "stray</Scene>", "stray</Scene>", not_supported, "'stray'", x3d::Severity::warning},
    {"name='value' value='15'", "name='value' value='90'", "value='90'", conflict,
     "'basin' goes from 0 to 87 l (basinCapacity of PUMP), and the rule asks for more than 90"},
    {"name='value' value='15'", "name='value' value='15 l'", "value='15 l'", invalid_value, "'l'"},
};

INSTANTIATE_TEST_SUITE_P(OfAnAuthor, Slips, ::testing::ValuesIn(kSlips));

TEST(XmlMistakes, NameThePlaceAndTheWayOut) {
  struct Mistake {
    const char* from;
    const char* to;
    const char* at;  // text on the line of the problem; null: any line
    const char* name;
  };
  const Mistake mistakes[] = {
      {"info='\"Vitruvius", "info='\"Vitruvius & Vitruvius", "<WorldInfo", "&amp;"},
      {"info='\"Vitruvius", "info='\"&eacute;", "<WorldInfo", "&eacute;"},
      {"title='Archimedes&apos; screw'", "title='Archimedes' screw'", "<WorldInfo", "write &apos; there"},
      {"title='Archimedes&apos; screw'", "title='Archimedes", "<WorldInfo", "a quote is left over"},
      {"mass='42'", "mass=42", "mass=42", "write mass='...'"},
      {"mass='42'", "mass='42' mass='43'", "mass='43'", "'mass' is written twice"},
      {"mass='42'", "mass='42'inertia='1'", "'inertia='1'", "'inertia'"},
      {"<RigidBody containerField='body1' USE='OUTER'/>", "<RigidBody containerField='body1' USE='OUTER'>",
       "</SingleAxisHingeJoint>", "</RigidBody>"},
      {"value='\"SEAT\"'/>\n          </MetadataSet>", "value='\"SEAT\"'/>", "</WorldInfo>",
       "<MetadataSet> of line 48"},
      {"</X3D>", "", "<X3D", "write </X3D>"},
      {"</X3D>", "</X3D></X3D>", "</X3D>", "</X3D> closes nothing"},
      {"</X3D>", "</X3D><X3D/>", "</X3D>", "<X3D>...</X3D>"},
      {"-->", "->", nullptr, "write -->"},
      {"<!-- 37 degrees", "<!-- 37 -- degrees", "<!-- 37", "one dash"},
      {"value='\"&lt;\"'", "value='\"<\"'", "value='\"<\"'", "write &lt;"},
  };
  for (const Mistake& mistake : mistakes) {
    std::string text = text_of(shipped_file());
    const std::string from = mistake.from;
    const std::size_t at = mistake.from == std::string("-->") ? text.rfind(from) : text.find(from);
    if (at == std::string::npos) continue;  // the shipped file has no such place now
    text.replace(at, from.size(), mistake.to);
    const Outcome outcome = compile_text(text);
    EXPECT_FALSE(outcome.world) << mistake.to;
    const int line = mistake.at == nullptr ? kAnyLine : line_of(text, mistake.at);
    static_cast<void>(outcome.find(damaged, line, mistake.name));
  }
}

TEST(NodeCheck, AMetadataNodeUsedTwiceIsCheckedOnce) {
  const Outcome outcome = compile_text(edited("<Background skyColor", "<Background groundAngle='x' skyColor"));
  int said = 0;
  for (const x3d::Problem& p : outcome.problems)
    said += p.what.find("groundAngle") != std::string::npos ? 1 : 0;
  EXPECT_EQ(said, 1);
}

Outcome compile_shared(const std::string& name) {
  x3d::Problems problems(name);
  FakeLoader loader;
  auto world = read_scenario(shared_folder() / "x3d" / name, loader, problems);
  return {std::move(world), problems.all()};
}

TEST(SharedFiles, LoadWithoutErrorsAndSayWhatIsNotSimulated) {
  if (!std::filesystem::exists(shared_folder() / "x3d/rigid_body"))
    GTEST_SKIP() << "no sample files beside the project";
  std::size_t loaded = 0;
  std::map<std::string, std::string> unused;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_folder() / "x3d")) {
    if (entry.path().extension() != ".x3d") continue;
    x3d::Problems problems(entry.path().filename().string());
    FakeLoader loader;
    const auto world = read_scenario(entry.path(), loader, problems);
    EXPECT_TRUE(world.has_value()) << (world ? "" : world.error().to_string());
    for (const x3d::Problem& note : problems.all())
      if (note.severity == x3d::Severity::note) {
        EXPECT_TRUE(note.line > 0 && !note.remedy.empty()) << entry.path() << ": " << note.what;
        unused[entry.path().filename().string()] += note.node + '\n';
      }
    ++loaded;
  }
  EXPECT_GE(loaded, 10u);
  // All of these is simulated; of the others something is not, and the notes name it.
  for (const char* whole :
       {"sim-collision.x3d", "sim-damper.x3d", "sim-joints.x3d", "sim-physics.x3d", "sim-vehicle.x3d"})
    EXPECT_EQ(unused[whole], "") << whole;
  EXPECT_NE(unused["JoeKick.x3d"].find("HAnimHumanoid"), std::string::npos);
}

TEST(SharedFiles, JointsStandAsTheStandardSays) {
  if (!std::filesystem::exists(shared_folder() / "x3d/rigid_body"))
    GTEST_SKIP() << "no sample files beside the project";
  // One body alone hangs on the world, about the anchor; gravity as written.
  const Outcome ball = compile_shared("rigid_body/sim-joints.x3d");
  ASSERT_TRUE(ball.world) << ball.world.error().to_string();
  ASSERT_EQ(ball.world->joints.size(), 1u);
  EXPECT_EQ(ball.world->joints[0].kind, state::JointKind::ball);
  EXPECT_FALSE(ball.world->joints[0].body1);
  EXPECT_EQ(ball.world->joints[0].X_B2J.p, Vec3(-1, 0, 0));
  EXPECT_EQ(ball.world->gravity_W, Vec3(0, -9.8, 0));
  // Four hinges without stops, each about the car's x axis through its wheel, whose body lies turned.
  const Outcome car = compile_shared("rigid_body/sim-vehicle.x3d");
  ASSERT_TRUE(car.world) << car.world.error().to_string();
  ASSERT_EQ(car.world->joints.size(), 4u);
  for (const state::JointDescription& joint : car.world->joints) {
    EXPECT_EQ(joint.kind, state::JointKind::hinge);
    EXPECT_GT(joint.min_position, joint.max_position) << "X3D's default stops are a half turn: none";
    const Pose X_WJ = car.world->bodies[joint.body1.index()].X_WB * joint.X_B1J;
    EXPECT_LT((X_WJ.R * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-9);
    EXPECT_LT((car.world->bodies[joint.body1.index()].X_WB.p - X_WJ.p).norm(), 1e-9);
  }
}

TEST(PlainFiles, AreScenesWithNothingToDo) {
  const Outcome plain = compile_text(
      "<X3D version='4.0'><Scene><RigidBodyCollection><RigidBody DEF='A'/>\n"
      "<UniversalJoint><RigidBody containerField='body1' USE='A'/></UniversalJoint>"
      "</RigidBodyCollection></Scene></X3D>");
  ASSERT_TRUE(plain.world) << plain.world.error().to_string();
  EXPECT_EQ(plain.world->bodies.size(), 1u);
  EXPECT_EQ(plain.world->gravity_W, Vec3(0, -9.8, 0)) << "X3D's default";
  EXPECT_EQ(plain.find(not_supported, 2, "UniversalJoint").severity, x3d::Severity::note);
  EXPECT_EQ(plain.find(ErrorCode::missing, 1, "mechane:scenario").severity, x3d::Severity::warning);
}

TEST(DamagedFiles, GiveProblemsOrWorldsNeverCrashes) {
  const std::string whole = text_of(shipped_file());
  EXPECT_TRUE(rc::check([&] {
    std::string text = whole;
    for (int i = *rc::gen::inRange(1, 6); i > 0; --i) {
      const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
      const auto length = *rc::gen::inRange<std::size_t>(0, 40);
      const auto with =
          *rc::gen::element<std::string>("", "'", "<", "&", "nan", "1e999", "\"", "USE='INNER'", "-1", "\xce");
      text.replace(at, length, with);
    }
    const Outcome outcome = compile_text(text);
    if (outcome.world) return;
    RC_ASSERT(std::any_of(outcome.problems.begin(), outcome.problems.end(), [](const x3d::Problem& p) {
      return p.severity == x3d::Severity::error && !p.what.empty() && !p.remedy.empty();
    }));
  }));
}

}  // namespace
}  // namespace mechane::scenario
