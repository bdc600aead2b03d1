// The display program: joins a kiosk as a watcher, draws its world into a window or offscreen, writes pictures.
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
  std::string name = "wall";  ///< of this display, unique at its kiosk
  std::uint32_t domain = 0;
  bool offscreen = false;
  picture::PixelSize size{1280, 720};
  bool full_screen = false;  ///< the window fills the screen from the start
  picture::Stereo stereo = picture::Stereo::mono;
  picture::ScreenSetup screen;
  std::string language = "el";  ///< at the start, and again when a visitor has gone
  /// Folder or address (http, https) to which mesh files are relative; empty: the scenario's folder on the server's
  /// machine.
  std::string assets;
  std::string asset_cache;               ///< folder in which fetched files are kept; empty: default_asset_cache()
  std::uint32_t asset_cache_mib = 4096;  ///< its size limit
  std::string catalogue;                 ///< file of a catalogue in which mesh files are looked up first; empty: none
  std::string out;                       ///< folder for pictures; created if it does not exist
  bool every_step = false;   ///< a picture of each step and each finished activity; offscreen, nothing else is drawn
  std::uint32_t frames = 0;  ///< stop after this number of frames and write the last as a picture; 0: no limit
  double seconds = 0;        ///< stop after this time; 0: no limit
  bool until_done = false;   ///< stop when the world's last activity is done
  double fps = 60;           ///< at most
  std::string quality = "auto";  ///< a name of draw::Quality, or auto: as measured; offscreen, auto is high
  draw::RendererSettings renderer;
  visit::AskWhen ask = visit::AskWhen::after;  ///< an activity's questions
  picture::OverlayStyle overlay;               ///< at the start; keys change it
  std::string hand = "medium";                 ///< how drawn hands look: a name of scene::hand_look_names()
  bool forces = false;                         ///< shows arrows of the forces on hands; at the start, a key changes it
  double home_after_s = 0;                     ///< go home after this time without a motion or click; 0: never
  std::string attract;                         ///< file of a recording that is shown while nobody is there; empty: none
  double attract_after_s = 120;                ///< show it after this time without a motion, touch or click
  bool follow_step = true;                     ///< the view turns and narrows to where hands work
  bool touch = true;                           ///< in a window: mouse, fingers and keys move a hand of the kiosk
  SoundSettings sound;                         ///< for a window; offscreen there is no sound
  SourceOptions source;                        ///< what is played instead of a server's world, and recorded
  double film_fps =
      0;  ///< above 0, with a recording: write every picture, this many per second of the recording, at any speed
};

/// The display's report for scripts.
struct DisplaySummary {
  std::vector<std::string> pictures;      ///< paths
  std::vector<std::string> steps_missed;  ///< steps that were too short for a picture
  std::vector<std::string> missing_assets;
  std::vector<std::string> differing_assets;  ///< files that differ from the server's
  std::uint64_t frames = 0;
  double frame_ms_median = 0;
  double frame_ms_p99 = 0;
  bool done = false;  ///< the world's last activity was done
  std::string renderer;
  std::string sound;  ///< the device, or why nothing is heard

  /// One line of JSON.
  [[nodiscard]] std::string to_json() const;
};

/// Set from outside (a signal handler): stop at the next frame; take a picture of the next frame.
struct DisplaySignals {
  std::atomic<bool> stop{false};
  std::atomic<bool> picture{false};
};

/// Draws until an option or a signal stops it. Runs on the caller's thread. Errors: no context, no fonts, a bad kiosk
/// name, a folder that cannot be written, a catalogue that cannot be read, an invalid address of assets.
[[nodiscard]] Expected<DisplaySummary> run_display(const DisplayOptions& options, DisplaySignals& signals);

/// Reads "1280x720". Errors: not two numbers, or not within 16..8192.
[[nodiscard]] Expected<picture::PixelSize> parse_size(const std::string& text);

}  // namespace mechane::display
