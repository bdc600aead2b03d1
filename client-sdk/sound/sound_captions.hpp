// Written captions for sounds, for visitors who do not hear them: "[wood creaking]", for some seconds from its
// beginning.
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
  /// Takes the sounds of a picture; call it once a picture.
  void hear(std::span<const SoundSource> sources, TimePoint now);
  /// The captions of sounds that began recently; empty: none. English where the language is unknown.
  [[nodiscard]] std::string at(TimePoint now, const std::string& language) const;

 private:
  struct Heard {
    TimePoint begun;
    TimePoint last;
  };
  std::array<std::optional<Heard>, kSoundKinds.size()> heard_;  ///< by kind
};

}  // namespace mechane::sound
