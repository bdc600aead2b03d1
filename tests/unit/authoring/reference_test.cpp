// The manual holds everything in the tables, its copy is up to date, and its example is a scenario.
#include "client-sdk/authoring/reference.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "client-sdk/authoring/reference_example.hpp"
#include "server/agents/registry.hpp"
#include "server/machines/registry.hpp"
#include "server/scenario/schema.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::authoring {
namespace {

using namespace scenario;

TEST(Reference, TheCopyBesideTheScenariosIsFresh) {
  EXPECT_EQ(text_of(source_folder() / "scenarios/REFERENCE.md"), reference_page())
      << "write it again: mechane reference > scenarios/REFERENCE.md";
}

TEST(Reference, SaysWhichAgentsAreOnAndWhatASnapThatIsOffLeaves) {
  for (const char* words : {"**Which agents are on.**", "**A snap that is off**"})
    EXPECT_NE(reference_page().find(words), std::string::npos) << words;
}

TEST(Reference, TheExampleIsWithoutFault) {
  x3d::Problems problems("example.x3d");
  const auto document = x3d::read_document(reference_example(), "example.x3d", problems);
  ASSERT_TRUE(document) << document.error().to_string();
  FakeLoader loader;
  const auto world = scenario::compile(*document, loader, problems);
  for (const x3d::Problem& p : problems.all())
    ADD_FAILURE() << to_string(p);
  ASSERT_TRUE(world);
  EXPECT_EQ(world->joints.size(), 1u);
  EXPECT_EQ(world->steps[0].triggers[0].value, 1);
  EXPECT_NE(reference_page().find(reference_example()), std::string::npos);
}

/// The example with a chapter's additions, read; a problem in it is a failure of the test.
state::WorldDescription read_variation(std::string_view title) {
  for (const Variation& variation : reference_variations()) {
    if (variation.title != title) continue;
    FakeLoader loader;
    x3d::Problems problems("variation.x3d");
    const auto document = x3d::read_document(reference_example_with(variation), "variation.x3d", problems);
    EXPECT_TRUE(document) << (document ? "" : document.error().to_string());
    if (document) {
      auto world = scenario::compile(*document, loader, problems);
      for (const x3d::Problem& p : problems.all())
        ADD_FAILURE() << title << ": " << to_string(p);
      if (world) return std::move(*world);
    }
  }
  ADD_FAILURE() << title;
  return {};
}

TEST(Reference, TheExampleWithoutMeshesIsWithoutFault) {
  x3d::Problems problems("shapes.x3d");
  const auto document = x3d::read_document(reference_shapes(), "shapes.x3d", problems);
  ASSERT_TRUE(document) << document.error().to_string();
  FakeLoader loader;
  const auto world = scenario::compile(*document, loader, problems);
  ASSERT_TRUE(world) << world.error().to_string();
  ASSERT_EQ(world->bodies.size(), 2u);
  EXPECT_TRUE(world->bodies[1].object && world->bodies[1].collides);
  EXPECT_EQ(problems.left_out(), 0u);
  EXPECT_NE(reference_page().find(reference_shapes()), std::string::npos);
}

TEST(Reference, EachVariationIsWithoutFaultAndOnThePage) {
  for (const Variation& variation : reference_variations()) {
    EXPECT_FALSE(read_variation(variation.title).bodies.empty());
    for (const Variation::Piece& piece : variation.pieces)
      EXPECT_NE(reference_page().find(piece.text), std::string::npos) << piece.text;
  }
}

TEST(Reference, VariationsSayWhatTheyPromise) {
  const auto steps = read_variation("More steps");
  ASSERT_EQ(steps.steps.size(), 3u);
  EXPECT_EQ(steps.steps[0].triggers[0].next, StepId(1));
  EXPECT_EQ(steps.steps[1].triggers[0].more.size(), 1u);
  EXPECT_EQ(steps.steps[2].bodies.at(0).graspable, false);
  const auto oiled = read_variation("A surface that changes with the step");
  ASSERT_EQ(oiled.steps.size(), 2u);
  EXPECT_EQ(oiled.steps[1].enable, std::vector{oiled.find_agent("OILED")});
  const auto pulled = read_variation("A place that pulls");
  ASSERT_EQ(pulled.steps.size(), 2u);
  EXPECT_EQ(*pulled.agents[pulled.find_agent("BEFORE_HUB").index()].written_text("object"), "PIN");
  const auto questions = read_variation("Questions");
  ASSERT_EQ(questions.activities.size(), 1u);
  EXPECT_EQ(questions.activities[0].questionnaire.size(), 2u);
  const auto machine = read_variation("A machine, and what is seen and heard of it");
  EXPECT_EQ(machine.machines.size(), 1u);
  EXPECT_EQ(machine.effects.size(), 3u);
  const auto spring = read_variation("A machine of your own");
  ASSERT_EQ(spring.machines.size(), 1u);
  EXPECT_EQ(machines::own_values(spring.machines[0]).size(), 3u);
  EXPECT_EQ(spring.quantities.back().source, "SPRING.visits");
  const auto water = read_variation("A network of water");
  ASSERT_EQ(water.machines.size(), 1u);
  EXPECT_EQ(machines::own_values(water.machines[0]).size(), 11u);
  EXPECT_EQ(water.quantities.back().source, "WATER.SIPHON_flow");
  EXPECT_EQ(read_variation("Another language").languages, (std::vector<std::string>{"el", "en"}));
  const auto sign = read_variation("A sign to another exhibit");
  ASSERT_EQ(sign.steps.size(), 2u);
  EXPECT_EQ(sign.steps[1].opens, "archimedes-screw");
  EXPECT_EQ(sign.steps[0].triggers[1].next, StepId(1));
}

TEST(Reference, EverySetOfTheTablesHasAnExample) {
  std::string examples = reference_example();
  for (const Variation& variation : reference_variations()) {
    for (const Variation::Piece& piece : variation.pieces)
      examples += piece.text;
  }
  for (const scenario::Table* table : scenario::all_tables()) {
    for (const scenario::Key& key : table->keys) {
      if (key.kind != scenario::ValueKind::set) continue;
      const bool pattern = key.name.ends_with('*');
      const std::string name(pattern ? key.name.substr(0, key.name.size() - 1) : key.name);
      const std::string written = "<MetadataSet containerField='value' name='" + name + (pattern ? "" : "'");
      EXPECT_NE(examples.find(written), std::string::npos) << table->name << ": " << key.name;
    }
  }
}

TEST(Reference, HoldsEveryKeyParameterAndValue) {
  const std::string page = reference_page();
  const auto expect = [&](std::string_view words) { EXPECT_NE(page.find(words), std::string::npos) << words; };
  for (const scenario::Table* table : scenario::all_tables()) {
    for (const scenario::Key& key : table->keys)
      expect(key.summary);
  }
  for (const scenario::Table& table : scenario::node_tables()) {
    expect("### " + std::string(table.name));
    for (const scenario::Key& key : table.keys)
      expect(key.summary);
  }
  for (const auto& types : {agents::registry(), machines::registry()}) {
    for (const state::ComponentType& type : types) {
      expect("### " + std::string(type.name));
      for (const auto& parameter : type.parameters)
        expect(parameter.summary);
      for (const auto& value : type.values)
        expect("`NAME." + std::string(value.name) + "`");
    }
  }
}

TEST(Reference, AValueThatIsOneWhileSomethingHoldsIsNeverMore) {
  std::size_t flags = 0;
  for (const auto& types : {agents::registry(), machines::registry()}) {
    for (const state::ComponentType& type : types) {
      for (const state::ValueType& value : type.values) {
        if (!value.summary.starts_with("1 ")) continue;
        ++flags;
        EXPECT_EQ(value.min, 0) << type.name << " " << value.name << ": write state::yes_or_no";
        EXPECT_EQ(value.max, 1) << type.name << " " << value.name << ": write state::yes_or_no";
      }
    }
  }
  EXPECT_GT(flags, 15u);
}

TEST(Reference, ARangeThatEndsAtAParameterNamesOneOfTheTypeInTheSameUnit) {
  for (const auto& types : {agents::registry(), machines::registry()}) {
    for (const state::ComponentType& type : types) {
      for (const state::ValueType& value : type.values) {
        if (value.max_parameter.empty()) continue;
        const auto it = std::ranges::find(type.parameters, value.max_parameter, &state::ParameterType::name);
        ASSERT_NE(it, type.parameters.end()) << type.name << " " << value.name;
        EXPECT_EQ(it->unit, value.unit) << type.name << " " << value.name;
      }
    }
  }
}

}  // namespace
}  // namespace mechane::authoring
