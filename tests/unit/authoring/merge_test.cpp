// Two scenarios in one file: names that clash change everywhere.
#include "client-sdk/authoring/merge.hpp"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "client-sdk/authoring/reference_example.hpp"
#include "client-sdk/authoring/rename.hpp"
#include "server/scenario/checker.hpp"
#include "server/scenario/mesh_finder.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::authoring {
namespace {

using namespace scenario;

class MergeFiles : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder / "in"); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / "in" / name, std::ios::binary) << text;
    return (folder / "in" / name).string();
  }

  const test::ScratchFolder scratch;
  const std::filesystem::path& folder = scratch.path();
};

/// Merges, reads the result as of `path`, compiles it.
state::WorldDescription merged_world(const std::vector<std::string>& files, const std::filesystem::path& path) {
  const auto merged = merge_files(files, path);
  EXPECT_TRUE(merged) << merged.error().to_string();
  if (!merged) return {};
  x3d::Problems problems("merged.x3d");
  const auto document = x3d::read_document(merged->text, path, problems);
  EXPECT_TRUE(document) << document.error().to_string();
  if (!document) return {};
  FakeLoader loader;
  auto world = scenario::compile(*document, loader, problems);
  for (const x3d::Problem& p : problems.all())
    ADD_FAILURE() << to_string(p);
  return world ? std::move(*world) : state::WorldDescription{};
}

TEST_F(MergeFiles, TheScrewWithItselfIsTwoScrews) {
  const std::string file = shipped_file().string();
  const state::WorldDescription one = *compile_text(text_of(shipped_file())).world;
  const state::WorldDescription two = merged_world({file, file}, folder / "two-screws.x3d");
  EXPECT_EQ(two.id, "two-screws");
  ASSERT_EQ(two.bodies.size(), 2 * one.bodies.size());
  ASSERT_EQ(two.steps.size(), 2 * one.steps.size());
  ASSERT_EQ(two.agents.size(), 2 * one.agents.size());
  EXPECT_EQ(two.machines.size(), 2u);
  EXPECT_EQ(two.quantities.size(), 2 * one.quantities.size());
  EXPECT_EQ(two.activities.size(), 4u);
  EXPECT_EQ(two.visits.size(), 4u);
  ASSERT_EQ(two.joints.size(), 2u);
  ASSERT_EQ(two.mates.size(), 2u);
  EXPECT_EQ(two.bodies[0].mesh.content_hash, one.bodies[0].mesh.content_hash);
  // The second half names only itself: each reference is the first half's, moved by a half.
  const auto& inner = two.bodies[two.find_body("INNER_2").index()];
  EXPECT_EQ(inner.mesh.node, "INNER") << "a node of the mesh file keeps its name";
  EXPECT_EQ(two.joints[1].body2, two.find_body("INNER_2"));
  EXPECT_EQ(two.mates[1].body1, two.find_body("INNER_2"));
  const auto& take = two.steps[two.find_step("take_2").index()];
  EXPECT_EQ(take.bodies[0].body, two.find_body("INNER_2"));
  EXPECT_EQ(take.enable, (std::vector<AgentId>{two.find_agent("CARRY_2"), two.find_agent("SEAT_2")}));
  EXPECT_EQ(take.triggers[0].quantity, two.find_quantity("carried_2"));
  EXPECT_EQ(take.triggers[0].next, two.find_step("seat_2"));
  EXPECT_EQ(two.quantities[two.find_quantity("basin_2").index()].source, "PUMP_2.basin_l");
  EXPECT_EQ(two.visits[3].activity, two.find_activity("use_2"));
  EXPECT_EQ(two.visits[3].moves[0].body, two.find_body("INNER_2"));
  ASSERT_EQ(two.effects.size(), 2 * one.effects.size());
  const auto& spout = two.effects[one.effects.size() + 1];
  EXPECT_EQ(spout.name, "SPOUT_2");
  EXPECT_EQ(spout.body, two.find_body("OUTER_2"));
  EXPECT_EQ(spout.quantity, two.find_quantity("flow_2"));
  EXPECT_EQ(two.steps[two.find_step("fill_2").index()].detail, "BASIN_VIEW_2");
  const auto& placed = two.agents[two.find_agent("SEATED_2").index()];
  EXPECT_EQ(std::get<std::vector<std::string>>(placed.parameters.at("snap")), std::vector<std::string>{"SEAT_2"});
}

