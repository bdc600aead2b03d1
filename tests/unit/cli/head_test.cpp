#include "client-sdk/cli/head.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_like.hpp"

namespace mechane::cli {
namespace {

using test::is_error;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Keeps what it is sent: z, and 0 for nobody.
class HeardTracker final : public client::HeadTracker {
 public:
  bool tell(const Pose& X_SV) override {
    told.push_back(X_SV.p.z());
    return true;
  }
  bool tell_nobody() override {
    told.push_back(0);
    return true;
  }
  std::vector<double> told;
};

/// A museum with these displays.
class Museum final : public client::DisplayWatch {
 public:
  void wait(Duration) override {}
  [[nodiscard]] std::vector<client::DisplayStatus> displays() override { return all; }
  [[nodiscard]] std::vector<client::KioskDevice> devices() override { return {}; }
  [[nodiscard]] Expected<std::uint64_t> request(const std::string&, const std::string&,
                                                const client::DisplayRequest&) override {
    return fail(ErrorCode::not_supported, "nobody requests here");
  }
  void add(const char* kiosk, const char* display) {
    all.emplace_back();
    all.back().kiosk = kiosk;
    all.back().display = display;
  }
  std::vector<client::DisplayStatus> all;
};

/// Goes on by itself: a tracker sends a line each 4 ms.
class TurningClock final : public Clock {
 public:
  [[nodiscard]] TimePoint now() noexcept override { return now_ += std::chrono::milliseconds(4); }
  void sleep_until(TimePoint wake) noexcept override { now_ = std::max(now_, wake); }
  [[nodiscard]] Duration thread_cpu_time() noexcept override { return {}; }

 private:
  TimePoint now_{};
};

/// Passes a tracker's lines on, and keeps the results.
struct Passing {
  explicit Passing(const std::string& lines, HeadOptions options = {}, const char* kiosk = "kiosk-1") {
    museum.add(kiosk, "wall");
    std::istringstream in(lines);
    std::ostringstream err;
    Audience audience(options, museum, clock.now());
    status = pass_on(tracker, in, err, audience, clock);
    said = err.str();
  }
  HeardTracker tracker;
  Museum museum;
  TurningClock clock;
  int status = 0;
  std::string said;
};

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
  for (const char* line : {"", "0.1 0.2", "0 0 x", "0 0 1 1", "0 0 1 1 0 0 0 5", "0 0 nan", "0 0 1 0.5 0 0 0",
                           "1e999 0 1", "somebody", "{\x1b[2J"}) {
    const auto head = read_head(line);
    ASSERT_FALSE(head) << line;
    EXPECT_THAT(head.error(), is_error(ErrorCode::invalid_value, 0, {"'nobody'"})) << line;
  }
}

TEST(ReadHead, TakesNoPlaceBehindTheScreenOrFarAway) {
  for (const char* line : {"0 0 0", "0.1 0.2 -1.5", "0 0 20.1", "-30 0 1", "0 1500 600"}) {
    const auto head = read_head(line);
    ASSERT_FALSE(head) << line;
    EXPECT_THAT(head.error(), is_error(ErrorCode::invalid_value, 0, {line, "20 m"}));
  }
  EXPECT_TRUE(read_head("0 0 19.9"));
  EXPECT_TRUE(read_head("-3 0 0.01"));
}

TEST(Head, ABadLineIsToldWithItsNumberAndTheNextIsRead) {
  const Passing passing(
      "0 0 1\n0 0 gar\x1b"
      "bled\n0 0 2\nnobody\n0 0 3");
  EXPECT_THAT(passing.tracker.told, ElementsAre(1, 2, 0, 3, 0));
  EXPECT_THAT(passing.said, AllOf(HasSubstr("line 2: "), HasSubstr("'0 0 gar?bled'")));
  EXPECT_EQ(passing.status, 0);
}

TEST(Head, OfAThousandBadLinesFewAreTold) {
  std::string lines = "0 0 1\n";
  for (int i = 0; i < 5000; ++i)
    lines += "0 0 -1\n";
  const Passing passing(lines + std::string(1'000'000, 'x') + "\n0 0 2\n");
  EXPECT_THAT(passing.tracker.told, ElementsAre(1, 2, 0));
  const auto told = std::ranges::count(passing.said, '\n');
  EXPECT_GE(told, 3) << passing.said;  // 20 s of the tracker's
  EXPECT_LE(told, 5) << passing.said;
  EXPECT_LT(passing.said.size(), 2000U);
  EXPECT_THAT(passing.said, HasSubstr("more bad lines since the last message"));
  EXPECT_THAT(passing.said, HasSubstr("5001 of 5003 lines were bad"));
}

TEST(Head, WithoutAGoodLineTheStatusSaysSo) {
  EXPECT_EQ(Passing("x\ny\n").status, 1);
  const Passing nothing("");
  EXPECT_EQ(nothing.status, 0);
  EXPECT_THAT(nothing.said, IsEmpty());
}

TEST(Head, ThatNoDisplayHearsIsToldOnce) {
  std::string lines;
  for (int i = 0; i < 3000; ++i)
    lines += "0 0 1\n";
  const Passing passing(lines, {}, "kiosk-2");
  EXPECT_THAT(passing.said,
              AllOf(HasSubstr("kiosk-1/*: there is no such display"), HasSubstr("name one of: kiosk-2/wall")));
  EXPECT_EQ(std::ranges::count(passing.said, '\n'), 1) << passing.said;
  EXPECT_EQ(passing.tracker.told.size(), 3001U);
  // The same with one line, and with a wrong name of the display.
  EXPECT_THAT(Passing("0 0 1\n", {}, "kiosk-2").said, HasSubstr("kiosk-1/*"));
  HeadOptions of_one;
  of_one.display = "wall";
  EXPECT_THAT(Passing(lines, of_one).said, IsEmpty());
  of_one.display = "floor";
  EXPECT_THAT(Passing(lines, of_one).said, HasSubstr("kiosk-1/floor"));
}

}  // namespace
}  // namespace mechane::cli
