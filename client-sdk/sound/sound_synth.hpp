// The exhibits' sounds, synthesised from noise and resonances by a table of numbers, with the same bits at each start.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace mechane::sound {

inline constexpr int kSoundRate_hz = 44'100;

enum class SoundKind : std::uint8_t {
  water,   ///< a stream
  splash,  ///< once
  creak,   ///< wood that turns in wood
  knock,   ///< once: wood on wood
  rope,    ///< under strain
  scrape,  ///< stone on stone
  thud,    ///< once: stone set down
  fire,
  steam,    ///< a hiss
  bow,      ///< once: a string let go
  ratchet,  ///< eight clicks a second, at pitch 1
};

inline constexpr std::array kSoundKinds{SoundKind::water, SoundKind::splash, SoundKind::creak,  SoundKind::knock,
                                        SoundKind::rope,  SoundKind::scrape, SoundKind::thud,   SoundKind::fire,
                                        SoundKind::steam, SoundKind::bow,    SoundKind::ratchet};

[[nodiscard]] std::string_view name_of(SoundKind kind);

/// One channel at kSoundRate_hz, within -1 .. 1.
struct SoundClip {
  std::vector<float> samples;
  bool loops = false;  ///< its end continues seamlessly at its beginning
};

/// Takes some milliseconds. Any thread; the same samples each time.
[[nodiscard]] SoundClip synthesise(SoundKind kind);

}  // namespace mechane::sound
