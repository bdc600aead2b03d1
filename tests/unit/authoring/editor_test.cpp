// Writing back: what is not changed stays the same to the byte, and what is changed reads as it was set.
#include "client-sdk/authoring/editor.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/authoring/reference_example.hpp"
#include "client-sdk/authoring/text_edits.hpp"
#include "server/x3d/metadata.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::authoring {
namespace {

using namespace scenario;

using Numbers = std::vector<double>;
using Texts = std::vector<std::string>;

std::vector<std::filesystem::path> sample_files() {
  std::vector<std::filesystem::path> files{shipped_file()};
  if (!std::filesystem::exists(shared_folder() / "x3d")) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_folder() / "x3d")) {
    if (entry.path().extension() == ".x3d") files.push_back(entry.path());
  }
  return files;
}

Editor editor_of(const std::string& text) {
  auto editor = Editor::read(text, shipped_file());
  EXPECT_TRUE(editor) << editor.error().to_string();
  return std::move(*editor);
}

Editor shipped() {
  return editor_of(text_of(shipped_file()));
}

void expect_same(const x3d::Document& a, const x3d::Document& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const x3d::Node& x = a[x3d::NodeId(i)];
    const x3d::Node& y = b[x3d::NodeId(i)];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.text, y.text);
    EXPECT_EQ(x.parent, y.parent);
    ASSERT_EQ(x.attributes.size(), y.attributes.size());
    for (std::size_t k = 0; k < x.attributes.size(); ++k) {
      EXPECT_EQ(x.attributes[k].name, y.attributes[k].name);
      EXPECT_EQ(x.attributes[k].value, y.attributes[k].value);
    }
  }
}

TEST(Editor, ReadWriteReadIsTheSameToTheByte) {
  const test::ScratchFolder folder;
  const auto out = folder.path() / "out.x3d";
  for (const auto& file : sample_files()) {
    const auto editor = Editor::open(file);
    ASSERT_TRUE(editor) << editor.error().to_string();
    ASSERT_TRUE(editor->save(out));
    EXPECT_EQ(text_of(out), text_of(file)) << file;
    const auto again = Editor::open(out);
    ASSERT_TRUE(again);
    expect_same(editor->document(), again->document());
  }
}

TEST(Editor, EverySpanIsWhereTheTreeSaysItIs) {
  for (const auto& file : sample_files()) {
    const auto editor = Editor::open(file);
    ASSERT_TRUE(editor);
    const x3d::Document& document = editor->document();
    for (std::size_t i = 0; i < document.size(); ++i) {
      const x3d::Node& node = document[x3d::NodeId(i)];
      if (node.kind != x3d::NodeKind::element) continue;
      const std::string& text = document.source();
      ASSERT_TRUE(text.substr(node.span.begin + 1).starts_with(node.name));
      ASSERT_EQ(text[node.span.end - 1], '>');
      for (const x3d::Attribute& a : node.attributes)
        ASSERT_EQ(text.substr(a.span.begin, a.span.name_end - a.span.begin), a.name);
    }
  }
}

/// Each sample file with an attribute changed and changed back: all else stays the same, and the change can be read.
RC_GTEST_PROP(Editor, AnyAttributeOfAnyFileCanBeWrittenAndWrittenBack, ()) {
  static const std::vector<std::filesystem::path> kFiles = sample_files();
  const std::string before = text_of(kFiles[*rc::gen::inRange<std::size_t>(0, kFiles.size())]);
  Editor editor = editor_of(before);
  std::vector<x3d::NodeId> elements;
  for (std::size_t i = 0; i < editor.document().size(); ++i) {
    const x3d::NodeId id(i);
    const x3d::Node& node = editor.document()[id];
    // A DEF, and the attributes of the outermost element, cannot have just any value.
    if (node.kind != x3d::NodeKind::element || node.attributes.empty() || node.name == "X3D" ||
        node.attributes[0].name == "DEF")
      continue;
    if (node.attributes[0].name != "USE") elements.push_back(id);
  }
  if (elements.empty()) return;
  const x3d::NodeId id = elements[*rc::gen::inRange<std::size_t>(0, elements.size())];
  const x3d::Attribute old = editor.document()[id].attributes[0];
  const std::string value =
      *rc::gen::element<std::string>("a&b", "<", "'", "\"", "ά\n\tβ", "", "plain", "]]>", "&amp;");
  TextEdits edits;
  set_attribute(editor.document(), id, old.name, value, edits);
  const Editor changed = editor_of(edits.apply(before));
  RC_ASSERT(*changed.document()[id].attribute(old.name) == value);
  TextEdits back;
  set_attribute(changed.document(), id, old.name, old.value, back);
  const std::string after = back.apply(changed.text());
  const Editor again = editor_of(after);
  RC_ASSERT(*again.document()[id].attribute(old.name) == old.value);
  // A value may have been written in another way (&quot; for "), but nothing else may have moved.
  RC_ASSERT(after.substr(0, old.span.value_begin) == before.substr(0, old.span.value_begin));
  RC_ASSERT(after.substr(again.document()[id].attributes[0].span.value_end) == before.substr(old.span.value_end));
}

