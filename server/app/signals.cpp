#include "server/app/signals.hpp"

#include <csignal>

#include <poll.h>
#include <pthread.h>
#include <sys/signalfd.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include "server/base/assert.hpp"

namespace mechane::app {
namespace {

sigset_t stop_set() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

StopSignals::StopSignals() {
  const sigset_t set = stop_set();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  // A write beyond the limit of file sizes must fail like one to a full disk, and not end the process.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  descriptor_ = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
  MECHANE_ASSERT(descriptor_ >= 0);
}

StopSignals::~StopSignals() {
  close(descriptor_);
  const sigset_t set = stop_set();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

StopAtOnce::StopAtOnce() {
  const sigset_t set = stop_set();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

StopAtOnce::~StopAtOnce() {
  const sigset_t set = stop_set();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

bool StopSignals::wait(int milliseconds) {
  if (stopping_) return true;
  pollfd waited{descriptor_, POLLIN, 0};
  if (poll(&waited, 1, milliseconds) <= 0) return false;
  signalfd_siginfo info{};
  stopping_ = read(descriptor_, &info, sizeof info) == static_cast<ssize_t>(sizeof info);
  return stopping_;
}

void notify_systemd(const char* state) {
  sd_notify(0, state);
}

}  // namespace mechane::app
