#include "client-sdk/gateway/drafts/preview_process.hpp"

#include <chrono>
#include <future>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::gateway {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class PreviewProcessTest : public testing::Test {
 protected:
  Expected<std::unique_ptr<PreviewProcess>> run(const std::string& script,
                                                const std::vector<std::string>& arguments = {}) {
    return PreviewProcess::start(folder_.script("server", script), arguments, [this] { ended_.set_value(); });
  }
  void wait_for_end() { ASSERT_EQ(end_.wait_for(std::chrono::seconds(30)), std::future_status::ready); }

  test::ScratchFolder folder_;
  std::promise<void> ended_;
  std::future<void> end_ = ended_.get_future();
};

TEST_F(PreviewProcessTest, WhatItSaysIsKeptUntilItsEnd) {
  auto process = run("echo \"$2\"; echo error: no such body >&2; exit 1", {"--scenario", "a b.x3d"});
  ASSERT_TRUE(process) << process.error().to_string();
  wait_for_end();
  EXPECT_TRUE((*process)->over());
  EXPECT_THAT((*process)->said(), ElementsAre("a b.x3d", "error: no such body"));
  EXPECT_FALSE((*process)->order("pace 1"));
}

TEST_F(PreviewProcessTest, OnlyTheLastLinesAreKeptAndEachIsCut) {
  auto process =
      run("i=0; while [ $i -lt 100 ]; do echo line $i; i=$((i+1)); done; head -c 5000 /dev/zero | tr '\\0' x");
  ASSERT_TRUE(process);
  wait_for_end();
  const auto said = (*process)->said();
  ASSERT_EQ(said.size(), PreviewProcess::kLinesKept + 1);
  EXPECT_EQ(said.front(), "line 80");
  EXPECT_EQ(said.back(), std::string(PreviewProcess::kLongestLine, 'x'));
}

TEST_F(PreviewProcessTest, OrdersAreItsInputAndTheEndOfThemIsItsEnd) {
  auto process = run("trap '' TERM; while read line; do echo got $line; done; echo over");
  ASSERT_TRUE(process);
  EXPECT_TRUE((*process)->order("pace 0"));
  EXPECT_TRUE((*process)->order("step 10"));
  (*process)->end();
  wait_for_end();
  EXPECT_THAT((*process)->said(), ElementsAre("got pace 0", "got step 10", "over"));
}

TEST_F(PreviewProcessTest, OneThatDoesNotHearYetIsToldByASignal) {
  auto process = run("exec sleep 100");
  ASSERT_TRUE(process);
  const auto began = std::chrono::steady_clock::now();
  process->reset();
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(4));
}

TEST_F(PreviewProcessTest, OneThatDoesNotEndIsKilled) {
  auto process = run("trap '' TERM; echo ready; while :; do sleep 1; done");
  ASSERT_TRUE(process);
  while ((*process)->said().empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // sleeps: between two looks
  process->reset();
  EXPECT_EQ(end_.wait_for(std::chrono::seconds(0)), std::future_status::ready);
}

TEST_F(PreviewProcessTest, ASignalThatNobodyHereSentIsTold) {
  auto process = run("echo begun; kill -9 $$");
  ASSERT_TRUE(process);
  wait_for_end();
  EXPECT_THAT((*process)->said(), ElementsAre("begun", HasSubstr("ended by a signal: Killed")));
}

TEST_F(PreviewProcessTest, AProgramThatIsNotThereIsAnError) {
  const auto process = PreviewProcess::start(folder_.path() / "none", {}, [] {});
  ASSERT_FALSE(process);
  EXPECT_THAT(process.error(), test::is_error(ErrorCode::failed_process, 0, {"none"}));
}

}  // namespace
}  // namespace mechane::gateway
