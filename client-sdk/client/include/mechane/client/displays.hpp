// Displays as a technician sees them: the status of each, and what can be changed while it runs.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"
#include <mechane/client/devices.hpp>
#include <mechane/client/types.hpp>

namespace mechane::client {

/// One setting by name, as a person writes it: volume=0.5. display_settings() lists all settings.
struct DisplaySetting {
  std::string name;
  std::string value;
  friend bool operator==(const DisplaySetting&, const DisplaySetting&) = default;
};

/// What a museum changes of a display while it runs.
struct DisplaySettings {
  static constexpr std::size_t kMostMessage = 240;  ///< bytes of UTF-8: about 120 letters of Greek
  double volume = 0.8;                              ///< volume: 0 .. 1
  bool muted = false;                               ///< mute: on, off
  std::string language = "el";  ///< language: el, en; at the start, and again when a visitor has gone
  bool large_text = false;      ///< large-text: on, off
  bool high_contrast = false;   ///< high-contrast: on, off
  std::string ask = "after";    ///< ask: none, after, both; when visitors are asked an activity's questions
  double home_after_s = 0;      ///< home-after: 0 .. 86400 s without a visitor; 0: never
  bool attract = true;          ///< attract: on, off; shows the recorded visit, if one was given, while nobody is there
  double attract_after_s = 120;  ///< attract-after: 5 .. 86400 s without a visitor
  std::string quality = "auto";  ///< quality: auto, high, medium, low, cached
  std::string hand = "medium";   ///< hand: light, medium, dark, glove; how drawn hands look
  /// sign: none, closed, maintenance; where there is one, it is all that visitors are told: no sound is heard, and the
  /// display takes no hand.
  std::string sign = "none";
  std::string message_el{};  ///< message-el, message-en: the museum's words to visitors, kMostMessage bytes at most
  std::string message_en{};
  std::string phone_address{};  ///< phone-address: of the gateway for phones, http(s)://HOST(:PORT); empty: none
  std::string phone_code{};     ///< phone-code: the token in it, letters, digits, - and _; empty: none. A secret
  /// A display with a sign is silent.
  [[nodiscard]] bool silent() const { return muted || sign != "none"; }
  friend bool operator==(const DisplaySettings&, const DisplaySettings&) = default;
};

/// A setting's name, and its values in words.
struct DisplaySettingInfo {
  std::string_view name;
  std::string_view values;
};
[[nodiscard]] const std::vector<DisplaySettingInfo>& display_settings();

/// Changes one setting. Errors, with nothing changed: no such setting, no such value, out of its range.
[[nodiscard]] Expected<void> apply(const DisplaySetting& setting, DisplaySettings& settings);
/// Changes all settings, or none of them. Errors: that of the first wrong setting.
[[nodiscard]] Expected<void> apply(const std::vector<DisplaySetting>& requested, DisplaySettings& settings);
/// The current values, in the order of display_settings().
[[nodiscard]] std::vector<DisplaySetting> settings_of(const DisplaySettings& settings);
/// Reads "volume=0.5". Errors: no '='.
[[nodiscard]] Expected<DisplaySetting> read_setting(const std::string& text);

/// A technician's request to a display.
struct DisplayRequest {
  std::uint64_t id = 0;                    ///< filled in by DisplayWatch::request()
  std::vector<DisplaySetting> settings{};  ///< as received, not checked
  bool picture = false;                    ///< write one into the display's folder
  bool restart = false;                    ///< end, so that its service starts it again
};

/// The answer to a request.
struct RequestAnswer {
  std::uint64_t id = 0;
  std::string refusal;  ///< empty: done
  std::string picture;  ///< if the request was for a picture: its file on the display's machine
};

/// The status of one display.
struct DisplayStatus {
  std::string kiosk;
  std::string display;  ///< its name at the kiosk
  std::uint64_t session = 0;
  std::string version;
  std::string host;
  std::uint32_t process_id = 0;
  std::uint64_t uptime_s = 0;
  std::uint32_t width = 0;  ///< of the picture, pixels; 0: a window that is minimised
  std::uint32_t height = 0;
  bool offscreen = false;
  std::uint64_t pictures = 0;  ///< drawn since its start
  double pictures_per_s = 0;   ///< in the last seconds; the next two likewise
  double picture_ms_median = 0;
  double picture_ms_p99 = 0;
  double wanted_per_s = 60;  ///< pictures a second at most
  std::uint32_t link = 0;    ///< LinkState's number
  std::string refusal;       ///< why the server refuses
  std::string world;
  std::string scenario;
  double frames_per_s = 0;  ///< SceneFrames received, in the last seconds
  double frames_lost = 0;   ///< share of those that were sent, 0 .. 1
  std::uint32_t missing_total = 0;
  std::vector<std::string> missing;  ///< the first eight files that it could not load
  std::string renderer;              ///< what draws, in the driver's words
  std::string sound;                 ///< device; empty: nothing is heard
  std::string sound_problem;         ///< why nothing is heard
  std::string showing;               ///< "world", "attract"
  std::uint64_t warnings = 0;        ///< in its log, since its start
  std::string last_warning;
  std::vector<DisplaySetting> settings;  ///< as they are now
  std::vector<RequestAnswer> answers;    ///< to the last requests, newest last
};

/// A display that has no Client of its own, such as a browser behind a gateway: reports its status and takes requests. One
/// thread at a time.
class DisplaySeat {
 public:
  virtual ~DisplaySeat() = default;
  /// As Client::report().
  virtual bool report(const DisplayStatus& status) = 0;
  /// As Client::take_display_requests().
  [[nodiscard]] virtual std::vector<DisplayRequest> take_requests() = 0;
};

/// Makes such displays, which share one link to the network.
class DisplaySeats {
 public:
  /// Errors: a domain over 230, a configuration of the network that cannot be used.
  [[nodiscard]] static Expected<std::unique_ptr<DisplaySeats>> open(std::uint32_t domain);
  virtual ~DisplaySeats() = default;
  /// The seat must not outlive its maker. Any thread, one at a time. Errors: a bad name; the network refuses it.
  [[nodiscard]] virtual Expected<std::unique_ptr<DisplaySeat>> add(const std::string& kiosk,
                                                                   const std::string& display) = 0;
};

/// SceneFrames of this client since it was made.
struct FrameTraffic {
  std::uint64_t received = 0;
  std::uint64_t lost = 0;  ///< sent, but never received
};

/// A haptic device somewhere in the museum.
struct KioskDevice {
  std::string kiosk;
  DeviceReport report;
  std::optional<DeviceDetails> details;  ///< once its program has opened it
};

/// All displays and haptic devices of a museum, for a technician's tool. Any thread, one at a time.
class DisplayWatch {
 public:
  static constexpr std::size_t kMostDisplays = 1000;  ///< further ones are not listed until one of these ends

  /// Errors: a domain over 230, a configuration of the network that cannot be used.
  [[nodiscard]] static Expected<std::unique_ptr<DisplayWatch>> open(std::uint32_t domain);
  virtual ~DisplayWatch() = default;

  /// Waits until something changes, at most `timeout`.
  virtual void wait(Duration timeout) = 0;
  /// The running displays, sorted by kiosk, name and session. One that ended or lost the network disappears soon, one
  /// that hangs after 15 s.
  [[nodiscard]] virtual std::vector<DisplayStatus> displays() = 0;
  /// What the programs of hands tell of their devices, by kiosk and user; those that have none say nothing.
  [[nodiscard]] virtual std::vector<KioskDevice> devices() = 0;
  /// Sends a request to a kiosk's displays; `display` empty: to all of them. Returns the id with which they answer in
  /// their status; 0 where the request could not be sent. Errors: a bad name, a setting that does not exist or is out
  /// of its range.
  [[nodiscard]] virtual Expected<std::uint64_t> request(const std::string& kiosk, const std::string& display,
                                                        const DisplayRequest& request) = 0;
};

}  // namespace mechane::client
