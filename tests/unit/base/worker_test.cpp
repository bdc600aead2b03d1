#include "server/base/worker.hpp"

#include <future>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace mechane {
namespace {

TEST(Worker, DoesItsJobsInOrderWithoutBlocking) {
  std::promise<void> gate;
  std::vector<int> done;
  Worker worker("test");
  worker.give([opened = gate.get_future().share()] { opened.wait(); });
  for (int i = 0; i < 3; ++i)
    worker.give([&done, i] { done.push_back(i); });
  gate.set_value();  // give() returned although the first job still runs
  worker.wait_until_left(0);
  EXPECT_EQ(done, (std::vector{0, 1, 2}));
}

TEST(Worker, GivesTheJobsResultThroughItsFuture) {
  std::promise<void> gate;
  Worker worker("test");
  worker.give([opened = gate.get_future().share()] { opened.wait(); });
  std::future<std::unique_ptr<int>> dropped = worker.ask([] { return std::make_unique<int>(1); });
  std::future<std::unique_ptr<int>> kept = worker.ask([] { return std::make_unique<int>(2); });
  dropped = {};
  EXPECT_FALSE(is_ready(dropped));
  EXPECT_FALSE(is_ready(kept));
  gate.set_value();
  worker.wait_until_left(0);
  ASSERT_TRUE(is_ready(kept));
  EXPECT_EQ(*kept.get(), 2);
  EXPECT_FALSE(is_ready(kept)) << "get() has taken the result";
}

TEST(Worker, EndsWhenAllJobsAreDone) {
  int done = 0;
  {
    Worker worker("a name longer than fifteen bytes");
    for (int i = 0; i < 50; ++i)
      worker.give([&done] { ++done; });
  }
  EXPECT_EQ(done, 50);
}

TEST(Worker, WaitsUntilFewEnoughAreLeft) {
  std::promise<void> gate;
  const auto opened = gate.get_future().share();
  Worker worker("test");
  bool first = false;
  worker.give([&first] { first = true; });
  worker.give([opened] { opened.wait(); });
  worker.wait_until_left(1);
  EXPECT_TRUE(first);
  gate.set_value();
}

}  // namespace
}  // namespace mechane
