#include "server/x3d/metadata.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/x3d/values.hpp"

namespace mechane::x3d {
namespace {

TEST(Metadata, CopiesOfCopiesAreBounded) {
  // Twenty doublings: each of two sets holds copies of the two before it, and so does the other.
  std::string text = "<X3D version='4.0'><Scene>\n";
  for (int i = 0; i <= 20; ++i) {
    for (const char* const side : {"A", "B"}) {
      const std::string name = side + std::to_string(i);
      text += "<MetadataSet DEF='" + name + "' name='" + name + "'>";
      for (const char* const of : {"A", "B"}) {
        if (i > 0) text += "<MetadataSet USE='" + (of + std::to_string(i - 1)) + "'/>";
      }
      text += "</MetadataSet>\n";
    }
  }
  text += "<WorldInfo DEF='W'><MetadataSet containerField='metadata' USE='A20'/></WorldInfo></Scene></X3D>";
  Problems problems("test.x3d");
  const auto document = read_document(text, "test.x3d", problems);
  ASSERT_TRUE(document) << document.error().to_string();
  EXPECT_FALSE(read_metadata(*document, document->find_def("W"), "A20", problems));
  ASSERT_TRUE(problems.has_errors());
  EXPECT_EQ(problems.first_error().code, ErrorCode::too_large);
}

TEST(Metadata, AValueThatCannotBeReadIsReportedOnceAndStaysInItsSet) {
  Problems problems("test.x3d");
  const auto document = read_document(
      "<X3D version='4.0'><Scene><WorldInfo DEF='W'><MetadataSet containerField='metadata' name='all'>\n"
      "<MetadataDouble name='bad' value='0.5m'/>\n<MetadataDouble name='good' value='0.5'/>\n"
      "<MetadataDouble name='good' value='0.6'/>\n</MetadataSet></WorldInfo></Scene></X3D>",
      "test.x3d", problems);
  ASSERT_TRUE(document) << document.error().to_string();
  const auto all = read_metadata(*document, document->find_def("W"), "all", problems);
  ASSERT_TRUE(all);
  ASSERT_EQ(all->children.size(), 2u);
  EXPECT_EQ(all->find("bad")->kind, MetadataKind::unreadable);
  EXPECT_EQ(all->find("good")->numbers, std::vector<double>{0.5}) << "the first one counts";
  ASSERT_EQ(problems.all().size(), 2u);
  EXPECT_EQ(problems.all()[0].line, 2);
  EXPECT_EQ(problems.all()[1].code, ErrorCode::duplicate);
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

}  // namespace
}  // namespace mechane::x3d
