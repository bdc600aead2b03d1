#include "client-sdk/sound/sound_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>

#include <fmt/format.h>
#include <sndfile.h>

namespace mechane::sound {
namespace {

constexpr sf_count_t kLongest_s = 600;
constexpr int kLowestRate_hz = 4'000;
constexpr int kHighestRate_hz = 192'000;
constexpr const char* kSoundRemedy = "save it as .wav or .ogg, mono or stereo, ten minutes at most";

struct SoundClose {
  void operator()(SNDFILE* file) const { sf_close(file); }
};

std::int16_t to_sample(float value) {
  return std::isfinite(value) ? static_cast<std::int16_t>(std::lround(32767 * std::clamp(value, -1.0F, 1.0F))) : 0;
}

/// Why sf_open() refused the file.
ErrorCode code_of_last_fault(const std::string& file) {
  std::error_code unreadable;
  if (!std::filesystem::exists(file, unreadable)) return ErrorCode::not_found;
  switch (sf_error(nullptr)) {
    case SF_ERR_SYSTEM:
      return ErrorCode::io_failure;
    case SF_ERR_UNSUPPORTED_ENCODING:
      return ErrorCode::not_supported;
    default:
      return ErrorCode::damaged;
  }
}

}  // namespace

Expected<SoundRecording> read_sound(const std::string& file) {
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, SoundClose> in(sf_open(file.c_str(), SFM_READ, &info));
  if (!in)
    return fail(code_of_last_fault(file), fmt::format("the sound cannot be read: {}", sf_strerror(nullptr)), file,
                kSoundRemedy);
  if (info.channels < 1 || info.channels > 2)
    return fail(ErrorCode::not_supported, fmt::format("the sound has {} channels", info.channels), file, kSoundRemedy);
  if (info.samplerate < kLowestRate_hz || info.samplerate > kHighestRate_hz)
    return fail(ErrorCode::not_supported, fmt::format("the sound has {} samples a second", info.samplerate), file,
                kSoundRemedy);
  const sf_count_t most = kLongest_s * info.samplerate;
  SoundRecording recording;
  recording.channels = info.channels;
  recording.rate_hz = info.samplerate;
  // Piece by piece, because the length in the header need not be true; as numbers of -1 .. 1, whatever the file stores.
  constexpr sf_count_t kFramesAtOnce = 1 << 14;
  const auto channels = static_cast<std::size_t>(info.channels);
  std::vector<float> piece(static_cast<std::size_t>(kFramesAtOnce) * channels);
  for (sf_count_t read = 0; read <= most;) {
    const sf_count_t got = sf_readf_float(in.get(), piece.data(), kFramesAtOnce);
    if (got <= 0) {
      if (recording.samples.empty()) return fail(ErrorCode::damaged, "the sound is empty", file, kSoundRemedy);
      return recording;
    }
    std::transform(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(got) * info.channels,
                   std::back_inserter(recording.samples), to_sample);
    read += got;
  }
  return fail(ErrorCode::too_large, "the sound is longer than ten minutes", file, kSoundRemedy);
}

}  // namespace mechane::sound
