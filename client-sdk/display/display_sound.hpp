// What a display lets be heard: what sounds in the frame, and each step's narration.
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
  std::string narration;  ///< folder with SCENARIO/STEP.LANGUAGE.wav, .ogg or .flac; empty: that of the programs' build
};

/// The file of a step's narration in one language: what the author named, by its path from the scenario's folder, else that of the
/// narration's folder. Empty where there is none; names that lead out of their folder find nothing.
[[nodiscard]] std::string narration_file(const client::WorldStatus& status, const std::string& language,
                                         const std::string& scenario_folder, const std::string& narration_folder);

/// The folder `narration` beside that of the running program; empty where there is none.
[[nodiscard]] std::string built_narration_folder();

/// Made and called on the display's thread; the player has its own, and a missing sound card is told once and costs nothing else.
class DisplaySound {
 public:
  DisplaySound(const SoundSettings& settings, std::string language);

  /// Once a picture. `status` may be null: nobody speaks then.
  void hear(const picture::Camera& ears, std::vector<sound::SoundSource> sources, const client::WorldStatus* status,
            const std::string& scenario_folder);
  /// From the next picture on: what is read aloud begins anew in it.
  void set_language(const std::string& language) { language_ = language; }
  void set_levels(const sound::SoundLevels& levels) { player_.set_levels(levels); }
  [[nodiscard]] sound::SoundState state() const { return player_.state(); }

 private:
  std::string narration_folder_;
  std::string language_;
  sound::Narration narration_;
  std::set<std::string> told_;  ///< steps that have none
  sound::SoundPlayer player_;
};

}  // namespace mechane::display
