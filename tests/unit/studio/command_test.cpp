// What JSON means, and what commands make of a file: what they do not name stays to the byte.
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client-sdk/studio/draft/draft_loader.hpp"
#include "client-sdk/studio/draft/history.hpp"
#include "client-sdk/studio/edits/apply.hpp"
#include "client-sdk/studio/edits/body_edits.hpp"
#include "server/base/random.hpp"
#include "server/scenario/checker.hpp"
#include "server/scenario/file_finder.hpp"
#include "server/x3d/metadata.hpp"
#include "tests/support/source_files.hpp"
#include "tests/unit/studio/studio_fixture.hpp"

namespace mechane::studio {
namespace {

using test::shipped_file;
using test::source_folder;
using test::text_of;

Command command_of(const std::string& request) {
  auto command = parse_command(request);
  EXPECT_TRUE(command) << request << ": " << command.error().to_string();
  return command.value_or(RemoveEntry{});
}

std::string changed(const std::string& text, const std::vector<std::string>& commands,
                    std::vector<std::string>* added = nullptr) {
  std::vector<Command> list;
  for (const std::string& one : commands)
    list.push_back(command_of(one));
  auto applied = apply_commands(text, shipped_file(), list);
  EXPECT_TRUE(applied) << applied.error().error.to_string();
  if (!applied) return text;
  if (added != nullptr) *added = applied->added;
  return applied->text;
}

Refused refusal_of(const std::string& text, const std::vector<std::string>& commands) {
  std::vector<Command> list;
  for (const std::string& one : commands)
    list.push_back(command_of(one));
  const auto applied = apply_commands(text, shipped_file(), list);
  EXPECT_FALSE(applied) << commands.front();
  return applied ? Refused{} : applied.error();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

std::size_t errors_in(const std::string& text) {
  scenario::FileFinder finder;
  const auto problems = scenario::check_text(text, shipped_file(), finder);
  return static_cast<std::size_t>(std::ranges::count(problems, x3d::Severity::error, &x3d::Problem::severity));
}

TEST(Commands, OneFieldOfEachShippedExhibitChangesOneLine) {
  for (const std::string& name : shipped_exhibits()) {
    const std::string text = text_of(source_folder() / "scenarios" / name / (name + ".x3d"));
    const std::string after =
        changed(text, {R"({"op": "set", "path": "text/title.en", "value": "A title that none has"})"});
    const auto before_lines = lines_of(text), after_lines = lines_of(after);
    ASSERT_EQ(before_lines.size(), after_lines.size()) << name;
    int different = 0;
    for (std::size_t i = 0; i < before_lines.size(); ++i) {
      if (before_lines[i] == after_lines[i]) continue;
      ++different;
      EXPECT_THAT(after_lines[i], ::testing::HasSubstr("A title that none has")) << name;
    }
    EXPECT_EQ(different, 1) << name;
  }
}

TEST(Commands, AllOfThemOrNone) {
  const std::string text = text_of(shipped_file());
  const Refused refused = refusal_of(text, {R"({"op": "set", "path": "effortScale", "value": 0.5})",
                                            R"({"op": "set", "path": "effortScal", "value": 0.5})"});
  EXPECT_EQ(refused.command, 1U);
  EXPECT_THAT(refused.error, is_fault(ErrorCode::unknown_name, {"effortScal"}));
}

TEST(Commands, ASetIsMovedWithItsCommentsAndNothingElse) {
  const auto of = [](const std::string& steps) {
    return "<X3D version='4.0'><Scene><WorldInfo><MetadataSet containerField='metadata' name='mechane:scenario'>"
           "<MetadataSet name='activities'><MetadataSet name='use'>" +
           steps + "</MetadataSet></MetadataSet></MetadataSet></WorldInfo></Scene></X3D>";
  };
  const std::string text =
      of("<!-- of use -->\n  <MetadataString name='first' value='\"b\"'/>\n  <!-- one -->\n  <!-- a, too -->\n"
         "    <MetadataSet name='text'><!-- inner --></MetadataSet>   <!-- at its end -->\n\n\n"
         "  <MetadataSet name='steps'/><!-- of questions --><MetadataSet name='questionnaire'/>\n  <!-- the end -->");
  EXPECT_EQ(changed(text, {R"({"op": "reorder", "path": "activities/use/text", "after": "questionnaire"})"}),
            of("<!-- of use -->\n  <MetadataString name='first' value='\"b\"'/>\n  <MetadataSet name='steps'/>\n\n\n"
               "  <!-- of questions --><MetadataSet name='questionnaire'/><!-- one -->\n  <!-- a, too -->\n"
               "    <MetadataSet name='text'><!-- inner --></MetadataSet>   <!-- at its end -->\n  <!-- the end -->"));
  EXPECT_EQ(changed(text, {R"({"op": "reorder", "path": "activities/use/text"})"}), text);
  for (const auto& [path, after] : std::vector<std::pair<std::string, std::string>>{{"activities/use/first", ""},
                                                                                    {"activities/use/goal", ""},
                                                                                    {"activities/us/steps", ""},
                                                                                    {"activities/use/steps", "steps"},
                                                                                    {"activities/use/steps", "nothing"},
                                                                                    {"activities/use/steps", "use"}}) {
    const Command command = ReorderSet{path, after};
    const auto applied = apply_commands(text, shipped_file(), {&command, 1});
    ASSERT_FALSE(applied) << path << " after " << after;
    EXPECT_THAT(applied.error().error, is_fault(ErrorCode::unknown_name)) << path << " after " << after;
  }
}

TEST(Commands, ASetThatIsMovedBehindItsUseIsAProblem) {
  const std::string text =
      "<X3D version='4.0'><Scene><WorldInfo><MetadataSet containerField='metadata' name='mechane:scenario'>"
      "<MetadataSet name='effects'><MetadataSet DEF='S' name='s'/><MetadataSet USE='S'/><MetadataSet name='t'/>"
      "</MetadataSet></MetadataSet></WorldInfo></Scene></X3D>";
  const auto faults = [](const std::string& of) {
    x3d::Problems problems("");
    EXPECT_TRUE(x3d::read_document(of, shipped_file(), problems));
    return std::ranges::count(problems.all(), "MetadataSet USE S", &x3d::Problem::node);
  };
  EXPECT_EQ(faults(text), 0);
  EXPECT_EQ(faults(changed(text, {R"({"op": "reorder", "path": "effects/s", "after": "t"})"})), 1);
}

/// The paths of all sets within one, each with the names of the sets around it.
struct MovableSet {
  std::string path;
  std::vector<std::string> siblings;  ///< in the order written, itself among them
};
void gather_movable(const x3d::Metadata& set, const std::string& path, std::vector<MovableSet>& out) {
  std::vector<std::string> names;
  for (const x3d::Metadata& child : set.children)
    if (child.kind == x3d::MetadataKind::set) names.push_back(child.name);
  for (const x3d::Metadata& child : set.children) {
    if (child.kind != x3d::MetadataKind::set) continue;
    const std::string below = path.empty() ? child.name : path + "/" + child.name;
    out.push_back({below, names});
    gather_movable(child, below, out);
  }
}
std::vector<MovableSet> movable_in(const std::string& text) {
  x3d::Problems problems("");
  const auto document = x3d::read_document(text, shipped_file(), problems);
  std::vector<MovableSet> out;
  for (const x3d::NodeId info : document->elements("WorldInfo"))
    if (const auto set = x3d::read_metadata(*document, info, "mechane:scenario", problems))
      gather_movable(*set, "", out);
  return out;
}

TEST(Commands, WhateverIsMovedIsThereAndGoesBackToTheByte) {
  Random random(7);
  for (const std::string& name : shipped_exhibits()) {
    const std::string first = text_of(source_folder() / "scenarios" / name / (name + ".x3d"));
    History history(first);
    for (int i = 0; i < 12; ++i) {
      const std::string text = history.text();
      const auto movable = movable_in(text);
      const MovableSet one = movable[random.below(movable.size())];
      const std::string moved = one.path.substr(one.path.rfind('/') + 1);
      std::vector<std::string> order = one.siblings;
      std::erase(order, moved);
      const std::size_t place = random.below(order.size() + 1);
      const Command there = ReorderSet{one.path, place == 0 ? "" : order[place - 1]};
      const auto was = std::ranges::find(one.siblings, moved);
      const Command back = ReorderSet{one.path, was == one.siblings.begin() ? "" : *(was - 1)};
      order.insert(order.begin() + static_cast<std::ptrdiff_t>(place), moved);
      const auto applied = apply_commands(text, shipped_file(), {&there, 1});
      ASSERT_TRUE(applied) << applied.error().error.to_string();
      const auto now = movable_in(applied->text);
      const auto it = std::ranges::find(now, one.path, &MovableSet::path);
      ASSERT_NE(it, now.end()) << one.path;
      EXPECT_EQ(it->siblings, order) << one.path;
      const auto returned = apply_commands(applied->text, shipped_file(), {&back, 1});
      ASSERT_TRUE(returned);
      EXPECT_EQ(returned->text, text) << name << ": " << one.path;
      history.make({Move::Kind::step, {"", "", 0, delta_between(text, applied->text)}}, applied->text);
    }
    EXPECT_EQ(errors_in(history.text()), 0U) << name;
    while (const auto text = history.text_after({Move::Kind::undo, {}}))
      history.make({Move::Kind::undo, {}}, *text);
    EXPECT_EQ(history.text(), first) << name;
  }
}

TEST(Commands, ABodyGetsItsFirstSet) {
  std::vector<std::string> added;
  std::string text =
      changed(text_of(shipped_file()), {R"({"op": "insert", "part": "post", "position": [1, 0.5, 0]})"}, &added);
  ASSERT_EQ(added, std::vector<std::string>{"POST"});
  text = changed(text, {R"({"op": "set", "path": "POST/mechane:body/collides", "value": false})",
                        R"({"op": "set", "path": "POST/mechane:haptic/staticFriction", "value": 0.7})"});
  EXPECT_EQ(errors_in(text), 0U);
  x3d::Problems problems("crane");
  const auto document = x3d::read_document(text, shipped_file(), problems);
  ASSERT_TRUE(document);
  const auto haptic = x3d::read_metadata(*document, document->find_def("POST"), "mechane:haptic", problems);
  const auto body = x3d::read_metadata(*document, document->find_def("POST"), "mechane:body", problems);
  ASSERT_TRUE(haptic && body);
  EXPECT_EQ(haptic->find("mechane:body"), nullptr) << "the sets stand side by side";
  EXPECT_NE(haptic->find("staticFriction"), nullptr);
}

TEST(Commands, PartsGetNamesOfTheirOwn) {
  std::vector<std::string> added;
  const std::string box = R"({"op": "insert", "part": "box", "position": [0, 2, 0]})";
  const std::string text =
      changed(text_of(shipped_file()),
              {box, box, R"({"op": "insert", "part": "ball", "name": "BOX", "position": [0.5, 2, 0]})"}, &added);
  EXPECT_EQ(added, (std::vector<std::string>{"BOX", "BOX_2", "BOX_3"}));
  EXPECT_EQ(errors_in(text), 0U);
  EXPECT_THAT(refusal_of(text, {R"({"op": "insert", "part": "bx", "position": [0, 0, 0]})"}).error,
              is_fault(ErrorCode::unknown_name, {"box"}));
  EXPECT_FALSE(refusal_of(text, {R"({"op": "insert", "part": "box", "name": "A B", "position": [0, 0, 0]})"})
                   .error.remedy.empty());
}

TEST(Commands, ACopyIsTakenOutAgainWithoutATrace) {
  const std::string text =
      changed(text_of(shipped_file()), {R"({"op": "insert", "part": "crank", "position": [0, 1, 0]})"});
  std::vector<std::string> added;
  const std::string two = changed(text, {R"({"op": "duplicate", "node": "CRANK", "position": [1, 1, 0]})"}, &added);
  ASSERT_EQ(added, std::vector<std::string>{"CRANK_2"});
  EXPECT_THAT(two, ::testing::HasSubstr("CRANK_HANDLE_2"));
  EXPECT_EQ(errors_in(two), 0U);
  EXPECT_EQ(changed(two, {R"({"op": "delete", "node": "CRANK_2"})"}), text);
  EXPECT_THAT(refusal_of(text, {R"({"op": "duplicate", "node": "CRANKS"})"}).error,
              is_fault(ErrorCode::unknown_name, {"CRANK"}));
}

TEST(Commands, ABodyGoesWithItsJointsAndOwnCollidables) {
  const std::string text = R"(<X3D version='4.0'><Scene>
  <CollidableShape DEF='MINE'><Shape containerField='shape'><Sphere radius='0.1'/></Shape></CollidableShape>
  <Transform DEF='PICTURE'/>
  <RigidBodyCollection>
    <RigidBody DEF='A' containerField='bodies'/>
    <RigidBody DEF='B' containerField='bodies'><CollidableShape USE='MINE' containerField='geometry'/></RigidBody>
    <SingleAxisHingeJoint DEF='J' containerField='joints'>
      <RigidBody USE='A' containerField='body1'/>
      <RigidBody USE='B' containerField='body2'/>
    </SingleAxisHingeJoint>
  </RigidBodyCollection>
  <ROUTE fromNode='B' fromField='position' toNode='PICTURE' toField='set_translation'/>
</Scene></X3D>)";
  std::vector<std::string> added;
  const std::string copied = changed(text, {R"({"op": "duplicate", "node": "B"})"}, &added);
  ASSERT_EQ(added, std::vector<std::string>{"B_2"});
  EXPECT_THAT(copied, ::testing::HasSubstr("DEF='MINE_2'")) << "two bodies do not share a collidable";
  EXPECT_EQ(changed(text, {R"({"op": "delete", "node": "B"})"}), R"(<X3D version='4.0'><Scene>
  <Transform DEF='PICTURE'/>
  <RigidBodyCollection>
    <RigidBody DEF='A' containerField='bodies'/>
  </RigidBodyCollection>
</Scene></X3D>)");
  const std::string moved = changed(text, {R"({"op": "move", "node": "B", "pose": [1, 2, 3, 0, 0.6, 0, 0.8]})"});
  EXPECT_THAT(moved,
              ::testing::HasSubstr("DEF='B' containerField='bodies' position='1 2 3' orientation='0 1 0 1.287002'"));
  EXPECT_THAT(moved, ::testing::HasSubstr("DEF='PICTURE' translation='1 2 3' rotation='0 1 0 1.287002'"));
  EXPECT_THAT(refusal_of(text, {R"({"op": "move", "node": "J", "pose": [1, 2, 3, 0, 0, 0, 1]})"}).error,
              is_fault(ErrorCode::not_supported));
  EXPECT_THAT(refusal_of(text, {R"({"op": "delete", "node": "C"})"}).error, is_fault(ErrorCode::unknown_name));
}

TEST(Commands, ABodyIsMadeOfAMeshFile) {
  const std::string text = text_of(shipped_file());
  std::vector<std::string> added;
  const std::string made = changed(
      text,
      {R"({"op": "insert", "url": "files/a'b.glb", "node": "the \"arm\"", "mass": 2.5, "name": "ARM", "position": [1, 2, 3]})",
       R"({"op": "insert", "url": "files/a'b.glb", "node": "leg", "mass": 1, "position": [1, 2, 3]})",
       R"({"op": "insert", "url": "../models/archimedes-screw.glb", "node": "OUTER", "mass": 1, "position": [1, 2, 3]})"},
      &added);
  EXPECT_EQ(added, (std::vector<std::string>{"ARM", "BODY", "BODY_2"}));
  EXPECT_THAT(made, ::testing::HasSubstr("<Inline DEF='ARM_MODEL' url='\"files/a&apos;b.glb\"'/>"));
  EXPECT_THAT(made, ::testing::Not(::testing::HasSubstr("BODY_MODEL"))) << "a file is named once";
  x3d::Problems problems("");
  const auto document = x3d::read_document(made, shipped_file(), problems);
  ASSERT_TRUE(document);
  const auto set = x3d::read_metadata(*document, document->find_def("ARM"), "mechane:body", problems);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->find("node")->strings, std::vector<std::string>{"the \"arm\""});
  EXPECT_EQ(set->find("model")->strings, std::vector<std::string>{"ARM_MODEL"});
}

constexpr std::string_view kThreeBodies = R"(<X3D version='4.0'><Scene>
  <RigidBodyCollection>
    <RigidBody DEF='WALL' fixed='true'/>
    <RigidBody DEF='POST' fixed='true'/>
    <RigidBody DEF='ARM'/>
  </RigidBodyCollection>
</Scene></X3D>)";

