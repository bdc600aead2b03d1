#include "client-sdk/haptic/device_desk.hpp"

#include <algorithm>

#include "server/log/log.hpp"

namespace mechane::haptic {
namespace {

constexpr Duration kTellEvery = std::chrono::seconds(1);

void answer(client::DeviceDetails& told, const client::DeviceRequest& request, const Expected<void>& done) {
  told.answered = request.id;
  told.refusal = done ? "" : done.error().to_string();
}

void note_hand(LoopTurns& turns, client::DeviceDetails& told) {
  const HandNow& hand = turns.hand();
  told.p_WH = hand.p_WH;
  told.force_n = hand.force_n;
  told.temperature = hand.temperature;
}

client::DeviceLimits limits_of(const mechane_device_info& info) {
  return {info.rate_hz,
          info.peak_force_n,
          info.continuous_force_n,
          info.peak_torque_nm,
          info.peak_finger_force_n,
          info.max_stiffness_n_per_m,
          Vec3(info.workspace_min_m[0], info.workspace_min_m[1], info.workspace_min_m[2]),
          Vec3(info.workspace_max_m[0], info.workspace_max_m[1], info.workspace_max_m[2])};
}

}  // namespace

DeviceDesk::DeviceDesk(client::Client& client, DriverProcess& device, HapticLoop& loop, LoopTurns& turns,
                       const DeviceThread& thread, client::DeviceDetails& told, TimePoint now)
    : client_(client), device_(device), loop_(loop), turns_(turns), pace_(thread, now), told_(told), next_(now) {
  told_.limits = limits_of(device.info());
}

client::DeviceState DeviceDesk::state() const {
  return turns_.tests() ? state_for_visitors(device_.condition(), false, device_.renders()) : loop_.device_state();
}

void DeviceDesk::look(TimePoint now) {
  for (const client::DeviceRequest& request : client_.take_device_requests())
    take(request, now);
  if (now >= test_ends_) end_test();
  note(now);
  if (now < next_) return;
  next_ = turns_.tests() ? now : now + kTellEvery;
  (void)client_.tell_details(told_);
}

void DeviceDesk::take(const client::DeviceRequest& request, TimePoint now) {
  const Expected<void> done = act(request, now);
  if (!done) log::warning(done.error().to_string());
  answer(told_, request, done);
  next_ = now;
}

Expected<void> DeviceDesk::act(const client::DeviceRequest& request, TimePoint now) {
  using client::DeviceAction;
  switch (request.action) {
    case DeviceAction::place:
      return put(request.place);
    case DeviceAction::calibrate:
      fits_ = device_.info().hand == MECHANE_HAND_GLOVE;
      if (fits_) return {};
      return fail(ErrorCode::not_supported, "only a glove is fitted to a hand", "device",
                  "calibrate this device as its maker says");
    case DeviceAction::test:
      return start_test(now);
    case DeviceAction::end_test:
      end_test();
      return {};
  }
  return {};
}

Expected<void> DeviceDesk::pause(const char* place) {
  if (turns_.pause()) return {};
  turns_.resume();
  return fail(ErrorCode::timed_out, "its force does not go to zero", place, "stop the program, and look at the device");
}

void DeviceDesk::end_test() {
  if (!turns_.tests()) return;
  (void)turns_.pause();
  turns_.resume();
}

Expected<void> DeviceDesk::put(const client::DevicePlace& place) {
  if (turns_.tests()) return fail(ErrorCode::busy, "the device is being tested", "place", "end the test first");
  if (device_.condition() == DeviceCondition::clutched)
    return fail(ErrorCode::conflict, "its clutch is down", "place", "let go of the button first");
  if (auto paused = pause("place"); !paused) return paused;
  const bool holding = loop_.holding();  // the loop's thread leaves it as it is until it is resumed
  if (!holding) {
    device_.put(place);
    told_.place = place;
  }
  turns_.resume();
  if (holding) return fail(ErrorCode::conflict, "the hand holds something", "place", "let go of it first");
  return {};
}

Expected<void> DeviceDesk::start_test(TimePoint now) {
  if (!turns_.tests()) {
    auto test = WallTest::make(device_, device_.info().max_stiffness_n_per_m);
    if (!test) return tl::unexpected(test.error());
    if (auto paused = pause("test"); !paused) return paused;
    turns_.start(std::move(*test));
  }
  test_ends_ = now + kTestLasts;
  return {};
}

void DeviceDesk::note(TimePoint now) {
  const DevicePace::Seen pace = pace_.look(now);
  told_.rate_hz = pace.rate_hz;
  const double wanted_hz = told_.limits.wanted_hz;
  told_.late_us = std::max(0.0, to_us(pace.longest) - (wanted_hz > 0 ? 1e6 / wanted_hz : 0));
  note_hand(turns_, told_);
  told_.testing = turns_.tests();
  if (!told_.testing) return;
  const WallReport& report = turns_.report();
  told_.test_force_n = std::max(report.force_max_n, report.finger_force_max_n);
  told_.test_energy_j = report.energy_out_j;
}

void turn_down(client::Client& client, LoopTurns& turns, client::DeviceDetails& told, TimePoint now, TimePoint& next) {
  for (const client::DeviceRequest& request : client.take_device_requests()) {
    answer(told, request,
           fail(ErrorCode::not_supported, "a simulated device stays as it was started", "device",
                "start it again with other options"));
    next = now;
  }
  if (now < next) return;
  next = now + kTellEvery;
  note_hand(turns, told);
  (void)client.tell_details(told);
}

}  // namespace mechane::haptic
