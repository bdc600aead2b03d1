// Reads a sound file, which is not trusted.
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

/// Reads a whole file: .wav, .ogg, .flac and all other formats of libsndfile. Blocks on the disk. Errors: no such file,
/// not a sound, more than two channels, longer than ten minutes.
[[nodiscard]] Expected<SoundRecording> read_sound(const std::string& file);

}  // namespace mechane::sound
