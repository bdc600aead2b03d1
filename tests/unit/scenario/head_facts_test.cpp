// What a file says of itself.
#include "server/scenario/head_facts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mechane::scenario {
namespace {

HeadFacts facts_in(const std::string& head) {
  x3d::Problems problems("a.x3d");
  const auto document =
      x3d::read_document("<X3D version='4.0'><head>" + head + "</head><Scene/></X3D>", "a.x3d", problems);
  EXPECT_TRUE(document);
  return document ? head_facts(*document) : HeadFacts();
}

TEST(HeadFacts, OneMeaningHasSeveralNamesAndAllContentsAreKept) {
  const HeadFacts facts = facts_in(
      "<meta name='creator' content='Eleni'/><meta name='author' content='Nikos'/><meta name='author' content='Eleni'/>"
      "<meta name='rights' content='CC0-1.0'/><meta name='keywords' content=' crane,  Roman crane ,,'/>"
      "<meta name='subject' content='ξύλο'/><meta name='generator' content='by hand'/><meta name='license'/>");
  EXPECT_EQ(facts.credits, (content::Credits{"CC0-1.0", "", "Eleni; Nikos", ""}));
  EXPECT_THAT(facts.tags, testing::ElementsAre("crane", "Roman crane", "ξύλο"));
  EXPECT_EQ(facts.description, "");
}

}  // namespace
}  // namespace mechane::scenario
