// Reading a sound file that nobody vouches for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::sound {

/// 16-bit samples, one or two channels, interleaved.
struct SoundRecording {
  std::vector<std::int16_t> samples;
  int channels = 1;
  int rate_hz = 44'100;
};

/// Reads .wav, .ogg, .flac and what else libsndfile knows, whole. Blocks on the disk. Errors: no such file, no sound, more than two
/// channels, longer than ten minutes.
[[nodiscard]] Expected<SoundRecording> read_sound(const std::string& file);

}  // namespace mechane::sound
