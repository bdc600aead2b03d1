// Plays a SoundScene with OpenAL Soft: one device, a fixed set of voices. On one thread; sound_player.hpp has the
// thread.
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
  device,   ///< the system's default, or the one in OpenAL Soft's own settings
  samples,  ///< none: render() gives stereo samples, for tests and recordings
};

struct SoundLevels {
  double volume = 1;  ///< 0..1, of everything
  bool muted = false;
};

/// Everything else is quieter by this factor (9 dB) while a voice speaks.
inline constexpr double kDuckedGain = 0.355;

/// Made, used and destroyed on one thread.
class SoundEngine {
 public:
  /// Opens the output and creates the sounds; may block for seconds if a sound server does not answer. Errors: no
  /// device.
  [[nodiscard]] static Expected<std::unique_ptr<SoundEngine>> open(SoundOutput output);
  ~SoundEngine();
  SoundEngine(const SoundEngine&) = delete;
  SoundEngine& operator=(const SoundEngine&) = delete;

  /// Plays the scene, `step_s` after the last call: gains change within a tenth of a second, and missing sources fade
  /// out. If there are more sources than voices, the loudest are heard. A new narration is read from disk here; one
  /// that cannot be read is logged once and stays silent.
  void apply(const SoundScene& scene, const SoundLevels& levels, double step_s);

  /// Whether the device was unplugged or its server ended, so that nothing is heard any more.
  [[nodiscard]] bool lost() const;
  [[nodiscard]] std::string device() const;
  /// The number of sources that are heard, without the narration.
  [[nodiscard]] std::size_t voices_playing() const;
  /// The id of the narration that is speaking; empty: none.
  [[nodiscard]] std::string speaking() const;
  [[nodiscard]] const std::set<std::string>& bad_files() const;

  /// The next samples, left and right alternating, within -1 .. 1. SoundOutput::samples only.
  [[nodiscard]] std::vector<float> render(std::size_t frames);

 private:
  struct Impl;
  explicit SoundEngine(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace mechane::sound
