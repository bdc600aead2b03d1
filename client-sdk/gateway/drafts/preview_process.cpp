#include "client-sdk/gateway/drafts/preview_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "server/base/clock.hpp"
#include "server/base/thread_setup.hpp"
#include "server/content/spawn_plan.hpp"

namespace mechane::gateway {
namespace {

constexpr int kLookEvery_ms = 100;
constexpr Duration kEndsWithin = std::chrono::seconds(5);

void close_both(const std::array<int, 2>& ends) {
  for (const int end : ends)
    if (end >= 0) close(end);
}

}  // namespace

Expected<std::unique_ptr<PreviewProcess>> PreviewProcess::start(const std::filesystem::path& program,
                                                                const std::vector<std::string>& arguments,
                                                                std::function<void()> ended, std::size_t lines_kept) {
  // Orders go through a socket: a write to a pipe that nobody reads would end this program.
  std::array<int, 2> orders{-1, -1}, words{-1, -1};
  const bool made =
      socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, orders.data()) == 0 && pipe2(words.data(), O_CLOEXEC) == 0;
  if (!made) {
    const std::string why = std::strerror(errno);
    close_both(orders);
    return fail(ErrorCode::failed_process, "no pipe to it can be made: " + why, program.string(),
                "raise the limit of open files (ulimit -n)");
  }
  const auto child =
      content::SpawnPlan({.input = orders[1], .output = words[1], .errors = words[1]}).start(program, arguments);
  close(orders[1]);
  close(words[1]);
  if (!child) {
    close(orders[0]);
    close(words[0]);
    return tl::unexpected(child.error());
  }
  // It has no other threads yet; those that come have this from it.
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(*child), kNice);
  fcntl(words[0], F_SETFL, O_NONBLOCK);
  // The raw call: Debian 12's header declares its function without C linkage.
  const int handle = static_cast<int>(syscall(SYS_pidfd_open, *child, 0));
  return std::unique_ptr<PreviewProcess>(
      new PreviewProcess(*child, orders[0], words[0], handle, lines_kept, std::move(ended)));
}

PreviewProcess::PreviewProcess(pid_t child, int orders, int words, int handle, std::size_t lines_kept,
                               std::function<void()> ended)
    : child_(child),
      orders_(orders),
      words_(words),
      handle_(handle),
      lines_kept_(lines_kept),
      ended_(std::move(ended)) {
  thread_ = std::thread([this] { hear(); });
}

PreviewProcess::~PreviewProcess() {
  end();
  thread_.join();
  for (const int descriptor : {orders_, words_, handle_})
    if (descriptor >= 0) close(descriptor);
}

bool PreviewProcess::order(const std::string& line) {
  const std::string text = line + "\n";
  return send(orders_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT) == static_cast<ssize_t>(text.size());
}

void PreviewProcess::end() {
  ending_.store(true, std::memory_order_release);
  shutdown(orders_, SHUT_WR);
}

std::vector<std::string> PreviewProcess::said() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> said(lines_.begin(), lines_.end());
  if (said.back().empty()) said.pop_back();
  return said;
}

void PreviewProcess::take(const char* bytes, std::size_t size) {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < size; ++i) {
    if (bytes[i] == '\n') {
      if (!lines_.back().empty()) lines_.emplace_back();
    } else if (lines_.back().size() < kLongestLine) {
      lines_.back() += bytes[i];
    }
    if (lines_.size() > lines_kept_ + 1) lines_.pop_front();
  }
}

/// Until the child has ended, and what it said is read. Its children may hold the pipe for longer: they are not waited for.
void PreviewProcess::hear() {
  set_up_thread("gateway-preview");
  TimePoint asked{};
  bool gone = false, speaks = true;
  while (!gone) {
    std::array<pollfd, 2> looked{{{speaks ? words_ : -1, POLLIN, 0}, {handle_, POLLIN, 0}}};
    (void)poll(looked.data(), looked.size(), kLookEvery_ms);
    gone = (looked[1].revents & POLLIN) != 0;
    std::array<char, 4096> piece;
    ssize_t size = 0;
    while ((size = read(words_, piece.data(), piece.size())) > 0)
      take(piece.data(), static_cast<std::size_t>(size));
    speaks = size < 0;
    if (gone || !ending_.load(std::memory_order_acquire)) continue;
    const TimePoint now = std::chrono::steady_clock::now();
    if (asked == TimePoint{}) {
      asked = now;
      kill(child_, SIGTERM);  // one that still reads its exhibit does not hear orders yet
    } else if (now - asked > kEndsWithin) {
      kill(-child_, SIGKILL);
    }
  }
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && !ending_.load(std::memory_order_acquire)) {
    const std::string words = std::string("\nit was ended by a signal: ") + strsignal(WTERMSIG(status)) + "\n";
    take(words.data(), words.size());
  }
  over_.store(true, std::memory_order_release);
  ended_();
}

}  // namespace mechane::gateway