TEST_F(MergeFiles, TheResultHoldsAgainstTheStandardsSchema) {
  const auto schema = shared_folder() / "x3d/schema/x3d-4.0.xsd";
  if (!std::filesystem::exists(schema)) GTEST_SKIP() << "the standard's schema is not beside the project";
  const std::string file = shipped_file().string();
  const std::string bare = write("bare.x3d",
                                 "<X3D profile='Interactive' version='4.0'>\n<head>\n<meta name='title' "
                                 "content='bare'/>\n</head>\n<Scene/>\n</X3D>\n");
  for (const auto& files : {std::vector<std::string>{file, file}, std::vector<std::string>{bare, file}}) {
    const auto merged = merge_files(files, folder / "in/both.x3d");
    ASSERT_TRUE(merged);
    const std::string both = write("both.x3d", merged->text);
    EXPECT_EQ(std::system(("xmllint --nonet --noout --schema '" + schema.string() + "' '" + both + "'").c_str()), 0);
  }
}

TEST_F(MergeFiles, ThreeTimesAndMergedAgainStillReads) {
  const std::string file = shipped_file().string();
  const auto twice = merge_files(std::vector<std::string>{file, file}, folder / "in/two.x3d");
  ASSERT_TRUE(twice);
  const std::string two = write("two.x3d", twice->text);
  const state::WorldDescription world = merged_world({two, file, two}, folder / "five.x3d");
  EXPECT_EQ(world.bodies.size(), 10u);
  EXPECT_TRUE(world.find_body("INNER_2"));
  EXPECT_TRUE(world.find_body("INNER_3"));
}

TEST_F(MergeFiles, PathsAreRightFromWhereTheResultLies) {
  const std::string file = shipped_file().string();
  const auto out = source_folder() / "scenarios/archimedes-screw/nowhere/deeper/both.x3d";
  const auto merged = merge_files(std::vector<std::string>{file, file}, out);
  ASSERT_TRUE(merged);
  EXPECT_EQ(merged->text.find("'\"../models/"), std::string::npos);
  std::size_t found = 0;
  for (std::size_t at = merged->text.find("../../../models/archimedes-screw.glb"); at != std::string::npos;
       at = merged->text.find("../../../models/archimedes-screw.glb", at + 1))
    ++found;
  EXPECT_EQ(found, 2u);
}

TEST_F(MergeFiles, ABodyWithoutAMeshNodeOfItsOwnKeepsTheOneOfItsFirstName) {
  const std::string key = "<MetadataString containerField='value' name='node' value='\"INNER\"'/>";
  const std::string file = write("nodeless.x3d", edited(key, ""));
  const state::WorldDescription two = merged_world({file, file}, folder / "in/both.x3d");
  ASSERT_TRUE(two.find_body("INNER_2"));
  EXPECT_EQ(two.bodies[two.find_body("INNER").index()].mesh.node, "INNER");
  EXPECT_EQ(two.bodies[two.find_body("INNER_2").index()].mesh.node, "INNER");
}

/// The working folder of this process, for as long as this lives.
class InFolder {
 public:
  explicit InFolder(const std::filesystem::path& folder) { std::filesystem::current_path(folder); }
  ~InFolder() { std::filesystem::current_path(before_); }
  InFolder(const InFolder&) = delete;
  InFolder& operator=(const InFolder&) = delete;

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
};

TEST_F(MergeFiles, FilesMayBeNamedWithoutAFolder) {
  const std::string scene = "<X3D version='4.0'><Scene>\n<Inline DEF='IN' url='\"models/a.x3d\"'/>\n</Scene></X3D>";
  write("one.x3d", scene);
  const std::string other = write("other.x3d", scene);
  const InFolder in(folder / "in");
  const auto here = merge_files(std::vector<std::string>{"one.x3d", other}, "both.x3d");
  ASSERT_TRUE(here) << here.error().to_string();
  EXPECT_EQ(here->text.find("../"), std::string::npos) << here->text;
  std::filesystem::create_directory("deeper");
  const auto below = merge_files(std::vector<std::string>{"one.x3d", "./other.x3d"}, "deeper/both.x3d");
  ASSERT_TRUE(below) << below.error().to_string();
  EXPECT_NE(below->text.find("<Inline DEF='IN' url='\"../models/a.x3d\"'/>"), std::string::npos) << below->text;
  EXPECT_NE(below->text.find("<Inline DEF='IN_2' url='\"../models/a.x3d\"'/>"), std::string::npos) << below->text;
}

