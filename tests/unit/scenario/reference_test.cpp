// The manual holds what the tables hold, its copy is fresh, and its example is a scenario.
#include "server/scenario/reference.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "server/agents/registry.hpp"
#include "server/machines/registry.hpp"
#include "server/scenario/schema.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

TEST(Reference, TheCopyBesideTheScenariosIsFresh) {
  EXPECT_EQ(text_of(source_folder() / "scenarios/REFERENCE.md"), reference_page())
      << "write it anew: mechane reference > scenarios/REFERENCE.md";
}

TEST(Reference, TheExampleIsWithoutFault) {
  Problems problems("example.x3d");
  const auto document = read_document(reference_example(), "example.x3d", problems);
  ASSERT_TRUE(document) << document.error().to_string();
  FakeLoader loader;
  const auto world = compile(*document, loader, problems);
  for (const Problem& p : problems.all())
    ADD_FAILURE() << to_string(p);
  ASSERT_TRUE(world);
  EXPECT_EQ(world->joints.size(), 1u);
  EXPECT_EQ(world->steps[0].triggers[0].value, 1);
  EXPECT_NE(reference_page().find(reference_example()), std::string::npos);
}

TEST(Reference, ItsSignIsWithoutFaultAndLeadsOn) {
  Problems problems("sign.x3d");
  FakeLoader loader;
  const auto document = read_document(reference_sign_example(), "sign.x3d", problems);
  ASSERT_TRUE(document) << document.error().to_string();
  const auto world = compile(*document, loader, problems);
  for (const Problem& p : problems.all())
    ADD_FAILURE() << to_string(p);
  ASSERT_TRUE(world);
  ASSERT_EQ(world->steps.size(), 2u);
  EXPECT_EQ(world->steps[1].opens, "archimedes-screw");
  EXPECT_EQ(world->steps[0].triggers[1].next, StepId(1));
  EXPECT_NE(reference_page().find("name='opens' value='\"archimedes-screw\"'/>"), std::string::npos);
}

TEST(Reference, HoldsEveryKeyParameterAndValue) {
  const std::string page = reference_page();
  const auto expect = [&](std::string_view words) { EXPECT_NE(page.find(words), std::string::npos) << words; };
  for (const Table* table : all_tables()) {
    for (const Key& key : table->keys)
      expect(key.summary);
  }
  for (const Table& table : node_tables()) {
    expect("### " + std::string(table.name));
    for (const Key& key : table.keys)
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
}  // namespace mechane::scenario