TEST(Commands, AJointIsWrittenAsTheServerReadsIt) {
  const std::string text(kThreeBodies);
  std::vector<std::string> added;
  const std::string joined = changed(
      text,
      {R"({"op": "join", "kind": "hinge", "body1": "ARM", "body2": "POST", "anchor": [0, 1, 0], "axis": [0, 0, 2]})"},
      &added);
  ASSERT_EQ(added, std::vector<std::string>{"HINGE"});
  EXPECT_EQ(joined, R"(<X3D version='4.0'><Scene>
  <RigidBodyCollection>
    <RigidBody DEF='WALL' fixed='true'/>
    <RigidBody DEF='POST' fixed='true'/>
    <RigidBody DEF='ARM'/>
    <SingleAxisHingeJoint DEF='HINGE' anchorPoint='0 1 0' axis='0 0 1'>
      <MetadataSet containerField='metadata' name='mechane:agent'>
        <MetadataString containerField='value' name='type' value='"geometry.hinge"'/>
      </MetadataSet>
      <RigidBody containerField='body1' USE='POST'/>
      <RigidBody containerField='body2' USE='ARM'/>
    </SingleAxisHingeJoint>
  </RigidBodyCollection>
</Scene></X3D>)");
  EXPECT_EQ(changed(joined, {R"({"op": "delete", "node": "HINGE"})"}), text);
  const std::string in_the_room =
      changed(text, {R"({"op": "join", "kind": "slider", "body1": "ARM", "axis": [0, 1, 0], "name": "POST"})"}, &added);
  EXPECT_EQ(added, std::vector<std::string>{"POST_2"});
  EXPECT_THAT(in_the_room, ::testing::HasSubstr("<SliderJoint DEF='POST_2' axis='0 1 0'>"));
  EXPECT_THAT(in_the_room, ::testing::Not(::testing::HasSubstr("body2")));
}

