#include "server/content/child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "server/content/spawn_plan.hpp"

namespace mechane::content {
namespace {

using Clock = std::chrono::steady_clock;

class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  [[nodiscard]] int get() const { return fd_; }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

 private:
  int fd_;
};

/// Waits for something to happen on the descriptor; false when the deadline came first.
bool wait_for(int fd, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd wanted{fd, POLLIN, 0};
    const int ready = poll(&wanted, 1, static_cast<int>(std::min<long long>(left, 60'000)));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

/// Reads until the writer closes (true), or time or room run out (false, with `result.end` set).
bool read_all(int fd, Clock::time_point deadline, std::uint64_t most, ChildResult& result) {
  std::array<std::byte, 65536> piece;
  for (;;) {
    if (!wait_for(fd, deadline)) {
      result.end = ChildResult::End::timed_out;
      return false;
    }
    const ssize_t n = read(fd, piece.data(), piece.size());
    if (n == 0) return true;
    if (n < 0) {
      if (errno == EINTR) continue;
      return true;
    }
    if (result.output.size() + static_cast<std::size_t>(n) > most) {
      result.end = ChildResult::End::too_long;
      return false;
    }
    result.output.insert(result.output.end(), piece.begin(), piece.begin() + n);
  }
}

}  // namespace

Expected<ChildResult> run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                std::chrono::milliseconds wall_time, std::uint64_t most_output,
                                const std::stop_token& stop) {
  const Clock::time_point deadline = Clock::now() + wall_time;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    return fail(ErrorCode::failed_process, fmt::format("no pipe to it can be made: {}", std::strerror(errno)),
                program.string(), "raise the limit of open files (ulimit -n)");
  const Descriptor ours(ends[0]);
  Descriptor theirs(ends[1]);

  const auto started = SpawnPlan({.output = theirs.get()}).start(program, arguments);
  if (!started) return tl::unexpected(started.error());
  const pid_t child = *started;
  theirs.close();

  const auto kill_all = [child] {
    kill(-child, SIGKILL);
    kill(child, SIGKILL);
  };
  ChildResult result;
  // Removed before waitpid(): after that, another process may get the child's number, and would be killed.
  std::optional<std::stop_callback<decltype(kill_all)>> when_stopped(std::in_place, stop, kill_all);
  // The raw call: Debian 12's header declares its function without C linkage.
  const Descriptor handle(static_cast<int>(syscall(SYS_pidfd_open, child, 0)));
  bool ended = read_all(ours.get(), deadline, most_output, result);
  if (ended && !wait_for(handle.get(), deadline)) {
    result.end = ChildResult::End::timed_out;
    ended = false;
  }
  if (!ended) kill_all();
  when_stopped.reset();
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (ended && WIFSIGNALED(status)) {
    result.end = ChildResult::End::signalled;
    result.code = WTERMSIG(status);
  } else if (ended) {
    result.code = WEXITSTATUS(status);
  }
  return result;
}

}  // namespace mechane::content
