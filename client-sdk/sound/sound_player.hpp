// Sound beside the drawing: a thread of its own opens the device, reads files and plays what the display says once a frame.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "client-sdk/sound/sound_engine.hpp"
#include "client-sdk/sound/sound_scene.hpp"

namespace mechane::sound {

struct SoundPlayerOptions {
  SoundLevels levels;
  std::chrono::milliseconds first_retry{
      5'000};  ///< of a device that is not there or was lost; each waits twice as long
  std::chrono::milliseconds longest_retry{600'000};
  std::chrono::milliseconds forget{
      2'000};  ///< no new scene for so long: the effects fade, for the display stands still
};

/// For a status that others see.
struct SoundState {
  bool sounding = false;  ///< a device is open
  std::string device;
  std::string problem;              ///< why not; empty while it sounds, or before it was tried
  std::set<std::string> bad_files;  ///< narrations that could not be read
  std::size_t voices = 0;
  std::string speaking;  ///< id of the narration that is heard
};

/// Owns a thread. Where there is no device, a lost one or a bad file, it goes on without, says so once in the log, and tries again. The
/// functions may be called from any thread, and wait for nothing but a short lock.
class SoundPlayer {
 public:
  explicit SoundPlayer(SoundPlayerOptions options);
  ~SoundPlayer();
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;

  /// What is heard from now on; once a frame.
  void play(SoundScene scene);
  void set_levels(const SoundLevels& levels);
  [[nodiscard]] SoundLevels levels() const;
  [[nodiscard]] SoundState state() const;

 private:
  using Clock = std::chrono::steady_clock;
  void run(const std::stop_token& stop);
  void tend_device(Clock::time_point now);
  void tell(Error error, Clock::time_point now);
  void play_newest(Clock::time_point now, Clock::duration step);

  SoundPlayerOptions options_;
  std::unique_ptr<SoundEngine> engine_;  ///< the thread's alone, as the next four
  std::chrono::milliseconds pause_{0};
  Clock::time_point next_try_;
  std::string told_;
  SoundScene playing_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any news_;
  std::optional<SoundScene> wanted_;
  Clock::time_point wanted_at_;
  SoundLevels levels_;
  SoundState state_;
  std::jthread thread_;  ///< last: it must end first
};

}  // namespace mechane::sound
