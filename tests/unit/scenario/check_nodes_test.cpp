// Elements held against X3D's tables and ours: typos, types, places; what is not simulated.
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "server/x3d/schema.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

// What an author writes wrong: the edit, where the problem must point, what it must say.
struct Slip {
  const char* from;
  const char* to;
  const char* at;
  const char* words;
  x3d::Severity severity = x3d::Severity::error;
};

void PrintTo(const Slip& slip, std::ostream* out) {
  *out << slip.to;
}

class Slips : public ::testing::TestWithParam<Slip> {};

TEST_P(Slips, AreNamedWithLineNodeAndRemedy) {
  const Slip& slip = GetParam();
  const std::string text = edited(slip.from, slip.to);
  const Outcome outcome = compile_text(text);
  EXPECT_EQ(outcome.world.has_value(), slip.severity != x3d::Severity::error);
  const x3d::Problem problem = outcome.find(slip.words);
  EXPECT_EQ(problem.line, line_of(text, slip.at)) << to_string(problem);
  EXPECT_EQ(problem.severity, slip.severity) << to_string(problem);
  EXPECT_FALSE(problem.node.empty());
  EXPECT_FALSE(problem.remedy.empty());
}

const Slip kSlips[] = {
    {"mass='42'", "masss='42'", "masss=", "no attribute 'masss', and it does nothing; did you mean 'mass'?"},
    {"mass='42'", "Mass='42'", "Mass=", "did you mean 'mass'?"},
    {"mass='42'", "mass='42 kg'", "mass='42 kg'", "mass: 'kg' is not a number"},
    {"mass='42'", "mass='4,2'", "4,2", "write a decimal point: 4.2"},
    {"position='0 0.55 0'", "position='0 0,55 0'", "0,55", "'0,55' is read as two numbers"},
    {"position='0 0.55 0'", "position='1e308 0.55 0'", "1e308", "write -10000 to 10000"},
    {"axis='-0.79", "axis='1e308 0 0' class='", "1e308", "axis: 1e+308 is out of its range"},
    {"inertia='20.4 0 0 0 20.3", "inertia='1e308 0 0 0 1e308", "1e308", "is out of its range"},
    {"value='0 0.8 0.75'", "value='0 1e308 0.75'", "1e308", "is out of its range"},
    {"value='0 0.8 0.75'", "value='0 0,8 0.75'", "0,8", "write a decimal point: 0.8"},
    {"name='lift' value='1.14", "name='lift' value='1,14", "1,14", "write a decimal point"},
    {"name='next' value='\"seat\"'", "name='next' value='\u201cseat\u201d'", "\u201cseat", "write value='\"seat\"'"},
    {"mass='42'", "mass=\u201c42\u201d", "mass=\u201c", "in curly quotes, not in straight ones"},
    {"fixed='true'", "fixed='yes'", "fixed='yes'", "fixed: 'yes' is neither true nor false; write true or false"},
    {"fixed='true'", "fixed='TRUE'", "fixed='TRUE'", "write true or false"},
    {"url='\"../models", "url='../models", "<Inline", "url: a string"},
    {"<RigidBodyCollection DEF='PHYSICS'", "<RigidBodyColection DEF='PHYSICS'", "</RigidBodyCollection>",
     "not well-formed XML: </RigidBodyCollection> comes where </RigidBodyColection> is awaited"},
    {"<Background skyColor='0.80 0.88 0.98'/>", "<Backgroud skyColor='0.80 0.88 0.98'/>", "<Backgroud",
     "X3D has no element <Backgroud>, and it does nothing; did you mean 'Background'?"},
    {"<Background skyColor='0.80 0.88 0.98'/>", "<Background skyColor='0.80 88 0.98'/>", "<Background",
     "skyColor: 88 is out of its range; write numbers from 0 to 1"},
    {"<Background skyColor='0.80 0.88 0.98'/>", "<Unheard/>", "<Unheard", "X3D has no element <Unheard>",
     x3d::Severity::warning},
    {"<Background skyColor='0.80 0.88 0.98'/>", "<Background colour='1 1 1'/>", "<Background",
     "a Background has no attribute 'colour'", x3d::Severity::warning},
    {"<RigidBody containerField='body1' USE='OUTER'/>", "<RigidBody containerField='bodyy1' USE='OUTER'/>", "bodyy1",
     "containerField='bodyy1': a SingleAxisHingeJoint has no such field for a RigidBody; write "
     "containerField='body1' or 'body2'"},
    {"<RigidBody containerField='body1' USE='OUTER'/>", "<RigidBody USE='OUTER'/>", "<RigidBody USE='OUTER'/>",
     "which field of the SingleAxisHingeJoint it fills"},
    {"<SingleAxisHingeJoint DEF", "<Box/>\n<SingleAxisHingeJoint DEF", "<Box/>",
     "a Box cannot stand in a RigidBodyCollection; move it into a Shape"},
    {"containerField='metadata' name='mechane:agent'", "containerField='metdata' name='mechane:agent'", "metdata",
     "write containerField='metadata'"},
    {"name='mechane:haptic'", "name='mechane:hpatic'", "mechane:hpatic", "did you mean 'mechane:haptic'?"},
    {"name='mechane:agent'", "name='mechane:haptic'", "name='mechane:haptic'>\n          <MetadataString",
     "'mechane:haptic' does nothing on a SingleAxisHingeJoint; put it on one of: RigidBody"},
    {"name='mechane:scenario'", "name='mechane:scenaro'", "mechane:scenaro", "did you mean 'mechane:scenario'?"},
    {"<MetadataInteger containerField='value' name='format'", "<MetadataInteger name='format'", "name='format'",
     "1 metadata node is without containerField", x3d::Severity::warning},
    {"</Scene>", "<ROUTE fromNode='INER' fromField='position' toNode='OUTER' toField='position'/></Scene>", "<ROUTE",
     "fromNode: no element has the DEF 'INER'; did you mean 'INNER'?"},
    {"<MetadataString containerField='value' name='op'", "<MetadataDouble containerField='value' name='op'",
     "<MetadataDouble containerField='value' name='op'", "a MetadataDouble cannot hold text; write a MetadataString"},
    {"name='next' value='\"seat\"'", "name='next' value='seat'", "value='seat'", "write value='\"seat\"'"},
    {"</Scene>", "stray</Scene>", "stray</Scene>", "the text 'stray' between elements does nothing",
     x3d::Severity::warning},
    {"name='value' value='15'", "name='value' value='90'", "value='90'",
     "this can never hold: 'basin' goes from 0 to 87 l (basinCapacity of PUMP), and the rule asks for more than 90"},
    {"name='value' value='15'", "name='value' value='15 l'", "value='15 l'", "'l' is not a number"},
};

