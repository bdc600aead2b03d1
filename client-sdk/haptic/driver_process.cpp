#include "client-sdk/haptic/driver_process.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "server/base/program_folder.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

// What the drivers count is what the wire counts.
static_assert(MECHANE_FINGERS == hand::kFingers && MECHANE_HAND_JOINTS == hand::kHandJoints);

constexpr int kOpenMs = 30'000;        // some devices are sent their firmware first
constexpr Duration kLostAfter = 50ms;  // without a state
constexpr Duration kHangsAfter = 2s;
constexpr Duration kCloseWithin = 2s;
constexpr Duration kToldAfter = 1s;  // a condition that lasts

constexpr const char* kAgain = "start it again; if it happens again, tell the driver's maker";

std::string because(const char* what) {
  return std::string(what) + ": " + std::strerror(errno);
}

/// A copy of a file above those that the new process finds open, so that none is overwritten by another's number.
int out_of_the_way(int file) {
  return ::fcntl(file, F_DUPFD_CLOEXEC, 10);
}

/// Starts this program's sibling with the two files. Returns its number, or -1 with errno set.
pid_t spawn(const DriverProcessConfig& config, int link_file, int news_file) {
  std::string program = (program_folder() / "mechane-devices").string();
  std::string device = config.device.driver + ":" + config.device.options;
  std::string priority = std::to_string(config.fifo_priority);
  std::string serve = "--serve", fifo = "--fifo-priority";
  char* const argv[] = {program.data(), serve.data(), device.data(), fifo.data(), priority.data(), nullptr};
  const int link = out_of_the_way(link_file), news = out_of_the_way(news_file);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);  // for makers' libraries that print
  ::posix_spawn_file_actions_adddup2(&actions, link, kLinkFile);
  ::posix_spawn_file_actions_adddup2(&actions, news, kNewsFile);
  // A session of its own: a terminal's Ctrl-C, Ctrl-\ and Ctrl-Z are for the loop, and must not stop who writes the zero.
  // A maker's library may use the signals that the loop's program blocks.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
  sigset_t none;
  ::sigemptyset(&none);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  pid_t process = -1;
  const int error = ::posix_spawn(&process, program.c_str(), &actions, &attributes, argv, environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(link);
  ::close(news);
  errno = error;
  return error == 0 ? process : -1;
}

/// For a technician: what is the matter with the device, and what to do.
const char* in_words(client::DeviceState state) {
  using client::DeviceState;
  switch (state) {
    case DeviceState::let_go:
      return "the device is let go: hold its switch, or take it out of its holder";
    case DeviceState::not_ready:
      return "the device is not ready: take it in your hand; if that does not help, look at its power supply";
    case DeviceState::uncalibrated:
      return "the device is not calibrated, and renders no force: calibrate it as its maker says";
    case DeviceState::hot:
      return "the device's motors are too warm for any force: let it rest until they have cooled";
    default:
      return "the device is ready";
  }
}

}  // namespace

Expected<void> DriverProcess::open() {
  if (auto started = start(); !started) return close(), started;
  errno = 0;
  const std::optional<HostNews> first = next_news(kOpenMs);
  const bool interrupted = errno == EINTR;
  if (first && first->kind == HostNews::Kind::opened) {
    info_ = first->info;
    return {};
  }
  Error error{ErrorCode::timed_out, "it does not open within 30 s", place(), "unplug it, and plug it in again"};
  if (first)
    error = {ErrorCode::io_failure, first->text.data(), place(), {}};
  else if (interrupted)
    error = {ErrorCode::cancelled, "stopped while it was opening", place(), {}};
  else if (const auto death = died(kCloseWithin))
    error = *death;
  close();
  return tl::unexpected(error);
}

Expected<void> DriverProcess::start() {
  auto link = SharedLink::make();
  if (!link) return tl::unexpected(link.error());
  link_.emplace(std::move(*link));
  int pair[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair) != 0)
    return fail(ErrorCode::failed_process, because("no socket for the driver's process"), "device");
  news_ = pair[0];
  process_ = spawn(config_, link_->file(), pair[1]);
  ::close(pair[1]);
  if (process_ >= 0) return {};
  return fail(ErrorCode::failed_process, because("the driver's process cannot be started"),
              (program_folder() / "mechane-devices").string(),
              "build or install all programs of Mechane into one folder");
}

std::string DriverProcess::place() const {
  return "device '" + config_.device.driver + "'";
}

void DriverProcess::close() noexcept {
  condition_ = DeviceCondition::lost;
  if (news_ >= 0) ::close(std::exchange(news_, -1));  // the process sees the end of its socket
  if (process_ < 0) return;
  const TimePoint until = std::chrono::steady_clock::now() + kCloseWithin;
  while (::waitpid(process_, nullptr, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > until) ::kill(process_, SIGKILL);
    ::poll(nullptr, 0, 2);
  }
  process_ = -1;
}

std::optional<HostNews> DriverProcess::next_news(int wait_ms) const {
  pollfd news{news_, POLLIN, 0};
  HostNews told;
  if (::poll(&news, 1, wait_ms) <= 0 || ::recv(news_, &told, sizeof(told), MSG_DONTWAIT) != sizeof(told)) return {};
  told.text.back() = 0;
  return told;
}

