// The sound of a display: the frame's effects, and each step's narration.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "client-sdk/picture/camera.hpp"
#include "client-sdk/sound/sound_player.hpp"
#include <mechane/client/types.hpp>

namespace mechane::display {

struct SoundSettings {
  bool on = true;
  double volume = 0.8;    ///< 0..1
  std::string narration;  ///< folder with SCENARIO/STEP.LANGUAGE.wav, .ogg or .flac; empty: the one beside the programs
};

/// The file of a step's narration in one language: the author's file, a path from the scenario's folder, or else the
/// one in the narration folder. Empty if there is none; names that lead out of their folder are ignored.
[[nodiscard]] std::string narration_file(const client::WorldStatus& status, const std::string& language,
                                         const std::string& scenario_folder, const std::string& narration_folder);

/// The folder `narration` beside the running program's folder; empty if there is none.
[[nodiscard]] std::string built_narration_folder();

/// Made and called on the display's thread; the player has its own. A missing sound card is reported once and has no
/// other effect.
class DisplaySound {
 public:
  DisplaySound(const SoundSettings& settings, std::string language);

  /// Call it once a picture. With a null `status`, nobody speaks.
  void hear(const picture::Camera& ears, std::vector<sound::SoundSource> sources, const client::WorldStatus* status,
            const std::string& scenario_folder);
  /// Changes the language from the next picture on; the narration starts again in it.
  void set_language(const std::string& language) { language_ = language; }
  void set_levels(const sound::SoundLevels& levels) { player_.set_levels(levels); }
  [[nodiscard]] sound::SoundState state() const { return player_.state(); }

 private:
  std::string narration_folder_;
  std::string language_;
  sound::Narration narration_;
  std::set<std::string> told_;  ///< steps without narration that were logged
  sound::SoundPlayer player_;
};

}  // namespace mechane::display