TEST(Commands, JointsOfAShippedExhibitAreRight) {
  const std::string text =
      changed(text_of(shipped_file()), {R"({"op": "insert", "part": "post", "position": [2, 0.5, 0]})",
                                        R"({"op": "insert", "part": "crank", "position": [2, 1, 0]})"});
  for (const char* kind : {"hinge", "slider", "ball"}) {
    const std::string joined = changed(
        text, {fmt::format(R"({{"op": "join", "kind": "{}", "body1": "POST", "body2": "CRANK", "anchor": [2, 1, 0],
                               "axis": [0, 0, 1]}})",
                           kind)});
    EXPECT_EQ(errors_in(joined), errors_in(text)) << kind;
    EXPECT_EQ(changed(joined, {R"({"op": "delete", "node": "CRANK"})"}),
              changed(text, {R"({"op": "delete", "node": "CRANK"})"}));
  }
}

TEST(Commands, WhatCannotBeJoinedIsRefused) {
  const auto refused = [](const std::string& bodies) {
    return refusal_of(std::string(kThreeBodies),
                      {R"({"op": "join", "kind": "ball", "anchor": [0, 0, 0], )" + bodies + "}"})
        .error;
  };
  EXPECT_THAT(refused(R"("body1": "ARM", "body2": "ARM")"), is_fault(ErrorCode::conflict, {"ARM"}));
  EXPECT_THAT(refused(R"("body1": "WALL", "body2": "POST")"), is_fault(ErrorCode::conflict, {"WALL", "POST"}));
  EXPECT_THAT(refused(R"("body1": "WALL")"), is_fault(ErrorCode::conflict, {"WALL"}));
  EXPECT_THAT(refused(R"("body1": "ARM", "body2": "LEG")"), is_fault(ErrorCode::unknown_name, {"LEG"}));
  EXPECT_THAT(refused(R"("body1": "ARM", "name": "a b")"), is_fault(ErrorCode::invalid_value, {"a b"}));
  const std::string outside = R"(<X3D version='4.0'><Scene><RigidBodyCollection/><RigidBody DEF='A'/></Scene></X3D>)";
  EXPECT_THAT(refusal_of(outside, {R"({"op": "join", "kind": "ball", "body1": "A", "anchor": [0, 0, 0]})"}).error,
              is_fault(ErrorCode::missing));
}