double number_at(const Editor& editor, const std::string& step, const std::string& key) {
  FakeLoader loader;
  x3d::Problems problems("test.x3d");
  const auto world = scenario::compile(editor.document(), loader, problems);
  EXPECT_TRUE(world) << world.error().to_string();
  if (!world) return -1;
  const auto& of = world->steps[world->find_step(step).index()];
  return key == "hint" ? of.hint_after_s : of.timeout_s;
}

TEST(Editor, SetsAKeyThatIsThereAndOneThatIsNot) {
  Editor editor = shipped();
  const std::string before = editor.text();
  ASSERT_TRUE(editor.set("activities/use/steps/fill/trigger:1/value", Numbers{20}));
  std::string expected = before;
  const std::size_t at = expected.find("name='value' value='15'");
  expected.replace(at, 23, "name='value' value='20'");
  EXPECT_EQ(editor.text(), expected);
  ASSERT_TRUE(editor.set("activities/use/steps/fill/hintSeconds", Numbers{12.5}));
  EXPECT_EQ(number_at(editor, "fill", "hint"), 12.5);
  ASSERT_TRUE(editor.remove("activities/use/steps/fill/hintSeconds"));
  EXPECT_EQ(editor.text(), expected) << "added and removed: as it was";
}

TEST(Editor, MakesTheSetsOnItsWay) {
  Editor editor = shipped();
  ASSERT_TRUE(editor.set("activities/use/questionnaire/why/kind", Texts{"scale"}));
  ASSERT_TRUE(editor.set("activities/use/questionnaire/why/text/question.en", Texts{"Did it lift & \"pour\"?"}));
  ASSERT_TRUE(editor.set("machines/PUMP/basinCapacity", Numbers{60}));
  ASSERT_TRUE(editor.set("INNER/mechane:haptic/stiffness", Numbers{700}));
  ASSERT_TRUE(editor.set("AXLE/mechane:agent/frictionTorque", Numbers{0.25}));
  ASSERT_TRUE(editor.set_attribute("INNER", "mass", "40.5"));
  FakeLoader loader;
  x3d::Problems problems("test.x3d");
  const auto world = scenario::compile(editor.document(), loader, problems);
  ASSERT_TRUE(world) << world.error().to_string();
  EXPECT_EQ(world->activities[1].questionnaire.back().question.at("en"), "Did it lift & \"pour\"?");
  EXPECT_EQ(world->bodies[1].mass_kg, 40.5);
  EXPECT_EQ(world->bodies[1].haptic.stiffness_n_per_m, 700);
  EXPECT_EQ(std::get<Numbers>(world->machines[0].parameters.at("basinCapacity")), Numbers{60});
}

TEST(Editor, AddsAndRemovesAStep) {
  Editor editor = shipped();
  const std::string before = editor.text();
  ASSERT_TRUE(editor.add("activities/use/steps/rest", "turn"));
  ASSERT_TRUE(editor.set("activities/use/steps/rest/text/caption.en", Texts{"Rest."}));
  ASSERT_TRUE(editor.set("activities/use/steps/rest/text/caption.el", Texts{"Ξεκουραστείτε."}));
  ASSERT_TRUE(editor.set("activities/use/steps/rest/timeoutSeconds", Numbers{5}));
  ASSERT_TRUE(editor.set("activities/use/steps/rest/timeoutNext", Texts{"fill"}));
  ASSERT_TRUE(editor.set("activities/use/steps/turn/trigger:1/next", Texts{"rest"}));
  FakeLoader loader;
  for (const x3d::Problem& p : editor.check(loader))
    ADD_FAILURE() << to_string(p);
  EXPECT_EQ(number_at(editor, "rest", "timeout"), 5);
  ASSERT_TRUE(editor.remove("activities/use/steps/rest"));
  bool said = false;
  for (const x3d::Problem& p : editor.check(loader))
    said = said || is_problem(p, ErrorCode::unknown_name, kAnyLine, "'rest'");
  EXPECT_TRUE(said) << "the checker finds what still names the step";
  ASSERT_TRUE(editor.set("activities/use/steps/turn/trigger:1/next", Texts{"fill"}));
  EXPECT_EQ(editor.text(), before);
}