INSTANTIATE_TEST_SUITE_P(OfAnAuthor, Slips, ::testing::ValuesIn(kSlips));

TEST(XmlMistakes, NameThePlaceAndTheWayOut) {
  struct Mistake {
    const char* from;
    const char* to;
    const char* words;
  };
  const Mistake mistakes[] = {
      {"info='\"Vitruvius", "info='\"Vitruvius & Vitruvius",
       "a bare & stands in the text; write &amp; for the letter &"},
      {"info='\"Vitruvius", "info='\"&eacute;", "&eacute; is not a letter that XML knows"},
      {"title='Archimedes&apos; screw'", "title='Archimedes' screw'",
       "'screw' in the tag <WorldInfo> has no value; the quote before it ended the value: write &apos; there"},
      {"title='Archimedes&apos; screw'", "title='Archimedes",
       "stands in the tag <WorldInfo> where an attribute should; a quote is left over"},
      {"mass='42'", "mass=42", "the value of 'mass' in the tag <RigidBody> is not in quotes; write mass='...'"},
      {"mass='42'", "mass='42' mass='43'", "'mass' is written twice in one tag <RigidBody>"},
      {"mass='42'", "mass='42'inertia='1'", "no blank stands before 'inertia'"},
      {"<RigidBody containerField='body1' USE='OUTER'/>", "<RigidBody containerField='body1' USE='OUTER'>",
       "</SingleAxisHingeJoint> comes where </RigidBody> is awaited"},
      {"value='\"SEAT\"'/>\n          </MetadataSet>", "value='\"SEAT\"'/>",
       "by the indentation it is <MetadataSet> of line 48 that is not closed"},
      {"</X3D>", "", "<X3D> is never closed; write </X3D>"},
      {"</X3D>", "</X3D></X3D>", "</X3D> closes nothing"},
      {"</X3D>", "</X3D><X3D/>", "there is a second outermost element"},
      {"-->", "->", "a comment is never closed"},
      {"<!-- 37 degrees", "<!-- 37 -- degrees", "-- stands inside a comment"},
      {"value='\"&lt;\"'", "value='\"<\"'", "write &lt;"},
  };
  for (const Mistake& mistake : mistakes) {
    std::string text = text_of(shipped_file());
    const std::string from = mistake.from;
    const std::size_t at = mistake.from == std::string("-->") ? text.rfind(from) : text.find(from);
    if (at == std::string::npos) continue;  // the shipped file has no such place now
    text.replace(at, from.size(), mistake.to);
    const Outcome outcome = compile_text(text);
    EXPECT_FALSE(outcome.world) << mistake.to;
    const x3d::Problem problem = outcome.find(mistake.words);
    EXPECT_GT(problem.line, 0) << to_string(problem);
    EXPECT_FALSE(problem.remedy.empty());
    EXPECT_TRUE(problem.what.starts_with("not well-formed XML")) << to_string(problem);
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
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_folder() / "x3d")) {
    if (entry.path().extension() != ".x3d") continue;
    x3d::Problems problems(entry.path().filename().string());
    FakeLoader loader;
    const auto world = read_scenario(entry.path(), loader, problems);
    EXPECT_TRUE(world.has_value()) << (world ? "" : world.error().to_string());
    EXPECT_TRUE(std::any_of(problems.all().begin(), problems.all().end(), [](const x3d::Problem& p) {
      return p.severity == x3d::Severity::note && p.line > 0 && !p.remedy.empty();
    })) << entry.path();
    ++loaded;
  }
  EXPECT_GE(loaded, 10u);
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
  static_cast<void>(ball.find("CollidableShape: it is not simulated"));
  static_cast<void>(ball.find("ROUTE"));
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
  static_cast<void>(car.find("torques is not simulated"));
}

TEST(PlainFiles, AreScenesWithNothingToDo) {
  const Outcome plain = compile_text(
      "<X3D version='4.0'><Scene><RigidBodyCollection><RigidBody DEF='A'/>\n"
      "<UniversalJoint><RigidBody containerField='body1' USE='A'/></UniversalJoint>"
      "</RigidBodyCollection></Scene></X3D>");
  ASSERT_TRUE(plain.world) << plain.world.error().to_string();
  EXPECT_EQ(plain.world->bodies.size(), 1u);
  EXPECT_EQ(plain.world->gravity_W, Vec3(0, -9.8, 0)) << "X3D's default";
  EXPECT_EQ(plain.find("UniversalJoint: it is not simulated").severity, x3d::Severity::note);
  EXPECT_EQ(plain.find("nothing to do in it").severity, x3d::Severity::warning);
}

TEST(DamagedFiles, GiveProblemsOrWorldsNeverCrashes) {
  const std::string whole = text_of(shipped_file());
  rc::check([&] {
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
  });
}

}  // namespace
}  // namespace mechane::scenario
