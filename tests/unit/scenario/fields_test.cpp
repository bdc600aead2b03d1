#include "server/scenario/fields.hpp"

#include <gtest/gtest.h>

#include "server/scenario/schema.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

/// A trigger with these keys, on line 3 and following, checked against its table.
struct Held {
  explicit Held(const std::string& keys) {
    const std::string text =
        "<X3D version='4.0'><Scene>\n<WorldInfo DEF='W'>\n<MetadataSet containerField='metadata' name='t'>\n" + keys +
        "</MetadataSet></WorldInfo></Scene></X3D>";
    auto document = x3d::read_document(text, "test.x3d", problems);
    EXPECT_TRUE(document);
    set = x3d::read_metadata(*document, document->find_def("W"), "t", problems);
    if (set) fields.emplace(&*set, trigger_table(), "trigger", problems);
  }
  x3d::Problems problems{"test.x3d"};
  std::optional<x3d::Metadata> set;
  std::optional<Fields> fields;
};

const std::string kGood =
    "<MetadataString name='quantity' value='\"q\"'/>\n<MetadataString name='op' value='\"&lt;\"'/>\n<MetadataDouble "
    "name='value' value='4'/>\n";

TEST(Fields, ReadsWhatItsTableKnows) {
  const Held held(kGood + "<MetadataDouble name='holdSeconds' value='.5'/>");
  EXPECT_TRUE(held.problems.all().empty());
  EXPECT_EQ(held.fields->string("quantity"), "q");
  EXPECT_EQ(held.fields->string("op"), "<");
  EXPECT_EQ(held.fields->number("value"), 4);
  EXPECT_EQ(held.fields->number("holdSeconds"), 0.5);
  EXPECT_EQ(held.fields->string("next"), "end");  // the table's default
  EXPECT_FALSE(held.fields->given("next"));
}

TEST(Fields, FaultsHaveCodeLineAndRemedy) {
  struct Case {
    std::string keys;
    int line;
    ErrorCode code;
    std::string name;
  };
  using enum ErrorCode;
  const std::vector<Case> cases{
      {kGood + "<MetadataDouble name='holdSecond' value='1'/>", 7, unknown_name, "did you mean 'holdSeconds'?"},
      {kGood + "<MetadataString name='holdSeconds' value='\"1\"'/>", 7, invalid_value, "MetadataDouble"},
      {kGood + "<MetadataDouble name='holdSeconds' value='-1'/>", 7, invalid_value, "0 to 3600"},
      {kGood + "<MetadataDouble name='tolerance' value='nan'/>", 7, invalid_value, "'nan'"},
      {kGood + "<MetadataDouble name='tolerance' value='1e999'/>", 7, invalid_value, "'1e999'"},
      {kGood + "<MetadataDouble name='tolerance' value='0.1m'/>", 7, invalid_value, "'0.1m'"},
      {kGood + "<MetadataInteger name='tolerance' value='0.5'/>", 7, invalid_value, "0.5"},
      {kGood + "<MetadataDouble name='value' value='5'/>", 7, duplicate, "line 6"},
      {kGood + "<MetadataString name='next' value='turn'/>", 7, invalid_value, "value='\"turn\"'"},
      {"<MetadataString name='op' value='\">=\"'/>\n", 4, invalid_value, "one of: < = >"},
      {"<MetadataString name='op' value='\"=\"'/>\n", 3, missing, "'quantity'"},
  };
  for (const Case& c : cases) {
    const Held held(c.keys);
    static_cast<void>(find_problem(held.problems.all(), c.code, c.line, c.name));
  }
}

TEST(Fields, AKeyThatIsNearlyOneIsAnErrorAndAnyOtherAWarning) {
  const Held near(kGood + "<MetadataDouble name='hold' value='1'/>");
  ASSERT_EQ(near.problems.all().size(), 1u);
  EXPECT_EQ(near.problems.all()[0].severity, x3d::Severity::error);
  EXPECT_EQ(near.problems.all()[0].code, ErrorCode::unknown_name);
  const Held far(kGood + "<MetadataDouble name='colour' value='1'/>");
  ASSERT_EQ(far.problems.all().size(), 1u);
  EXPECT_EQ(far.problems.all()[0].severity, x3d::Severity::warning);
  EXPECT_EQ(far.problems.all()[0].code, ErrorCode::unknown_name);
  EXPECT_NE(far.problems.all()[0].remedy.find("quantity, op, value"), std::string::npos);
}

TEST(Fields, ATriggerWithRulesNeedsNoQuantityOfItsOwn) {
  const Held held("<MetadataSet name='rule:1'/><MetadataString name='match' value='\"any\"'/>");
  EXPECT_TRUE(held.problems.all().empty()) << to_string(held.problems.all()[0]);
  EXPECT_EQ(held.fields->sets_like("rule:*").size(), 1u);
}

TEST(Schema, EveryKeyIsExplained) {
  for (const Table* table : all_tables()) {
    for (const Key& key : table->keys) {
      EXPECT_FALSE(key.summary.empty()) << table->name << " " << key.name;
      const bool whole = key.default_number >= key.min && key.default_number <= key.max;
      EXPECT_TRUE(whole) << key.name << ": the default is out of the key's own range";
      const bool shown = !key.required || !key.example.empty() || key.kind == ValueKind::set;
      EXPECT_TRUE(shown) << key.name;
    }
  }
}

}  // namespace
}  // namespace mechane::scenario
