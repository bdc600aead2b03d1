#include "server/base/thread_setup.hpp"

#include <array>
#include <csignal>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <pthread.h>

namespace mechane {
namespace {

TEST(SetUpThread, ShowsTheBeginningOfALongNameAndLeavesSignalsToOthers) {
  std::array<char, 16> name{};
  bool interrupted = false;
  std::thread([&] {
    set_up_thread("a name of more than 15 bytes");
    pthread_getname_np(pthread_self(), name.data(), name.size());
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
    interrupted = sigismember(&blocked, SIGINT) == 0 || sigismember(&blocked, SIGXFSZ) == 0;
  }).join();
  EXPECT_EQ(std::string(name.data()), "a name of more ");
  EXPECT_FALSE(interrupted);
}

}  // namespace
}  // namespace mechane
