#include "server/scenario/metadata.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/scenario/schema.hpp"
#include "server/scenario/values.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

/// A trigger with these keys, on line 3 and following, held against its table.
struct Held {
  explicit Held(const std::string& keys) {
    const std::string text =
        "<X3D version='4.0'><Scene>\n<WorldInfo DEF='W'>\n<MetadataSet containerField='metadata' name='t'>\n" + keys +
        "</MetadataSet></WorldInfo></Scene></X3D>";
    auto document = read_document(text, "test.x3d", problems);
    EXPECT_TRUE(document);
    set = read_metadata(*document, document->find_def("W"), "t", problems);
    if (set) fields.emplace(&*set, trigger_table(), "trigger", problems);
  }
  Problems problems{"test.x3d"};
  std::optional<Metadata> set;
  std::optional<Fields> fields;
};

const std::string kGood =
    "<MetadataString name='quantity' value='\"q\"'/>\n<MetadataString name='op' value='\"&lt;\"'/>\n<MetadataDouble "
    "name='value' value='4'/>\n";

TEST(Metadata, ReadsWhatItsTableKnows) {
  const Held held(kGood + "<MetadataDouble name='holdSeconds' value='.5'/>");
  EXPECT_TRUE(held.problems.all().empty());
  EXPECT_EQ(held.fields->string("quantity"), "q");
  EXPECT_EQ(held.fields->string("op"), "<");
  EXPECT_EQ(held.fields->number("value"), 4);
  EXPECT_EQ(held.fields->number("holdSeconds"), 0.5);
  EXPECT_EQ(held.fields->string("next"), "end");  // the table's default
  EXPECT_FALSE(held.fields->given("next"));
}

TEST(Metadata, FaultsSayLineAndRemedy) {
  struct Case {
    std::string keys;
    int line;
    std::string words;
  };
  const std::vector<Case> cases{
      {kGood + "<MetadataDouble name='holdSecond' value='1'/>", 7, "did you mean 'holdSeconds'?"},
      {kGood + "<MetadataString name='holdSeconds' value='\"1\"'/>", 7, "write a MetadataDouble with one number"},
      {kGood + "<MetadataDouble name='holdSeconds' value='-1'/>", 7, "write 0 to 3600"},
      {kGood + "<MetadataDouble name='tolerance' value='nan'/>", 7, "not a finite number"},
      {kGood + "<MetadataDouble name='tolerance' value='1e999'/>", 7, "not a finite number"},
      {kGood + "<MetadataDouble name='tolerance' value='0.1m'/>", 7, "not a number"},
      {kGood + "<MetadataInteger name='tolerance' value='0.5'/>", 7, "not a whole number"},
      {kGood + "<MetadataDouble name='value' value='5'/>", 7, "already given in line 6"},
      {kGood + "<MetadataString name='next' value='turn'/>", 7, "not in quotes"},
      {"<MetadataString name='op' value='\">=\"'/>\n", 4, "none of: < = >"},
      {"<MetadataString name='op' value='\"=\"'/>\n", 3, "the key 'quantity' is missing"},
  };
  for (const Case& c : cases) {
    const Held held(c.keys);
    const auto& all = held.problems.all();
    const bool said = std::any_of(all.begin(), all.end(), [&](const Problem& p) {
      return p.line == c.line && to_string(p).find(c.words) != std::string::npos && !p.remedy.empty();
    });
    EXPECT_TRUE(said) << c.keys << "\nwanted: " << c.words
                      << "\ngot: " << (all.empty() ? "nothing" : to_string(all[0]));
  }
}

TEST(Metadata, CopiesOfCopiesAreBounded) {
  // Sixty doublings: more metadata than there are atoms in a person, from a file of a few kilobytes.
  std::string text =
      "<X3D version='4.0'><Scene>\n<MetadataSet DEF='M0' name='x'><MetadataString name='a' "
      "value='\"a\"'/></MetadataSet>\n";
  for (int i = 1; i <= 60; ++i) {
    const std::string use = "<MetadataSet name='' USE='M" + std::to_string(i - 1) + "'/>";
    text += "<MetadataSet DEF='M" + std::to_string(i) + "' name='x" + std::to_string(i) + "'>" + use + use +
            "</MetadataSet>\n";
  }
  text += "<WorldInfo DEF='W'><MetadataSet containerField='metadata' USE='M60'/></WorldInfo></Scene></X3D>";
  Problems problems("test.x3d");
  const auto document = read_document(text, "test.x3d", problems);
  ASSERT_TRUE(document) << document.error().to_string();
  EXPECT_FALSE(read_metadata(*document, document->find_def("W"), "x60", problems));
  EXPECT_TRUE(problems.has_errors());
}

RC_GTEST_PROP(Values, StringsSurviveQuoting, (const std::vector<std::string>& words)) {
  std::string text;
  for (const std::string& word : words) {
    text += " \"";
    for (const char c : word)
      text += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string{c};
    text += '"';
  }
  const auto read = parse_strings(text);
  RC_ASSERT(read.has_value());
  RC_ASSERT(*read == words);
}

RC_GTEST_PROP(Values, NumbersAreReadToTheBitOrRefused, (const std::vector<double>& numbers)) {
  std::string text;
  char digits[64];
  for (const double number : numbers) {
    std::snprintf(digits, sizeof digits, "%.17g, ", number);
    text += digits;
  }
  const auto read = parse_numbers(text);
  const bool finite = std::all_of(numbers.begin(), numbers.end(), [](double d) { return std::isfinite(d); });
  RC_ASSERT(read.has_value() == finite);
  if (finite) RC_ASSERT(*read == numbers);
}

TEST(Metadata, AKeyThatIsNearlyOneIsAnErrorAndAnyOtherAWarning) {
  const Held near(kGood + "<MetadataDouble name='hold' value='1'/>");
  ASSERT_EQ(near.problems.all().size(), 1u);
  EXPECT_EQ(near.problems.all()[0].severity, Severity::error);
  const Held far(kGood + "<MetadataDouble name='colour' value='1'/>");
  ASSERT_EQ(far.problems.all().size(), 1u);
  EXPECT_EQ(far.problems.all()[0].severity, Severity::warning);
  EXPECT_NE(far.problems.all()[0].remedy.find("quantity, op, value"), std::string::npos);
}

TEST(Metadata, ATriggerWithRulesNeedsNoQuantityOfItsOwn) {
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