TEST_F(MergeFiles, RoutesImportsExportsAndPrototypesFollow) {
  const std::string text =
      "<X3D version='4.0'><Scene>\n<Inline DEF='IN' url='\"a.x3d\"'/>\n"
      "<IMPORT inlineDEF='IN' importedDEF='LAMP'/>\n<IMPORT inlineDEF='IN' importedDEF='FAR' AS='NEAR'/>\n"
      "<ProtoDeclare name='P'><ProtoBody><Group DEF='A'/></ProtoBody></ProtoDeclare>\n"
      "<ProtoInstance DEF='I' name='P'/>\n<Group DEF='A'/><Group USE='A'/>\n<EXPORT localDEF='A'/>\n"
      "<!-- kept -->\n<ROUTE fromNode='NEAR' fromField='x' toNode='A' toField='y'/>\n</Scene></X3D>";
  const std::string file = write("routes.x3d", text);
  const auto merged = merge_files(std::vector<std::string>{file, file}, folder / "in/both.x3d");
  ASSERT_TRUE(merged) << merged.error().to_string();
  const std::string& both = merged->text;
  for (const char* words :
       {"<Inline DEF='IN_2' url='\"a.x3d\"'/>", "<IMPORT inlineDEF='IN_2' importedDEF='LAMP' AS='LAMP_2'/>",
        "<IMPORT inlineDEF='IN_2' importedDEF='FAR' AS='NEAR_2'/>",
        "<ProtoDeclare name='P_2'><ProtoBody><Group DEF='A'/>", "<ProtoInstance DEF='I_2' name='P_2'/>",
        "<Group DEF='A_2'/><Group USE='A_2'/>", "<EXPORT localDEF='A_2'/>",
        "<ROUTE fromNode='NEAR_2' fromField='x' toNode='A_2' toField='y'/>"})
    EXPECT_NE(both.find(words), std::string::npos) << words << "\n" << both;
  EXPECT_NE(both.find("<!-- kept -->"), both.rfind("<!-- kept -->")) << "comments of both";
  EXPECT_TRUE(both.starts_with(text.substr(0, text.find("</Scene>") - 1))) << "the first file stays as it was";
}

TEST_F(MergeFiles, WhatTheFirstFileLacksIsTakenWhole) {
  const std::string plain =
      write("plain.x3d", "<X3D profile='Interactive' version='4.0'>\n<head/>\n<Scene>\n</Scene>\n</X3D>\n");
  const state::WorldDescription world = merged_world({plain, shipped_file().string()}, folder / "in/whole.x3d");
  EXPECT_EQ(world.activities.size(), 2u);
  EXPECT_EQ(world.bodies.size(), 2u);
}

TEST_F(MergeFiles, TheCommandWritesChecksAndSaysWhatItDid) {
  const std::string file = shipped_file().string();
  const std::string out = (folder / "two.x3d").string();
  std::ostringstream said;
  EXPECT_EQ(run_merge(std::vector<std::string>{file, file}, out, said), 0) << said.str();
  EXPECT_NE(said.str().find("the step turn of " + file + " is now turn_2"), std::string::npos) << said.str();
  EXPECT_NE(said.str().find("1 file: 0 errors, 0 warnings\n"), std::string::npos) << said.str();
  EXPECT_TRUE(std::filesystem::exists(out));
  std::ostringstream none;
  EXPECT_EQ(run_merge(std::vector<std::string>{file}, out, none), 2);
  EXPECT_EQ(merge_files(std::vector<std::string>{file}, out).error().code, ErrorCode::missing);
  EXPECT_EQ(merge_files(std::vector<std::string>{file, "nowhere.x3d"}, out).error().code, ErrorCode::not_found);
  EXPECT_EQ(run_merge(std::vector<std::string>{file, "nowhere.x3d"}, out, none), 2);
  EXPECT_NE(none.str().find("nowhere.x3d"), std::string::npos);
}