TEST(Editor, RefusesWhatTheSchemaDoesNotAllowAndChangesNothing) {
  Editor editor = shipped();
  const std::string before = editor.text();
  const auto expect = [&](const Expected<void>& result, ErrorCode code, int line, const std::string& name) {
    ASSERT_FALSE(result) << name;
    EXPECT_THAT(result.error(), test::is_error(code, line, {name}));
  };
  using enum ErrorCode;
  const int inner = line_of(before, "<RigidBody DEF='INNER'");
  expect(editor.set("activities/use/steps/fill/hintSecond", Numbers{1}), unknown_name, 0,
         "did you mean 'hintSeconds'?");
  expect(editor.set("activities/use/steps/fill/hintSeconds", Texts{"soon"}), invalid_value, 0, "MetadataDouble");
  expect(editor.set("activities/use/steps/fill/hintSeconds", Numbers{-1}), invalid_value, 0, "0 to 3600");
  expect(editor.set("machines/PUMP/basinCapacty", Numbers{1}), unknown_name, 0, "did you mean 'basinCapacity'?");
  expect(editor.set("INER/mechane:haptic/stiffness", Numbers{1}), unknown_name, 0, "did you mean 'INNER'?");
  expect(editor.set("id/name", Numbers{1}), conflict, line_of(before, "name='id'"), "'id'");
  expect(editor.set("", Numbers{1}), missing, 0, "activities/use/steps");
  expect(editor.set_attribute("INNER", "masss", "1"), unknown_name, inner, "did you mean 'mass'?");
  expect(editor.set_attribute("INNER", "mass", "heavy"), invalid_value, inner, "mass: 'heavy'");
  expect(editor.add("activities/use/steps/fill"), duplicate, line_of(before, "name='fill'>"), "'fill'");
  expect(editor.add("activities/use/steps/x", "nowhere"), unknown_name, 0, "'nowhere'");
  expect(editor.remove("activities/use/steps/nowhere"), unknown_name, 0, "steps/nowhere");
  EXPECT_EQ(editor.text(), before);
}

TEST(Editor, KeepsLineEndsAndOpensEmptySets) {
  std::string text = reference_example();
  std::string windows;
  for (const char c : text)
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  Editor editor = editor_of(windows);
  ASSERT_TRUE(editor.set("activities/turn/steps/once/hintSeconds", Numbers{3}));
  ASSERT_TRUE(editor.set("text/title.en", Texts{"A \"wheel\" & more"}));
  EXPECT_EQ(editor.text().find("\n\n"), std::string::npos);
  for (std::size_t i = 0; i < editor.text().size(); ++i) {
    if (editor.text()[i] == '\n') {
      ASSERT_EQ(editor.text()[i - 1], '\r') << i;
    }
  }
  FakeLoader loader;
  x3d::Problems problems("test.x3d");
  const auto world = scenario::compile(editor.document(), loader, problems);
  ASSERT_TRUE(world) << world.error().to_string();
  EXPECT_EQ(world->title.at("en"), "A \"wheel\" & more");
  EXPECT_EQ(world->steps[0].hint_after_s, 3);
  Editor bare = editor_of(
      "<X3D version='4.0'><Scene><WorldInfo><MetadataSet containerField='metadata' "
      "name='mechane:scenario'/></WorldInfo></Scene></X3D>");
  ASSERT_TRUE(bare.set("id", Texts{"bare"}));
  EXPECT_NE(bare.text().find("name='mechane:scenario'><MetadataString"), std::string::npos) << bare.text();
}

TEST(Editor, SaysWhenAFileCannotBeWritten) {
  const auto result = shipped().save("/nowhere/at/all.x3d");
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error(), test::is_error(ErrorCode::io_failure, 0, {"/nowhere/at/all.x3d"}));
  const auto opened = Editor::open("/nowhere/at/all.x3d");
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error(), test::is_error(ErrorCode::not_found, 0, {"/nowhere/at/all.x3d"}));
}

}  // namespace
}  // namespace mechane::authoring
