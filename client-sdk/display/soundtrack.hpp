// The sounds of a world, and their captions for visitors who do not hear them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client-sdk/display/display_sound.hpp"
#include "client-sdk/sound/sound_captions.hpp"
#include "client-sdk/visit/subtitles.hpp"
#include <mechane/client/types.hpp>

namespace mechane::display {

/// The state of a world at one moment.
struct HeardWorld {
  const client::WorldStatus* status = nullptr;  ///< null: nobody speaks
  const client::Frame* frame = nullptr;         ///< null: nothing sounds
  const client::WorldPresentation* presentation = nullptr;
  std::span<const client::SceneObject> objects{};
  std::span<const client::WorldEvent> events{};
  std::string folder{};  ///< the scenario's
};

/// On the display's thread.
class Soundtrack {
 public:
  /// `audible`: whether sound is played; captions are shown in any case.
  Soundtrack(const SoundSettings& settings, bool audible, const std::string& language);

  /// Call it before a picture is composed: takes what is read aloud now.
  void read(const client::WorldStatus* status, const std::string& language, TimePoint now);
  /// Adds subtitles and sound captions.
  [[nodiscard]] std::string in_writing(const std::string& language, TimePoint now) const;
  /// Call it after a picture was drawn.
  void hear(const HeardWorld& world, const picture::Camera& ears, const std::string& language, TimePoint now);

  void set_levels(double volume, bool muted);
  /// None: there is no sound.
  [[nodiscard]] std::optional<sound::SoundState> state() const;

 private:
  SoundSettings settings_;
  bool audible_;
  std::string language_;
  std::optional<DisplaySound> sound_;
  sound::WorldSounds sounds_;
  sound::SoundCaptions captions_;
  visit::Subtitles subtitles_;
};

}  // namespace mechane::display
