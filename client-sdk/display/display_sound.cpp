#include "client-sdk/display/display_sound.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "client-sdk/visit/subtitles.hpp"
#include "server/base/program_folder.hpp"
#include "server/log/log.hpp"

namespace mechane::display {
namespace {

namespace fs = std::filesystem;

/// Whether a name is that of a file directly in a folder, and does not lead out of it.
bool is_plain(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

bool stays_inside(const fs::path& path) {
  if (path.empty() || path.is_absolute()) return false;
  const fs::path normal = path.lexically_normal();
  return !normal.empty() && *normal.begin() != "..";
}

std::string if_there(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) ? file.string() : std::string();
}

sound::SoundListener at(const picture::Camera& camera) {
  return {camera.p_WC, (camera.p_WT - camera.p_WC).normalized(), camera.up_W};
}

sound::SoundPlayerOptions options_of(const SoundSettings& settings) {
  sound::SoundPlayerOptions options;
  options.levels.volume = settings.volume;
  return options;
}

}  // namespace

std::string narration_file(const client::WorldStatus& status, const std::string& language,
                           const std::string& scenario_folder, const std::string& narration_folder) {
  const auto named = status.audio.find(language);
  if (named != status.audio.end() && !scenario_folder.empty() && stays_inside(named->second)) {
    if (std::string file = if_there(fs::path(scenario_folder) / named->second); !file.empty()) return file;
  }
  if (narration_folder.empty() || !is_plain(status.scenario) || !is_plain(status.step) || !is_plain(language))
    return {};
  for (const char* ending : {".wav", ".ogg", ".flac"}) {
    const fs::path file = fs::path(narration_folder) / status.scenario / (status.step + "." + language + ending);
    if (std::string found = if_there(file); !found.empty()) return found;
  }
  return {};
}

std::string built_narration_folder() {
  std::error_code error;
  const fs::path folder = program_folder().parent_path() / "narration";
  return fs::is_directory(folder, error) ? folder.string() : std::string();
}

DisplaySound::DisplaySound(const SoundSettings& settings, std::string language)
    : narration_folder_(settings.narration.empty() ? built_narration_folder() : settings.narration),
      language_(std::move(language)),
      player_(options_of(settings)) {}

void DisplaySound::hear(const picture::Camera& ears, std::vector<sound::SoundSource> sources,
                        const client::WorldStatus* status, const std::string& scenario_folder) {
  sound::SoundScene scene{at(ears), std::move(sources), {}};
  if (status != nullptr && !status->done) {
    // Once per step, so that the disk is not searched for every picture.
    const std::string id = visit::narration_id(*status) + " " + language_;
    if (id != narration_.id) {
      narration_ = {id, narration_file(*status, language_, scenario_folder, narration_folder_)};
      const auto said = status->narration.find(language_);
      if (narration_.file.empty() && said != status->narration.end() && told_.insert(id).second)
        log::warning(fmt::format(
            "step '{}' has no narration in language '{}' on this machine, so its words are only shown: record it with "
            "deploy/narration, or give --narration FOLDER",
            status->step, language_));
    }
    if (!narration_.file.empty()) scene.narration = narration_;
  }
  player_.play(std::move(scene));
}

}  // namespace mechane::display
