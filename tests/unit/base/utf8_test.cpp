#include "server/base/utf8.hpp"

#include <gtest/gtest.h>

namespace mechane {
namespace {

TEST(Utf8, CountsLettersNotBytes) {
  EXPECT_EQ(utf8_letters(""), 0U);
  EXPECT_EQ(utf8_letters("screw"), 5U);
  EXPECT_EQ(utf8_letters("αίθουσα-2"), 9U);
}

TEST(Utf8, TheBeginningOfATextCutsNoLetter) {
  EXPECT_EQ(utf8_beginning("κοχλίας", 100), "κοχλίας");
  EXPECT_EQ(utf8_beginning("κοχλίας", 5), "κο");
  EXPECT_EQ(utf8_beginning("κοχλίας", 4), "κο");
  EXPECT_EQ(utf8_beginning("κοχλίας", 1), "");
}

TEST(Utf8, ControlCharactersAreReplacedForATerminal) {
  EXPECT_EQ(without_controls("a\x1b[2J\tβ\n\x7f"), "a?[2J?β??");
  EXPECT_TRUE(is_control('\t'));
  EXPECT_FALSE(is_control_in_lines('\t'));
  EXPECT_FALSE(is_control_in_lines('\n'));
  EXPECT_TRUE(is_control_in_lines('\r'));
  EXPECT_FALSE(is_control('\xb2'));
}

}  // namespace
}  // namespace mechane
