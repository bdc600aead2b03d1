#include "client-sdk/haptic/driver_host.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include <poll.h>
#include <sys/socket.h>

#include "server/realtime/priority.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

constexpr int kRetryMs = 1000;

TimePoint now() noexcept {
  return std::chrono::steady_clock::now();
}

void send_news(int socket, HostNews::Kind kind, const mechane_device_info& info, const std::string& text) noexcept {
  HostNews news;
  news.kind = kind;
  news.info = info;
  text.copy(news.text.data(), news.text.size() - 1);
  (void)::send(socket, &news, sizeof(news), MSG_NOSIGNAL | MSG_DONTWAIT);
}

/// What happened and what to do; the other process knows where.
std::string in_words(const Error& error) {
  return error.remedy.empty() ? error.what : error.what + "; " + error.remedy;
}

/// The limits that the loop has been told still hold.
bool same_device(const mechane_device_info& a, const mechane_device_info& b) {
  return a.hand == b.hand && a.side == b.side && a.output == b.output && a.peak_force_n == b.peak_force_n &&
         a.continuous_force_n == b.continuous_force_n && a.peak_torque_nm == b.peak_torque_nm &&
         a.peak_finger_force_n == b.peak_finger_force_n && std::strcmp(a.name, b.name) == 0;
}

}  // namespace

int DriverHost::run() {
  auto opened = driver_.open(options_);
  if (!opened) {
    tell(HostNews::Kind::refused, in_words(opened.error()));
    return 2;
  }
  info_ = *opened;
  tell(HostNews::Kind::opened);
  while (serve()) {
    if (!lost_) tell(HostNews::Kind::lost, why_);
    lost_ = true;
    driver_.close();
    do {
      if (loop_has_gone(kRetryMs)) return 0;
      opened = driver_.open(options_);
    } while (!opened);
    if (!same_device(*opened, info_)) {
      tell(HostNews::Kind::refused, "another device was connected in its place");
      return 2;
    }
    newest_ = {};
  }
  return 0;
}

bool DriverHost::serve() {
  SystemClock clock;
  const auto period = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(1 / info_.rate_hz));
  TimePoint next = clock.now();
  bool gone = false;
  while (!gone && exchange(period)) {
    if (std::exchange(lost_, false)) tell(HostNews::Kind::back);
    gone = loop_has_gone();
    if (info_.paces != 0) continue;
    next = std::max(next + period, clock.now());  // after a stall in step from now on: no burst
    clock.sleep_until(next);
  }
  why_ = driver_.why();
  (void)driver_.write({});
  return !gone;
}

bool DriverHost::exchange(Duration period) noexcept {
  Timed<mechane_device_state> state;
  const TimePoint asked = now();
  const bool read = driver_.read(state.value);
  state.at = now();
  link_->longest_read = std::max(link_->longest_read.load(), state.at - asked);
  if (!read) return false;
  link_->states.publish(state);
  ::sem_post(&link_->state_came);
  (void)wait_for(link_->force_came, state.at + period / 2);  // the answer to this state, if it comes in time
  (void)link_->forces.take_newest(newest_);
  return driver_.write(may_render(state.value) ? due(newest_, now()) : mechane_device_force{});
}

bool DriverHost::loop_has_gone(int wait_ms) const noexcept {
  pollfd end{news_, POLLIN, 0};  // the loop's process sends nothing: what can be read is the socket's end
  return ::poll(&end, 1, wait_ms) > 0;
}

void DriverHost::tell(HostNews::Kind kind, const std::string& text) const noexcept {
  send_news(news_, kind, info_, text);
}

int serve_driver(const DeviceName& device, int fifo_priority) {
  // systemd's SIGTERM goes to all processes: the loop's ramps the force down, and then lets go of this one.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGPIPE})
    std::signal(signal, SIG_IGN);
  auto link = SharedLink::attach(kLinkFile);
  auto driver = Driver::load(device.driver);
  if (!link || !driver) {
    const Error& error = !link ? link.error() : driver.error();
    send_news(kNewsFile, HostNews::Kind::refused, {}, in_words(error));
    return 2;
  }
  (void)realtime::take_fifo(fifo_priority);
  return DriverHost(std::move(*driver), device.options, std::move(*link), kNewsFile).run();
}

}  // namespace mechane::haptic