TEST(Commands, AViewIsKeptAfterTheOthers) {
  const std::string text = text_of(shipped_file());
  std::vector<std::string> added;
  const std::string kept = changed(
      text,
      {R"({"op": "view", "name": "FRONT", "pose": [1, 2, 3, 0, 0.6, 0, 0.8], "fieldOfView": 0.5, "description": "a & b"})"},
      &added);
  ASSERT_EQ(added, std::vector<std::string>{"FRONT_2"});
  EXPECT_THAT(kept, ::testing::HasSubstr("fieldOfView='0.66'/>\n    <Viewpoint DEF='FRONT_2' description='a &amp; b' "
                                         "position='1 2 3' orientation='0 1 0 1.287002' fieldOfView='0.5'/>\n"));
  EXPECT_EQ(errors_in(kept), errors_in(text));
  EXPECT_EQ(changed(kept, {R"({"op": "delete", "node": "FRONT_2"})"}), text);
  EXPECT_EQ(changed("<X3D version='4.0'><Scene/></X3D>", {R"({"op": "view", "pose": [0, 1, 4, 0, 0, 0, 1]})"}),
            "<X3D version='4.0'><Scene>\n<Viewpoint DEF='VIEW' position='0 1 4' orientation='0 0 1 0'/></Scene></X3D>");
}