TEST_F(MergeFiles, FormulasNameTheJointsOfTheirOwnFile) {
  const auto variations = reference_variations();
  const auto own = std::ranges::find(variations, "A machine of your own", &Variation::title);
  ASSERT_NE(own, variations.end());
  std::string text = reference_example_with(*own);
  replace_first(text, "\"-pull\"", "\"-pull * step(quantity.turns &lt; 3)\"");
  const state::WorldDescription two =
      merged_world({write("one.x3d", text), write("other.x3d", text)}, folder / "in" / "two.x3d");
  const MachineId second = two.find_machine("SPRING_2");
  ASSERT_TRUE(second);
  const state::ComponentDescription& machine = two.machines[second.index()];
  EXPECT_EQ(machine.written<std::vector<std::string>>("values")->at(0),
            "pull = 0.4 N m/rad * clamp(AXLE_2.angle, 0 rad, 2 turns) in N m");
  EXPECT_EQ(*machine.written_text("load"), "-pull * step(quantity.turns_2 < 3)");
  EXPECT_EQ(*two.machines[0].written_text("load"), "-pull * step(quantity.turns < 3)");
}

TEST(Renames, AreNewToBothFiles) {
  NamesOf ours;
  NamesOf theirs;
  ours.things = {"A", "A_2", "B"};
  theirs.things = {"A", "A_3", "C"};
  const Renames renames = renames_for(ours, theirs);
  EXPECT_EQ(renames.things, (std::map<std::string, std::string>{{"A", "A_4"}}));
  EXPECT_EQ(renames.count(), 1u);
}

/// The shipped file with three coins of one RigidBody, which an agent, a quantity and a step name.
std::string with_coins() {
  const auto value = [](const std::string& node, const std::string& name, const std::string& text) {
    return "<Metadata" + node + " containerField='value' name='" + name + "' value='" + text + "'/>";
  };
  const std::string agents = "<MetadataSet containerField='value' name='agents'>";
  const std::string quantities = "<MetadataSet containerField='value' name='quantities'>";
  const std::string fill = "<MetadataSet containerField='value' name='fill'>";
  return with_edits(
      {{agents, agents + "<MetadataSet containerField='value' name='TAKE'>" +
                    value("String", "type", "\"simulation.grasp\"") +
                    value("String", "bodies", "\"COIN-*\" \"INNER\"") + "</MetadataSet>"},
       {quantities, quantities + value("String", "third", "\"COIN-3.speed\"")},
       {fill, fill + "<MetadataSet containerField='value' name='object:COIN-2'>" +
                  value("Boolean", "visible", "false") + "</MetadataSet>"},
       {"</RigidBodyCollection>",
        "<RigidBody DEF='COIN' containerField='bodies' inertia='1 0 0 0 1 0 0 0 1' position='3 2 3'><MetadataSet "
        "containerField='metadata' name='mechane:body'>" +
            value("String", "model", "\"MODEL\"") + value("String", "node", "\"INNER\"") +
            "<MetadataSet containerField='value' name='copies'>" + value("Double", "count", "3") +
            value("Double", "step", "0 0.5 0") + "</MetadataSet></MetadataSet></RigidBody></RigidBodyCollection>"}});
}

TEST_F(MergeFiles, CopiesOfABodyThatIsRenamedFollowIt) {
  const std::string file = write("coins.x3d", with_coins());
  const auto merged = merge_files(std::vector{file, file}, folder / "in" / "both.x3d");
  ASSERT_TRUE(merged) << merged.error().to_string();
  for (const char* renamed : {"\"COIN_2-*\"", "\"COIN_2-3.speed\"", "'object:COIN_2-2'"})
    EXPECT_NE(merged->text.find(renamed), std::string::npos) << renamed;
  x3d::Problems problems("both.x3d");
  const auto document = x3d::read_document(merged->text, folder / "in" / "both.x3d", problems);
  ASSERT_TRUE(document);
  FakeLoader loader;
  const auto world = scenario::compile(*document, loader, problems);
  ASSERT_TRUE(world) << world.error().to_string();
  for (const char* name : {"COIN-1", "COIN-3", "COIN_2-1", "COIN_2-3"})
    EXPECT_TRUE(world->find_body(name)) << name;
}

}  // namespace
}  // namespace mechane::authoring
