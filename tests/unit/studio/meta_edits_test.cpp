// What an exhibit says of itself is written where X3D has it, and nothing else changes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client-sdk/studio/edits/apply.hpp"
#include "client-sdk/studio/edits/parts.hpp"
#include "server/scenario/head_facts.hpp"
#include "tests/support/source_files.hpp"
#include "tests/unit/studio/studio_fixture.hpp"

namespace mechane::studio {
namespace {

std::string with(const std::string& text, const std::string& name, const std::string& value) {
  const Command command = SetMeta{name, value};
  const auto applied = apply_commands(text, test::shipped_file(), {&command, 1});
  EXPECT_TRUE(applied) << name << ": " << applied.error().error.to_string();
  return applied ? applied->text : text;
}

scenario::HeadFacts facts_in(const std::string& text) {
  x3d::Problems problems("a.x3d");
  const auto document = x3d::read_document(text, "a.x3d", problems);
  EXPECT_TRUE(document);
  return document ? scenario::head_facts(*document) : scenario::HeadFacts();
}

std::vector<std::string> all_texts() {
  std::vector<std::string> texts{"<X3D version='4.0'><Scene/></X3D>",
                                 "<X3D version='4.0'>\n  <head/>\n  <Scene/>\n</X3D>",
                                 "<X3D version='4.0'>\n  <Scene/>\n</X3D>"};
  for (const Template& one : templates())
    texts.push_back(text_of(one, "one"));
  for (const std::string& name : shipped_exhibits())
    texts.push_back(test::text_of(test::source_folder() / "scenarios" / name / (name + ".x3d")));
  return texts;
}

TEST(MetaEdits, WhatIsWrittenIsReadAndTakenBackToTheByte) {
  const std::string kHard = "Ἥρων's \"crane\" <&> 'ξύλο'";
  for (const std::string& text : all_texts()) {
    // Once it has a head, and a creator of its own.
    const std::string before = with(text, "creator", "Eleni");
    EXPECT_EQ(facts_in(before).credits.author, "Eleni");
    const std::string after = with(before, "reference", kHard);
    EXPECT_EQ(facts_in(after).credits.source, kHard);
    EXPECT_EQ(with(after, "reference", ""), before);
    EXPECT_EQ(with(after, "source", kHard), after);
    EXPECT_EQ(facts_in(with(after, "subject", "lever, μοχλός")).tags, (std::vector<std::string>{"lever", "μοχλός"}));
  }
}

TEST(MetaEdits, OfSeveralThatSayTheSameOneStays) {
  const std::string text =
      "<X3D version='4.0'><head><meta name='license' content='A'/><meta name='rights' content='B'/><meta "
      "name='license'/>"
      "<meta name='generator' content='A'/></head><Scene/></X3D>";
  EXPECT_EQ(
      with(text, "license", "C"),
      "<X3D version='4.0'><head><meta name='license' content='C'/><meta name='generator' content='A'/></head><Scene/>"
      "</X3D>");
  const Command other = SetMeta{"generator", "me"};
  const auto refused = apply_commands(text, test::shipped_file(), {&other, 1});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().error, is_fault(ErrorCode::unknown_name, {"generator"}));
}

}  // namespace
}  // namespace mechane::studio