std::optional<Error> DriverProcess::died(Duration within) const {
  const TimePoint until = std::chrono::steady_clock::now() + within;
  siginfo_t status{};
  while (::waitid(P_PID, static_cast<id_t>(process_), &status, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         status.si_pid == 0) {
    if (std::chrono::steady_clock::now() >= until) return {};
    ::poll(nullptr, 0, 2);
  }
  const std::string what = std::string("the driver's process ended ") +
                           (status.si_code == CLD_EXITED ? "with status " : "by signal ") +
                           std::to_string(status.si_status);
  return Error{ErrorCode::failed_process, what, place(), kAgain};
}

Expected<std::optional<std::string>> DriverProcess::check() {
  if (const std::optional<HostNews> news = next_news(0)) {
    told_lost_ = news->kind == HostNews::Kind::lost;
    if (told_lost_) return std::string("the device failed: ") + news->text.data() + "; trying again each second";
    if (news->kind == HostNews::Kind::back) return std::string("the device is back");
    return fail(ErrorCode::conflict, news->text.data(), place(), kAgain);
  }
  if (const auto error = died(Duration{0})) return tl::unexpected(*error);
  const TimePoint newest = newest_at_.load(), now = std::chrono::steady_clock::now();
  if (!told_lost_ && newest != TimePoint{} && now - newest > kHangsAfter)
    return fail(ErrorCode::timed_out, "the driver hangs", place(), kAgain);
  return changed_condition(now);
}

std::optional<std::string> DriverProcess::changed_condition(TimePoint now) {
  const client::DeviceState state = state_for_visitors(condition_, false, renders());
  if (std::exchange(seen_, state) != state) seen_since_ = now;
  // That a device is lost is told by its process, with the reason.
  if (state == client::DeviceState::lost || state == told_ || now - seen_since_ < kToldAfter) return {};
  told_ = state;
  return in_words(state);
}

bool DriverProcess::wait(Duration limit) noexcept {
  const TimePoint until = std::chrono::steady_clock::now() + limit;
  while (!came_ && wait_for((*link_)->state_came, until))
    came_ = (*link_)->states.take_newest(newest_);
  return came_;
}

client::HandSample DriverProcess::read(Duration) noexcept {
  const TimePoint now = std::chrono::steady_clock::now();
  came_ = (*link_)->states.take_newest(newest_) || came_;
  newest_at_.store(newest_.at);
  client::DevicePlace place;
  if (places_.take_newest(place)) {
    workspace_.put(place);
    speed_.forget();
  }
  const mechane_device_state& state = newest_.value;
  const bool is_new = std::exchange(came_, false);
  if (is_new)
    clutched_ = workspace_.follow({state.position_m[0], state.position_m[1], state.position_m[2]}, state.buttons);
  DeviceCondition condition = now - newest_.at > kLostAfter ? DeviceCondition::lost : condition_of(state);
  if (condition == DeviceCondition::ready && clutched_) condition = DeviceCondition::clutched;
  condition_ = condition;
  if (!is_new) return last_;
  client::HandSample hand;
  hand.kind = info_.hand == MECHANE_HAND_GLOVE ? client::HandKind::glove : client::HandKind::one_point;
  static_cast<hand::HandBuild&>(hand) = build_of(static_cast<hand::HandSide>(info_.side), state, config_.hand_scale);
  hand.X_WH.p = workspace_.p_WH();
  const auto& q = state.orientation_wxyz;
  hand.X_WH.R = workspace_.R_WH(Quat(q[0], q[1], q[2], q[3]).normalized());
  const Duration step = newest_.at - last_at_;
  if (step >= kLostAfter) speed_.forget();
  hand.V_WH = speed_.note(hand.X_WH, step);
  std::copy(std::begin(state.joints_rad), std::end(state.joints_rad), hand.joints.begin());
  if (config_.glove) hand.joints = config_.glove->apply(hand.joints);
  hand.buttons = state.buttons & ~config_.workspace.clutch_button;
  const bool button = hand.kind == client::HandKind::one_point && (hand.buttons & 1u) != 0;
  hand.grasp_intent = button ? 1 : state.grasp;
  last_at_ = newest_.at;
  return last_ = hand;
}

void DriverProcess::write(const hand::HandForce& force) noexcept {
  if (!link_) return;
  Timed<mechane_device_force> out;
  const Vec3 force_D = workspace_.to_device(force.force_W.f), torque_D = workspace_.to_device(force.force_W.t);
  std::copy(force_D.begin(), force_D.end(), std::begin(out.value.force_n));
  std::copy(torque_D.begin(), torque_D.end(), std::begin(out.value.torque_nm));
  std::copy(force.finger_force_n.begin(), force.finger_force_n.end(), std::begin(out.value.finger_n));
  out.at = std::chrono::steady_clock::now();
  (*link_)->forces.publish(out);
  ::sem_post(&(*link_)->force_came);
}

hand::GovernorConfig DriverProcess::limits() const {
  hand::GovernorConfig limits;
  limits.max_force_n = info_.peak_force_n;
  limits.max_torque_nm = info_.peak_torque_nm;
  limits.max_finger_force_n = info_.peak_finger_force_n;
  return limits;
}

}  // namespace mechane::haptic
