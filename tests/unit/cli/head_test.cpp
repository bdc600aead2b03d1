#include "client-sdk/cli/head.hpp"

#include <gtest/gtest.h>

namespace mechane::cli {
namespace {

TEST(ReadHead, TakesAPlaceAPoseOrNobody) {
  const auto place = read_head("0.1 -0.2 1.5");
  ASSERT_TRUE(place && *place);
  EXPECT_EQ((*place)->p, Vec3(0.1, -0.2, 1.5));
  EXPECT_EQ((*place)->R.w(), 1);
  const auto pose = read_head("  0 0 2   0.8 0 0 0.6 ");
  ASSERT_TRUE(pose && *pose);
  EXPECT_EQ((*pose)->R.z(), 0.6);
  const auto nobody = read_head("nobody");
  ASSERT_TRUE(nobody);
  EXPECT_FALSE(nobody->has_value());
}

TEST(ReadHead, SaysWhatIsWrong) {
  for (const char* line :
       {"", "0.1 0.2", "0 0 x", "0 0 1 1", "0 0 1 1 0 0 0 5", "0 0 nan", "0 0 1 0.5 0 0 0", "1e999 0 1", "somebody"}) {
    const auto head = read_head(line);
    ASSERT_FALSE(head) << line;
    EXPECT_NE(head.error().remedy.find("nobody"), std::string::npos);
  }
}

}  // namespace
}  // namespace mechane::cli
