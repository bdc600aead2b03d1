// What sounds, in writing, for who does not hear it: "[wood creaking]", for some seconds from when it begins.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "client-sdk/sound/sound_scene.hpp"
#include "server/base/clock.hpp"

namespace mechane::sound {

class SoundCaptions {
 public:
  /// Once a picture: what sounds in it.
  void hear(std::span<const SoundSource> sources, TimePoint now);
  /// The sounds that began of late; empty: none. English where the language is unknown.
  [[nodiscard]] std::string at(TimePoint now, const std::string& language) const;

 private:
  struct Heard {
    TimePoint begun;
    TimePoint last;
  };
  std::array<std::optional<Heard>, kSoundKinds.size()> heard_;  ///< by kind
};

}  // namespace mechane::sound
