#include "server/base/thread_setup.hpp"

#include <algorithm>
#include <array>
#include <csignal>

#include <pthread.h>

namespace mechane {

void set_up_thread(std::string_view name) noexcept {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, nullptr);
  std::array<char, 16> shown{};
  std::copy_n(name.begin(), std::min(name.size(), shown.size() - 1), shown.begin());
  pthread_setname_np(pthread_self(), shown.data());
}

}  // namespace mechane
