// LoopTurns: what a haptic loop's thread does in each turn: the world, nothing, or a test of the device.
#pragma once

#include <atomic>
#include <optional>
#include <utility>

#include "client-sdk/haptic/hand_recorder.hpp"
#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/wall_test.hpp"
#include "server/base/assert.hpp"
#include "server/base/clock.hpp"
#include "server/realtime/mailbox.hpp"

namespace mechane::haptic {

/// The hand and what it feels, as staff are told.
struct HandNow {
  Vec3 p_WH = Vec3::Zero();
  double force_n = 0;
  double temperature = -1;  ///< of the device's motors: 0 cold to 1 too hot; below 0: not known
};

/// turn() is the loop's thread's, all else the main thread's.
class LoopTurns {
 public:
  /// `recorder` may be null.
  LoopTurns(HapticLoop& loop, HandRecorder* recorder) : loop_(loop), recorder_(recorder) {}

  /// `temperature` as in HandNow.
  void turn(TimePoint now, Duration dt, double temperature = -1) noexcept {
    const Mode mode = mode_.load(std::memory_order_acquire);
    const Mode before = std::exchange(before_, mode);
    switch (mode) {
      case Mode::world:
        if (before != mode) loop_.begin_anew();
        loop_.tick(now, dt);
        if (recorder_ != nullptr) recorder_->note(loop_.hand(), now);
        now_.publish({loop_.hand().X_WH.p, loop_.rendered().force_W.f.norm(), temperature});
        break;
      case Mode::pause:
        if (loop_.release(now, dt)) rests_in_.store(mode, std::memory_order_release);
        break;
      case Mode::test:
      case Mode::end_test:
        test_->tick(dt, mode == Mode::test);
        report_.publish(test_->report());
        now_.publish({test_->report().p_WH, test_->report().force_n, temperature});
        if (test_->rests()) rests_in_.store(mode, std::memory_order_release);
        break;
    }
  }

  /// Ramps the force of the world, or of a test, down, so that the hand does not feel it stop. True: it is zero, and stays so until
  /// resume() or start(). False: it does not go to zero within a second, which is for the driver's own process to end.
  bool pause() {
    if (tests()) (void)rests_in(Mode::end_test);
    return rests_in(Mode::pause);
  }
  /// After pause(). The world comes back once the hand touches nothing.
  void resume() { mode_.store(Mode::world, std::memory_order_release); }
  /// After pause().
  void start(WallTest test) {
    MECHANE_ASSERT(mode_ == Mode::pause);  // else the loop's thread may be using the former test
    test_.emplace(std::move(test));
    mode_.store(Mode::test, std::memory_order_release);
  }
  [[nodiscard]] bool tests() const { return mode_ == Mode::test; }
  /// Of the test that runs, or of the last one.
  [[nodiscard]] const WallReport& report() {
    (void)report_.take_newest(seen_);
    return seen_;
  }
  /// In the newest turn of the world, or of a test.
  [[nodiscard]] const HandNow& hand() {
    (void)now_.take_newest(hand_);
    return hand_;
  }

 private:
  enum class Mode : std::uint8_t { world, pause, test, end_test };

  bool rests_in(Mode mode) {
    rests_in_ = Mode::world;
    mode_.store(mode, std::memory_order_release);
    SystemClock clock;
    for (int i = 0; i < 100 && rests_in_.load(std::memory_order_acquire) != mode; ++i)
      clock.sleep_until(clock.now() + std::chrono::milliseconds(10));
    return rests_in_ == mode;
  }

  HapticLoop& loop_;
  HandRecorder* recorder_;
  std::atomic<Mode> mode_{Mode::world};
  std::atomic<Mode> rests_in_{Mode::world};  // the last mode in which the force was zero
  Mode before_ = Mode::world;                // of the last turn
  std::optional<WallTest> test_;
  realtime::Mailbox<WallReport> report_;
  WallReport seen_;
  realtime::Mailbox<HandNow> now_;
  HandNow hand_;
};

}  // namespace mechane::haptic
