// What is heard in a frame, as plain data: from what the client library receives to what the player plays. Nothing sounds by itself:
// gains and places come from the frame, knocks from events.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client-sdk/sound/sound_synth.hpp"
#include "server/base/math.hpp"
#include <mechane/client/types.hpp>

namespace mechane::sound {

/// The ears.
struct SoundListener {
  Vec3 p_W = Vec3::Zero();
  Vec3 forward_W = -Vec3::UnitZ();
  Vec3 up_W = Vec3::UnitY();
};

struct SoundSource {
  std::string id;  ///< the same from frame to frame for the same source
  SoundKind kind = SoundKind::water;
  Vec3 p_W = Vec3::Zero();
  double gain = 0;     ///< 0..1, at `near_m` and nearer; beyond, it falls with the distance
  double pitch = 1;    ///< 0.5 .. 2
  double near_m = 2;   ///< about the size of what sounds
  bool looped = true;  ///< false: it plays once, from the frame in which its id is new
};

/// Plays once, from the frame in which its id is new; another id, or none, ends it.
struct Narration {
  std::string id;
  std::string file;  ///< on this machine: .wav, .ogg, .flac; empty: it is not here yet, or the step has none
};

struct SoundScene {
  SoundListener listener;
  std::vector<SoundSource> sources;
  std::optional<Narration> narration;
};

/// An effect of the scenario that is heard; others ("smoke" ...) are passed over.
struct SoundEffect {
  std::string name;
  std::string
      kind;  ///< "sound.water", "sound.wood", "sound.rope", "sound.stone", "sound.fire", "sound.steam", "sound.ratchet",
             ///< "sound.bow"
  std::int32_t object = -1;  ///< index of the manifest; -1: none, p_B is in W
  Vec3 p_B = Vec3::Zero();
  std::int32_t quantity = -1;  ///< index into Frame::quantities; -1: how fast its point moves, m/s
  double full = 1;             ///< the amount at which it is as loud as it can be; negative counts as much as positive
  double size_m = 0;           ///< of what sounds
};

/// What the display knows now. Pointers may be null: nothing has come yet.
struct SoundInput {
  const client::Frame* before = nullptr;  ///< of the picture before, for speeds
  const client::Frame* now = nullptr;
  std::span<const client::WorldEvent> events{};  ///< since the picture before
  std::span<const client::SceneObject> objects{};
  std::span<const SoundEffect> effects{};
};

/// The sources of a frame: one for each effect that is heard, "effect NAME", and one for each event that makes a sound, whose place is
/// its object's. sound.bow sounds once, when its object (any, where it has none) is fired.
[[nodiscard]] std::vector<SoundSource> sound_sources(const SoundInput& input);

/// The same picture by picture, from what the client library has: keeps the frame of the picture before.
class WorldSounds {
 public:
  /// A null frame: nothing sounds.
  [[nodiscard]] std::vector<SoundSource> hear(const client::Frame* frame, const client::WorldPresentation* presentation,
                                              std::span<const client::SceneObject> objects,
                                              std::span<const client::WorldEvent> events);

 private:
  std::optional<client::Frame> before_;
};

}  // namespace mechane::sound
