// Plays sound on a thread of its own, which opens the device, reads files and plays the scene that the display sets
// once a frame.
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
  /// For a missing or lost device; each pause is twice as long as the one before.
  std::chrono::milliseconds first_retry{5'000};
  std::chrono::milliseconds longest_retry{600'000};
  /// After this time without a new scene the effects fade out: the display has stopped.
  std::chrono::milliseconds forget{2'000};
};

/// For the display's status.
struct SoundState {
  bool sounding = false;  ///< a device is open
  std::string device;
  std::string problem;              ///< why nothing is heard; empty while it is, or before the first try
  std::set<std::string> bad_files;  ///< narration files that could not be read
  std::size_t voices = 0;
  std::string speaking;  ///< id of the narration that is heard
};

/// Owns a thread. Without a device, after losing it, or with a bad file, it continues without sound, logs this once,
/// and tries again. The functions may be called from any thread, and wait only for a short lock.
class SoundPlayer {
 public:
  explicit SoundPlayer(SoundPlayerOptions options);
  ~SoundPlayer();
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;

  /// Sets what is heard from now on; call it once a frame.
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
  std::unique_ptr<SoundEngine> engine_;  ///< this and the next four are used by the thread only
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
