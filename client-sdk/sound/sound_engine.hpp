// Plays a SoundScene with OpenAL Soft: one device, a fixed set of voices. On one thread; sound_player.hpp has the thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "client-sdk/sound/sound_scene.hpp"
#include "server/base/error.hpp"

namespace mechane::sound {

enum class SoundOutput : std::uint8_t {
  device,   ///< the system's, or what OpenAL Soft's own settings say
  samples,  ///< none: render() gives stereo samples, for tests and recordings
};

struct SoundLevels {
  double volume = 1;  ///< 0..1, of everything
  bool muted = false;
};

/// While a voice speaks, everything else is that much quieter: 9 dB.
inline constexpr double kDuckedGain = 0.355;

/// Made, used and destroyed on one thread.
class SoundEngine {
 public:
  /// Opens the output and makes the sounds; may block for seconds where a sound server does not answer. Errors: no device.
  [[nodiscard]] static Expected<std::unique_ptr<SoundEngine>> open(SoundOutput output);
  ~SoundEngine();
  SoundEngine(const SoundEngine&) = delete;
  SoundEngine& operator=(const SoundEngine&) = delete;

  /// Brings what is heard to the scene, `step_s` after the last call: gains move within a tenth of a second, what is gone fades away.
  /// Of more sources than there are voices the loudest sound. A new narration is read from disk here; one that cannot be read is logged
  /// once and stays silent.
  void apply(const SoundScene& scene, const SoundLevels& levels, double step_s);

  /// The device was unplugged or its server ended: nothing is heard any more.
  [[nodiscard]] bool lost() const;
  [[nodiscard]] std::string device() const;
  /// Sources that are heard; without the narration.
  [[nodiscard]] std::size_t voices_playing() const;
  /// The narration that is speaking; empty: none.
  [[nodiscard]] std::string speaking() const;
  [[nodiscard]] const std::set<std::string>& bad_files() const;

  /// The next samples, left and right by turns, within -1 .. 1. SoundOutput::samples only.
  [[nodiscard]] std::vector<float> render(std::size_t frames);

 private:
  struct Impl;
  explicit SoundEngine(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace mechane::sound
