#include "client-sdk/fit/interruption.hpp"

#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include <unistd.h>

namespace mechane::fit {
namespace {

constexpr int kDone = SIGUSR1;  // sent to the waiting thread when the program ends normally

sigset_t awaited_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, kDone})
    sigaddset(&set, signal);
  return set;
}

}  // namespace

Interruption::Interruption() {
  const sigset_t set = awaited_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  thread_ = std::thread([this] { wait(); });
}

Interruption::~Interruption() {
  pthread_kill(thread_.native_handle(), kDone);
  thread_.join();
}

void Interruption::add_draft(const std::filesystem::path& file) {
  const std::lock_guard lock(mutex_);
  drafts_.insert(file);
}

void Interruption::remove_draft(const std::filesystem::path& file) {
  const std::lock_guard lock(mutex_);
  drafts_.erase(file);
}

void Interruption::wait() {
  const sigset_t set = awaited_signals();
  int signal = 0;
  while (sigwait(&set, &signal) != 0) {
  }
  if (signal == kDone) return;
  const std::lock_guard lock(mutex_);  // kept to the end, so that no new draft appears
  std::error_code ignored;
  for (const std::filesystem::path& draft : drafts_)
    std::filesystem::remove(draft, ignored);
  if (isatty(STDERR_FILENO) != 0) {
    constexpr std::string_view kLine = "\r\033[K\033[?25hinterrupted\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, kLine.data(), kLine.size());
  }
  // Other threads are still computing, so no destructors are run and no streams are flushed.
  std::_Exit(128 + signal);
}

}  // namespace mechane::fit
