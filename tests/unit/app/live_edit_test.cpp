// Orders to go on with an edited exhibit; what comes of them is tests/integration/preview_e2e.py's subject.
#include "server/app/live_edit.hpp"

#include <gtest/gtest.h>

namespace mechane::app {
namespace {

TEST(LiveEdit, AnOrderHasTheNumberThatItsAnswerWillHave) {
  EXPECT_EQ(parse_edit_order("edit 0"), 0U);
  EXPECT_EQ(parse_edit_order("edit 18446744073709551615"), 18446744073709551615U);
  for (const char* line :
       {"", "edit", "edit ", "edit -1", "edit 1 ", "edit 1.5", "edit 18446744073709551616", "Edit 1"})
    EXPECT_FALSE(parse_edit_order(line)) << line;
}

}  // namespace
}  // namespace mechane::app
