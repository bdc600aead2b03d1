#include "server/content/spawn_plan.hpp"

#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

namespace mechane::content {

SpawnPlan::SpawnPlan(const Streams& streams) {
  posix_spawnattr_init(&attributes_);
  posix_spawn_file_actions_init(&actions_);
  if (streams.input < 0)
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  else
    posix_spawn_file_actions_adddup2(&actions_, streams.input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions_, streams.output, STDOUT_FILENO);
  if (streams.errors >= 0) posix_spawn_file_actions_adddup2(&actions_, streams.errors, STDERR_FILENO);
  posix_spawn_file_actions_addclosefrom_np(&actions_, 3);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes_, &none);
  posix_spawnattr_setsigdefault(&attributes_, &all);
  posix_spawnattr_setpgroup(&attributes_, 0);
  int flags = POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP;
  // A high priority must not pass to the child. Idle priority does: the caller may not have the right to raise it.
  const int policy = sched_getscheduler(0);
  if (policy == SCHED_FIFO || policy == SCHED_RR) {
    const sched_param ordinary{};
    posix_spawnattr_setschedpolicy(&attributes_, SCHED_OTHER);
    posix_spawnattr_setschedparam(&attributes_, &ordinary);
    flags |= POSIX_SPAWN_SETSCHEDULER;
  }
  posix_spawnattr_setflags(&attributes_, static_cast<short>(flags));
}

SpawnPlan::~SpawnPlan() {
  posix_spawnattr_destroy(&attributes_);
  posix_spawn_file_actions_destroy(&actions_);
}

Expected<pid_t> SpawnPlan::start(const std::filesystem::path& program,
                                 const std::vector<std::string>& arguments) const {
  std::string name = program.string();
  std::vector<std::string> words = arguments;
  std::vector<char*> argv{name.data()};
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = -1;
  if (const int e = posix_spawn(&child, name.c_str(), &actions_, &attributes_, argv.data(), environ); e != 0)
    return fail(ErrorCode::failed_process, fmt::format("cannot be started: {}", std::strerror(e)), name,
                "check the installation");
  return child;
}

}  // namespace mechane::content
