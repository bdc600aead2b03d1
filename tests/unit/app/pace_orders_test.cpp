#include "server/app/pace_orders.hpp"

#include <array>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/error_like.hpp"

namespace mechane::app {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(PaceOrders, ArePacesAndSteps) {
  for (const auto& [line, pace] :
       {std::pair{"pace 0", 0.0}, {"pace 1", 1.0}, {"pace 0.25", 0.25}, {"pace 1e-1", 0.1}}) {
    const auto order = parse_pace_order(line);
    ASSERT_TRUE(order) << line;
    EXPECT_EQ(order->pace, pace);
    EXPECT_EQ(order->ticks, 0U);
  }
  for (const auto& [line, ticks] : {std::pair{"step 1", 1U}, {"step 10000", 10'000U}}) {
    const auto order = parse_pace_order(line);
    ASSERT_TRUE(order) << line;
    EXPECT_EQ(order->ticks, ticks);
  }
}

TEST(PaceOrders, OtherLinesAreErrorsThatNameThem) {
  for (const char* line : {"", "pace", "pace ", "pace 1.1", "pace -0.1", "pace nan", "pace 1 ", "pace  1", "Pace 1",
                           "step 0", "step 10001", "step -1", "step 1.5", "step", "stop"})
    EXPECT_THAT(parse_pace_order(line).error(),
                test::is_error(ErrorCode::invalid_value, 0, {"'" + std::string(line) + "'", "step N", "edit N"}))
        << line;
}

class OrderLinesTest : public testing::Test {
 protected:
  void TearDown() override {
    close(ends_[0]);
    hang_up();
  }
  void write(const std::string& bytes) {
    EXPECT_EQ(::write(ends_[1], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  void hang_up() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

  static std::array<int, 2> new_pipe() {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(pipe(ends.data()), 0);
    return ends;
  }

  std::array<int, 2> ends_ = new_pipe();
  OrderLines lines_{ends_[0]};
};

TEST_F(OrderLinesTest, ComeWholeHoweverTheyAreSent) {
  EXPECT_THAT(lines_.take(), IsEmpty());
  write("pace 0\nst");
  EXPECT_THAT(lines_.take(), ElementsAre("pace 0"));
  write("ep 10\n\npace 1\n");
  EXPECT_THAT(lines_.take(), ElementsAre("step 10", "", "pace 1"));
  EXPECT_FALSE(lines_.ended());
  write("pace 0");
  hang_up();
  EXPECT_THAT(lines_.take(), IsEmpty());
  EXPECT_TRUE(lines_.ended());
}

TEST_F(OrderLinesTest, ALineWithoutAnEndFillsNoMemory) {
  write(std::string(10 * OrderLines::kLongest, 'x'));
  const auto pieces = lines_.take();
  EXPECT_THAT(pieces, SizeIs(10));
  for (const std::string& piece : pieces)
    EXPECT_EQ(piece.size(), OrderLines::kLongest);
}

}  // namespace
}  // namespace mechane::app