TEST(Commands, ANewNameIsNewEverywhereOrRefused) {
  const std::string text = text_of(shipped_file());
  const std::string renamed = changed(text, {R"({"op": "rename", "kind": "thing", "from": "INNER", "to": "SPIRAL"})"});
  EXPECT_EQ(errors_in(renamed), 0U);
  EXPECT_THAT(renamed, ::testing::HasSubstr("DEF='SPIRAL'"));
  EXPECT_THAT(renamed, ::testing::Not(::testing::HasSubstr("DEF='INNER'")));
  for (const char* to : {"OUTER", "a b", "1", ""}) {
    const Command command = RenameEverywhere{NameKind::thing, "INNER", to};
    EXPECT_FALSE(apply_commands(text, shipped_file(), {&command, 1})) << to;
  }
  EXPECT_THAT(refusal_of(text, {R"({"op": "rename", "kind": "step", "from": "no-such", "to": "b"})"}).error,
              is_fault(ErrorCode::unknown_name));
}

TEST(Commands, FaultyRequestsNameThePlace) {
  const std::vector<std::pair<std::string, std::string>> faulty{
      {R"({"revision": 1, "commands": []})", "commands"},
      {R"({"commands": [{"op": "remove", "path": "a"}]})", "revision"},
      {R"({"revision": 1, "commands": [{"op": "remove", "path": "a"}, {"op": "fly"}]})", "commands/1/op"},
      {R"({"revision": 1, "commands": [{"op": "set", "path": "a", "value": [1, "b"]}]})", "commands/0/value"},
      {R"({"revision": 1, "commands": [{"op": "set", "path": "a", "value": []}]})", "commands/0/value"},
      {R"({"revision": 1, "commands": [{"op": "move", "node": "A", "pose": [0, 0, 0, 0, 0, 0, 0]}]})",
       "commands/0/pose"},
      {R"({"revision": 1, "commands": [{"op": "insert", "part": "box", "position": [0, 1e300, 0]}]})",
       "commands/0/position"},
      {R"({"revision": 1, "commands": [{"op": "join", "kind": "rope", "body1": "A"}]})", "commands/0/kind"},
      {R"({"revision": 1, "commands": [{"op": "join", "kind": "ball", "body1": "A"}]})", "commands/0/anchor"},
      {R"({"revision": 1, "commands": [{"op": "join", "kind": "slider", "body1": "A", "axis": [0, 0, 0]}]})",
       "commands/0/axis"},
      {R"({"revision": 1, "commands": [{"op": "view", "pose": [0, 0, 0, 0, 0, 0, 1], "fieldOfView": 4}]})",
       "commands/0/fieldOfView"},
      {R"({"revision": -1, "commands": [{"op": "remove", "path": "a"}]})", "revision"},
      {R"({"revision": 1, "commands": [3]})", "commands/0"},
      {"", ""},
      {"[1]", ""},
  };
  for (const auto& [request, where] : faulty) {
    const auto list = parse_command_list(request);
    ASSERT_FALSE(list) << request;
    EXPECT_EQ(list.error().where, where) << request;
    EXPECT_FALSE(list.error().remedy.empty()) << request;
  }
  EXPECT_EQ(parse_trial(R"({"revision": 3, "step": "use/lift"})")->step, "use/lift");
  EXPECT_EQ(parse_trial(R"({"revision": 3})")->step, "");
  EXPECT_EQ(parse_trial(R"({"revision": 3, "step": 4})").error().where, "step");
  EXPECT_EQ(parse_trial(R"({"step": "use/lift"})").error().where, "revision");
  EXPECT_FALSE(parse_command_list(std::string(5000, '[')));
  EXPECT_THAT(parse_command_list(std::string(kMostCommandBytes + 1, ' ')).error(), is_fault(ErrorCode::too_large));
  const auto good =
      parse_command_list(R"({"revision": 3, "commands": [{"op": "set", "path": "a/b", "value": [1, 2.5]}]})");
  ASSERT_TRUE(good);
  EXPECT_EQ(good->revision, 3);
  EXPECT_EQ(title_of(good->commands), "set b");
}

}  // namespace
}  // namespace mechane::studio
