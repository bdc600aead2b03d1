// What is heard in a frame, as plain data: from what the client library receives to what the player plays. Gains and
// places depend on the frame, knocks on events.
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
  double near_m = 2;   ///< about the size of the sounding thing
  bool looped = true;  ///< false: it plays once, from the frame in which its id is new
};

/// Plays once, from the frame in which its id is new; a different or empty id ends it.
struct Narration {
  std::string id;
  std::string file;  ///< on this machine: .wav, .ogg, .flac; empty: not here yet, or the step has none
};

struct SoundScene {
  SoundListener listener;
  std::vector<SoundSource> sources;
  std::optional<Narration> narration;
};

/// An audible effect of the scenario; others ("smoke" ...) are ignored.
struct SoundEffect {
  std::string name;
  /// "sound.water", "sound.wood", "sound.rope", "sound.stone", "sound.fire", "sound.steam", "sound.ratchet",
  /// "sound.bow".
  std::string kind;
  std::int32_t object = -1;  ///< index of the manifest; -1: none, p_B is in W
  Vec3 p_B = Vec3::Zero();
  std::int32_t quantity = -1;  ///< index into Frame::quantities; -1: how fast its point moves, m/s
  double full = 1;             ///< the absolute amount at which it is loudest
  double size_m = 0;           ///< of the sounding thing
};

/// What the display knows now. Pointers are null before the first data.
struct SoundInput {
  const client::Frame* before = nullptr;  ///< the previous picture's, for speeds
  const client::Frame* now = nullptr;
  std::span<const client::WorldEvent> events{};  ///< since the previous picture
  std::span<const client::SceneObject> objects{};
  std::span<const SoundEffect> effects{};
};

/// The sources of a frame: "effect NAME" for each audible effect, and one for each event with a sound, at its object's
/// place. sound.bow sounds once, when its object (or any, if it has none) is fired.
[[nodiscard]] std::vector<SoundSource> sound_sources(const SoundInput& input);

/// Makes the sound scene of each picture from the client library's data; keeps the previous picture's frame.
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
