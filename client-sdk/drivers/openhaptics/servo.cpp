#include "client-sdk/drivers/openhaptics/servo.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "client-sdk/drivers/vectors.hpp"

namespace mechane::drivers::hd {
namespace {

constexpr auto kStale = std::chrono::milliseconds(20);
constexpr auto kRest = std::chrono::seconds(10);
constexpr double kTooWarm = 0.7, kCool = 0.5;  // the vendor's example for warm motors
constexpr double kReach_m = 2;                 // twice that of the largest Premium
constexpr double kMetre_per_mm = 0.001;

int new_bell() {
  const int bell = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (bell < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
  return bell;
}

}  // namespace

bool Heat::update(double temperature, bool warned, Clock::time_point now) noexcept {
  if (warned) rest_until_ = now + kRest;
  if (warned || temperature > kTooWarm)
    hot_ = true;
  else if (temperature < kCool && now >= rest_until_)
    hot_ = false;
  return hot_;
}

double warmest(std::span<const double> temperatures) noexcept {
  double most = -1;
  for (const double t : temperatures)
    if (std::isfinite(t) && t >= 0) most = std::max(most, t);
  return most;
}

bool convert(const Sample& sample, const Traits& traits, std::span<const double, 3> centre_mm,
             mechane_device_state& state) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    state.position_m[i] = (sample.position_mm[i] - centre_mm[i]) * kMetre_per_mm;
    if (!(std::abs(state.position_m[i]) < kReach_m)) return false;
  }
  if (traits.gimbal) {
    const std::array<double, 16>& t = sample.transform;
    const std::array<double, 9> by_rows = {t[0], t[4], t[8], t[1], t[5], t[9], t[2], t[6], t[10]};
    if (!quaternion_of(by_rows, state.orientation_wxyz)) return false;
  }
  state.buttons = static_cast<std::uint32_t>(sample.buttons) & 0xFu;
  state.temperature = std::min(warmest(sample.temperatures), 1.0);
  if (sample.ready) state.flags |= MECHANE_STATE_READY;
  if (sample.docked) state.flags |= MECHANE_STATE_DEAD_MAN;
  if (!sample.calibrated) state.flags |= MECHANE_STATE_UNCALIBRATED;
  if (sample.hot) state.flags |= MECHANE_STATE_HOT;
  return true;
}

Servo::Servo(const Api& api, Handle device, const Traits& traits)
    : api_(api), device_(device), traits_(traits), bell_(new_bell()) {}

Servo::~Servo() {
  ::close(bell_);
}

unsigned int Servo::tick() noexcept {
  Sample sample;
  calibrate();
  api_.begin_frame(device_);
  get(sample);
  set(sample.ready && !heat_.hot());
  api_.end_frame(device_);
  const Errors errors = pop_errors(api_);
  sample.lost = errors.serious;
  sample.hot = heat_.update(warmest(sample.temperatures), errors.warm, Clock::now());
  const bool last = force_.last || sample.lost.code != 0;
  samples_.put(sample);
  if (last) ended_.store(true, std::memory_order_release);
  (void)::eventfd_write(bell_, 1);
  return last ? kDone : kContinue;
}

/// Four times a second, outside a frame. An update can make the position jump, so it waits until no force is rendered.
/// An arm whose encoders are reset by hand is calibrated with the vendor's own program: only a person can tell that it
/// is held in its reset pose.
void Servo::calibrate() noexcept {
  if (ticks_++ % std::max(1u, traits_.ticks_a_second / 4) != 0) return;
  unsigned int found = api_.check_calibration();
  if (found == kNeedsUpdate && !pushing_ && traits_.style != kEncoderReset) {
    api_.update_calibration(static_cast<unsigned int>(traits_.style));
    found = api_.check_calibration();
  }
  if (found == kCalibrated)
    calibrated_ = true;
  else if (found != kNeedsUpdate)  // a better calibration is at hand: the one before still holds
    calibrated_ = false;
  (void)pop_errors(api_);  // of an update that was refused; a device that is gone says so in the frame
}

void Servo::get(Sample& sample) noexcept {
  api_.get_integer(kCurrentButtons, &sample.buttons);
  api_.get_double(kCurrentPosition, sample.position_mm.data());
  api_.get_double(kCurrentTransform, sample.transform.data());
  sample.temperatures.fill(-1);
  if (traits_.temperature) api_.get_double(kMotorTemperature, sample.temperatures.data());
  if (traits_.style == kInkwell) {
    unsigned char undocked = 1;
    api_.get_boolean(kCurrentInkwellSwitch, &undocked);
    was_undocked_ = was_undocked_ || undocked != 0;
    sample.docked = was_undocked_ && undocked == 0;
  }
  sample.calibrated = calibrated_;
  sample.ready = calibrated_ && !sample.docked;
}

/// Within a frame. Sets a force in each one: the zero, too.
void Servo::set(bool allowed) noexcept {
  static constexpr std::array<double, 3> kZero{};
  (void)forces_.take(force_);
  const bool pushes = allowed && !force_.last && Clock::now() - force_.asked < kStale;
  api_.set_double(kCurrentForce, pushes ? force_.force_n.data() : kZero.data());
  if (traits_.torque) api_.set_double(kCurrentTorque, pushes ? force_.torque_mnm.data() : kZero.data());
  pushing_ = pushes && (force_.force_n != kZero || force_.torque_mnm != kZero);
}

bool Servo::next(Sample& into, Clock::time_point deadline) noexcept {
  while (!samples_.take(into)) {
    if (Clock::now() >= deadline) return false;
    wait_for_tick(deadline);
  }
  return true;
}

bool Servo::ended(Clock::time_point deadline) noexcept {
  while (!ended_.load(std::memory_order_acquire)) {
    if (Clock::now() >= deadline) return false;
    wait_for_tick(deadline);
  }
  return true;
}

/// Returns at the next ring, at one that nobody has heard yet, or at the deadline.
void Servo::wait_for_tick(Clock::time_point deadline) const noexcept {
  pollfd bell{bell_, POLLIN, 0};
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  if (left <= 0 || ::poll(&bell, 1, static_cast<int>(left)) <= 0) return;
  eventfd_t rings = 0;
  (void)::eventfd_read(bell_, &rings);
}

}  // namespace mechane::drivers::hd
