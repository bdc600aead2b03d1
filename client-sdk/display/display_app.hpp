// The display as a program: joins a kiosk as a watcher, draws its world into a window or offscreen, writes pictures.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client-sdk/display/display_sound.hpp"
#include "client-sdk/display/display_source.hpp"
#include "client-sdk/display/picture_schedule.hpp"
#include "client-sdk/draw/gl_context.hpp"
#include "client-sdk/draw/renderer.hpp"
#include "client-sdk/scene/scene_builder.hpp"
#include "client-sdk/visit/visitor_panel.hpp"
#include <mechane/client/client.hpp>

namespace mechane::display {

struct DisplayOptions {
  std::string kiosk = "kiosk-1";
  std::string name = "wall";  ///< of this display among the kiosk's
  std::uint32_t domain = 0;
  bool offscreen = false;
  picture::PixelSize size{1280, 720};
  bool full_screen = false;  ///< a window: fills the screen from the start
  picture::Stereo stereo = picture::Stereo::mono;
  picture::ScreenSetup screen;  ///< that visitors stand before
  std::string language = "el";  ///< that it starts in, and comes back to when a visitor has gone
  std::string
      assets;  ///< folder, or address (http, https), that mesh files are relative to; empty: the scenario's folder, as the
               ///< server sees it
  std::string asset_cache;               ///< folder in which fetched files are kept; empty: default_asset_cache()
  std::uint32_t asset_cache_mib = 4096;  ///< the most that is kept
  std::string catalogue;                 ///< file; mesh files are found in it first, by their content; empty: none
  std::string out;                       ///< folder for pictures; made when it is not there
  bool every_step = false;   ///< a picture of each step and each finished activity; offscreen, nothing else is drawn
  std::uint32_t frames = 0;  ///< stop after so many frames, the last of them a picture; 0: no limit
  double seconds = 0;        ///< stop after so long; 0: no limit
  bool until_done = false;   ///< stop when the world's last activity is done
  double fps = 60;           ///< at most
  draw::RendererSettings renderer;
  visit::AskWhen ask = visit::AskWhen::after;  ///< an activity's questions
  picture::OverlayStyle overlay;               ///< at the start; keys change it
  bool forces = false;           ///< hands have arrows of the force that they feel; at the start, a key changes it
  double home_after_s = 0;       ///< without anybody's motion or click: back to the server's first scenario; 0: never
  std::string attract;           ///< file of a recording that is shown while nobody is there; empty: none
  double attract_after_s = 120;  ///< without anybody's motion, touch or click
  bool touch = true;             ///< in a window: mouse, finger and keys are a hand of the kiosk
  SoundSettings sound;           ///< in a window; offscreen nothing is heard
  SourceOptions source;          ///< played instead of a server's, and recorded
  double film_fps =
      0;  ///< over 0, with a recording: every picture, so many a second of it, as fast or slowly as they can be drawn
};

/// What was done, for scripts.
struct DisplaySummary {
  std::vector<std::string> pictures;      ///< paths
  std::vector<std::string> steps_missed;  ///< too short for a picture
  std::vector<std::string> missing_assets;
  std::vector<std::string> differing_assets;  ///< other bytes than the server's
  std::uint64_t frames = 0;
  double frame_ms_median = 0;
  double frame_ms_p99 = 0;
  bool done = false;  ///< the world's last activity was done
  std::string renderer;
  std::string sound;  ///< the device; else why nothing is heard

  /// One line of JSON.
  [[nodiscard]] std::string to_json() const;
};

/// Set from outside (a signal handler): stop at the next frame; take a picture of the next frame.
struct DisplaySignals {
  std::atomic<bool> stop{false};
  std::atomic<bool> picture{false};
};

/// Draws until an option or a request says stop. The caller's thread is the display's. Errors: no context, no fonts, a bad kiosk name,
/// a folder that cannot be written, a catalogue that cannot be read, an address of assets that cannot be read.
[[nodiscard]] Expected<DisplaySummary> run_display(const DisplayOptions& options, DisplaySignals& signals);

/// Reads "1280x720". Errors: not two numbers, or not within 16..8192.
[[nodiscard]] Expected<picture::PixelSize> parse_size(const std::string& text);

}  // namespace mechane::display
