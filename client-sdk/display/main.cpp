// mechane-display: shows a kiosk's world, in a window or offscreen.
#include <csignal>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "client-sdk/display/display_app.hpp"
#include "client-sdk/display/spare_memory.hpp"
#include "server/log/command_line.hpp"
#include "server/log/log.hpp"

namespace {

using namespace mechane;

display::DisplaySignals g_signals;  // set by signal handlers

/// An option that takes one of several words. CLI11's own transformer would print numbers for a wrong word.
template <class Value>
void add_words(CLI::App& app, const std::string& name, Value& value,
               const std::vector<std::pair<std::string_view, Value>>& words, const std::string& help) {
  std::vector<std::string> known;
  std::string usual;
  for (const auto& [word, meant] : words) {
    known.emplace_back(word);
    if (meant == value) usual = word;
  }
  app.add_option_function<std::string>(
         name,
         [&value, words](const std::string& given) {
           for (const auto& [word, meant] : words)
             if (word == given) value = meant;
         },
         help)
      ->check(CLI::IsMember(known))
      ->default_str(usual);
}

/// A length in metres. For values such as 65 (between the eyes, in millimetres), the message shows how to write them.
CLI::Validator metres(double least, double most) {
  const std::string range = fmt::format("{} to {} metres", least, most);
  return {[=](std::string& text) {
            double length = 0;
            const bool is_number = CLI::detail::lexical_cast(text, length);
            if (is_number && length >= least && length <= most) return std::string();
            return fmt::format("{} is not a length of {}; 65 mm is 0.065", text, range);
          },
          range};
}

/// Options of stereo and the screen.
void add_stereo_options(CLI::App& app, display::DisplayOptions& o) {
  add_words(
      app, "--stereo", o.stereo, picture::stereo_names(),
      "how the pictures of two eyes are shown: side by side (sbs) or one above the other; the same squeezed, for a 3D "
      "television; for red-cyan glasses; in alternating rows; in a driver's two buffers; or one eye only");
  app.add_flag("--right-eye-first", o.renderer.right_eye_first,
               "with --stereo rows: the uppermost row belongs to the right eye");
  auto* width = app.add_option("--screen-width", o.screen.width_m,
                               "of the picture that one eye sees; with --viewer-distance, depth has its true "
                               "proportions")
                    ->check(metres(0.05, 50));
  auto* distance =
      app.add_option("--viewer-distance", o.screen.viewer_distance_m, "from the visitor's eyes to the screen")
          ->check(metres(0.1, 50));
  width->needs(distance);
  distance->needs(width);
  app.add_option("--eye-separation", o.screen.eye_distance_m, "between the visitor's eyes; without: 0.064")
      ->check(metres(0.01, 0.2));
}

/// Checks of options that depend on each other.
void check_together(const display::DisplayOptions& o) {
  if (o.renderer.right_eye_first && o.stereo != picture::Stereo::row_interleaved)
    throw CLI::RequiresError("--right-eye-first", "--stereo rows");
  if (const auto ok = display::check_recordings(o.source, o.attract); !ok)
    throw CLI::ValidationError(ok.error().to_string());
}

/// Options for the daily operation of a kiosk.
void add_kiosk_options(CLI::App& app, display::DisplayOptions& o) {
  app.add_option("--name", o.name, "name of this display, if the kiosk has several (see mechane displays)")
      ->capture_default_str();
  app.add_option("--home-after", o.home_after_s,
                 "seconds without a hand's motion or a click after which the kiosk goes home; 0: never")
      ->check(CLI::Range(0.0, 86'400.0));
  app.add_option("--attract", o.attract,
                 "recording (made with --record) to show while nobody is there, with an invitation to touch")
      ->check(CLI::ExistingFile);
  app.add_option("--attract-after", o.attract_after_s,
                 "show it after this many seconds without a motion, touch or click")
      ->check(CLI::Range(5.0, 86'400.0))
      ->capture_default_str();
}

void add_options(CLI::App& app, display::DisplayOptions& o, std::string& size) {
  app.add_option("--kiosk", o.kiosk, "name of the kiosk")->capture_default_str();
  app.add_option("--domain", o.domain, "DDS domain")->capture_default_str();
  app.add_flag("--offscreen", o.offscreen, "draw without a window or a screen");
  app.add_option("--size", size, "width x height, pixels")->capture_default_str();
  app.add_flag("--full-screen", o.full_screen,
               "fill the screen from the start, and hide the cursor while the mouse rests; key F11");
  app.add_option("--language", o.language,
                 "language of all words; visitors can change it (key L), and it returns when they have gone")
      ->check(CLI::IsMember({"el", "en"}))
      ->capture_default_str();
  add_words<visit::AskWhen>(
      app, "--ask", o.ask,
      {{"none", visit::AskWhen::none}, {"after", visit::AskWhen::after}, {"both", visit::AskWhen::both}},
      "when visitors are asked an activity's questions");
  app.add_flag_callback(
      "--large-text", [&o] { o.overlay.text_scale = picture::kLargeText; }, "make words 1.35 times as large; key +");
  app.add_flag("--high-contrast", o.overlay.high_contrast, "white and yellow words on black; key C");
  std::vector<std::string> looks;
  for (const auto& [name, look] : scene::hand_look_names())
    looks.emplace_back(name);
  app.add_option("--hand", o.hand, "how drawn hands look: skin, or a glove of white cotton")
      ->check(CLI::IsMember(looks))
      ->capture_default_str();
  app.add_flag("--force-arrows", o.forces, "show the force on each hand as an arrow; key F");
  app.add_option("--assets", o.assets,
                 "folder or address to which mesh files are relative: http://server/scenario, or http://server:8000/ "
                 "if its root is "
                 "the scenarios' folder; without: the scenario's folder");
  app.add_option("--asset-cache", o.asset_cache,
                 "folder for fetched files; without: mechane/assets in $XDG_CACHE_HOME or ~/.cache");
  app.add_option("--asset-cache-mib", o.asset_cache_mib,
                 "its size limit in MiB; the files that were not used for the longest time are removed")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  app.add_option("--catalogue", o.catalogue,
                 "catalogue (see mechane content) in which mesh files are looked up first, by their content");
  app.add_option("--fonts", o.renderer.font_folder, "folder of the DejaVu fonts")->capture_default_str();
  app.add_option("--out", o.out,
                 "folder for pictures (PNG); SIGUSR1, or key P in the window, takes one; offscreen, the last picture "
                 "is written if no "
                 "other was");
  app.add_flag("--every-step", o.every_step, "write a picture of each step; offscreen, draw nothing else");
  app.add_option("--frames", o.frames, "stop after this many frames, and write the last one as a picture");
  app.add_option("--seconds", o.seconds, "stop after this time")->check(CLI::NonNegativeNumber);
  app.add_flag("--until-done", o.until_done, "stop when the last activity is done");
  // As callbacks, because for a flag that sets false CLI11's help would print --no-touch{false}.
  app.add_flag_callback(
      "--still-view", [&o] { o.follow_step = false; }, "show the usual view always, not what a step works on");
  app.add_flag_callback(
      "--no-touch", [&o] { o.touch = false; }, "mouse, fingers and keys move no hand: they can only click on signs");
  app.add_option("--volume", o.sound.volume, "of effects and narration, 0 to 1")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_flag_callback(
      "--mute", [&o] { o.sound.on = false; }, "play no sound");
  app.add_option("--narration", o.sound.narration,
                 "folder with the recordings of deploy/narration; without: the one beside the programs");
  app.add_option("--quality", o.quality,
                 "how good pictures are: auto measures what draws; high, medium, low; cached draws what stands still "
                 "only once, for machines without a graphics card. Offscreen, auto is high")
      ->check(CLI::IsMember({"auto", "high", "medium", "low", "cached"}))
      ->capture_default_str();
  app.add_option("--fps", o.fps, "frames a second, at most")->check(CLI::Range(0.1, 240.0))->capture_default_str();
}

void add_recording_options(CLI::App& app, display::DisplayOptions& o) {
  app.add_option(
      "--record", o.source.record,
      "record all that is shown to this file, to be played without a server; an existing file is overwritten");
  app.add_option("--record-fps", o.source.recorder.fps, "frames per second to record, at most")
      ->check(CLI::Range(1.0, 240.0))
      ->capture_default_str();
  app.add_option_function<std::uint64_t>(
         "--record-mib", [&o](std::uint64_t mib) { o.source.recorder.limit_bytes = mib << 20U; },
         "size in MiB at which the recording ends; without: 256")
      ->check(CLI::Range(1, 1024));
  auto* play = app.add_option("--play", o.source.play, "recording to show in place of a server's world");
  app.add_option("--speed", o.source.player.speed, "speed of a recording; 1: as recorded")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str()
      ->needs(play);
  app.add_option("--play-from", o.source.play_from,
                 "where in the recording to begin: seconds, as in 12.5, or a step and a share of it, as in turn@0.4")
      ->needs(play);
  app.add_flag("--play-again", o.source.player.again, "play the recording again when it is over")->needs(play);
  app.add_option("--film-fps", o.film_fps,
                 "write every picture of a recording to --out, this many per second, however long each takes to draw")
      ->check(CLI::Range(0.1, 240.0))
      ->needs(play);
}

}  // namespace

int main(int argc, char** argv) {
  display::keep_large_blocks_apart();
  display::DisplayOptions options;
  std::string size = "1280x720";
  CLI::App app{"Shows a kiosk's world, in a window or offscreen.", "mechane display"};
  add_options(app, options, size);
  add_stereo_options(app, options);
  add_kiosk_options(app, options);
  add_recording_options(app, options);
  app.final_callback([&] { check_together(options); });
  app.set_config("--settings", "", "file with options of this program, one a line: quality = \"cached\"");
  app.allow_config_extras(CLI::config_extras_mode::error);
  if (const std::optional<int> status = parse_command_line(app, argc, argv)) return *status;
  log::start("mechane-display", log::Level::info);
  const Expected<picture::PixelSize> parsed = display::parse_size(size);
  if (!parsed) {
    log::error(parsed.error());
    return 2;
  }
  options.size = *parsed;
  std::signal(SIGINT, [](int) { g_signals.stop = true; });
  std::signal(SIGTERM, [](int) { g_signals.stop = true; });
  std::signal(SIGUSR1, [](int) { g_signals.picture = true; });
  const Expected<display::DisplaySummary> summary = display::run_display(options, g_signals);
  if (!summary) {
    log::error(summary.error());
    return 1;
  }
  std::puts(summary->to_json().c_str());
  return 0;
}
