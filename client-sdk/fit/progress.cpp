#include "client-sdk/fit/progress.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "client-sdk/fit/table.hpp"

namespace mechane::fit {
namespace {

constexpr std::chrono::milliseconds kRedraw{100};
constexpr std::chrono::seconds kLine{5};
constexpr std::size_t kMeshColumns = 28;
constexpr std::size_t kBarCells = 24;
constexpr double kKnownAfter_s = 2;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::size_t columns_of(std::FILE* out) {
  winsize size{};
  if (ioctl(fileno(out), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

/// What is left, from what was done so far: parts take about the same time each.
std::string time_left(const Stage& stage, double seconds) {
  if (stage.done == 0 || stage.done >= stage.total || seconds < kKnownAfter_s) return "";
  const auto left = static_cast<double>(stage.total - stage.done) / static_cast<double>(stage.done);
  return fmt::format(", about {:.0f} s left", left * seconds);
}

}  // namespace

std::string bar_line(const Stage& stage, double seconds, std::size_t columns) {
  std::string bar;
  if (stage.total > 0) {
    const std::size_t full = kBarCells * std::min(stage.done, stage.total) / stage.total;
    for (std::size_t i = 0; i < kBarCells; ++i)
      bar += i < full ? "█" : "░";
    bar += fmt::format(" {}/{}", std::min(stage.done, stage.total), stage.total);
  }
  const std::string text = fmt::format("{} {} {}, {:.0f} s{}", fitted_text(stage.mesh, kMeshColumns), bar, stage.what,
                                       seconds, time_left(stage, seconds));
  std::string line = fitted_text(text, std::max<std::size_t>(columns, 2) - 1);
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

std::string plain_line(const Stage& stage, double seconds) {
  const std::string count =
      stage.total > 0 ? fmt::format(", {} of {}", std::min(stage.done, stage.total), stage.total) : "";
  return fmt::format("{}: {}{}, {:.0f} s{}", stage.mesh, stage.what, count, seconds, time_left(stage, seconds));
}

Progress::Progress(std::FILE* out) : out_(out), terminal_(isatty(fileno(out)) != 0), thread_([this] { run(); }) {}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    leave_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Progress::begin(Stage stage) {
  const std::lock_guard lock(mutex_);
  if (!active_ || stage.mesh != stage_.mesh) began_s_ = now_s();
  stage_ = std::move(stage);
  active_ = true;
  if (terminal_ || stage_.total > 0) draw();  // in a log, the long stage is shown from its start
}

void Progress::advance(std::size_t done, std::size_t total) {
  const std::lock_guard lock(mutex_);
  stage_.done = std::max(stage_.done, done);
  stage_.total = total;
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  if (active_ && terminal_) {
    std::fputs("\r\033[K", out_);
    std::fflush(out_);
  }
  active_ = false;
}

void Progress::run() {
  std::unique_lock lock(mutex_);
  auto due = std::chrono::steady_clock::now() + kLine;
  while (!leave_) {
    changed_.wait_until(lock, terminal_ ? std::chrono::steady_clock::now() + kRedraw : due, [this] { return leave_; });
    if (std::chrono::steady_clock::now() >= due) due += kLine;
    if (!leave_ && active_) draw();
  }
}

void Progress::draw() {
  const double seconds = now_s() - began_s_;
  if (terminal_) {
    fmt::print(out_, "\r\033[K{}", bar_line(stage_, seconds, columns_of(out_)));
  } else {
    fmt::print(out_, "{}\n", plain_line(stage_, seconds));
  }
  std::fflush(out_);
}

}  // namespace mechane::fit
