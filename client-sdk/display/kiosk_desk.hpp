// A display's link to technicians: sends its status once a second, receives requests for settings and pictures. On the
// display's thread; time is an argument.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "client-sdk/draw/gl_context.hpp"
#include "client-sdk/picture/overlay_controls.hpp"
#include "client-sdk/sound/sound_player.hpp"
#include "server/base/clock.hpp"
#include <mechane/client/client.hpp>

namespace mechane::display {

/// The value below which `share` (0..1) of them lie; 0 of none.
[[nodiscard]] double percentile(std::vector<double> values, double share);

/// Pictures per second and time per picture, over the last seconds.
class PictureMeter {
 public:
  static constexpr Duration kWindow = std::chrono::seconds(5);
  struct Rate {
    double per_s = 0;
    double median_ms = 0;
    double p99_ms = 0;
  };
  explicit PictureMeter(TimePoint began) : began_(began) {}
  void drawn(Duration took, TimePoint now);
  [[nodiscard]] Rate rate(TimePoint now) const;
  [[nodiscard]] std::uint64_t total() const { return total_; }

 private:
  struct Picture {
    TimePoint at;
    double ms = 0;
  };
  TimePoint began_;
  std::uint64_t total_ = 0;
  std::deque<Picture> pictures_;
};

/// Frames that were received and lost in the last seconds, from rising counts.
class TrafficMeter {
 public:
  static constexpr Duration kWindow = std::chrono::seconds(10);
  struct Rate {
    double per_s = 0;
    double lost = 0;  ///< share, 0 .. 1
  };
  [[nodiscard]] Rate rate(const client::FrameTraffic& now_counted, TimePoint now);

 private:
  struct Count {
    TimePoint at;
    client::FrameTraffic traffic;
  };
  std::deque<Count> counts_;
};

/// The constant properties of a display.
struct DisplayIdentity {
  std::string kiosk;
  std::string name;
  std::string renderer;
  bool offscreen = false;
  double wanted_per_s = 60;
  bool has_folder = false;   ///< has a folder for pictures
  bool has_attract = false;  ///< has a recorded visit to show
};

/// What the display's loop knows at the time of a report.
struct DisplayFacts {
  picture::PixelSize size;
  const client::WorldStatus* world = nullptr;      ///< null: none is known
  const std::set<std::string>* missing = nullptr;  ///< null: nothing was loaded yet
  std::optional<sound::SoundState> sound;          ///< none: the display has no sound
  bool attracts = false;                           ///< a recorded visit is shown
};

class KioskDesk {
 public:
  static constexpr Duration kReportEvery = std::chrono::seconds(1);
  static constexpr std::size_t kAnswers = 8;
  static constexpr std::size_t kMissingNamed = 8;

  /// The client must outlive the desk.
  KioskDesk(client::Client& client, DisplayIdentity identity, client::DisplaySettings settings, TimePoint now);

  /// Answers requests. True if settings changed. `style`: as visitors have set it with keys.
  [[nodiscard]] bool take_requests(const picture::OverlayStyle& style);
  [[nodiscard]] const client::DisplaySettings& settings() const { return settings_; }
  /// How often a gateway has told the code for phones, which it does again and again.
  [[nodiscard]] std::uint64_t codes_told() const { return codes_told_; }
  /// Whether somebody requested a picture.
  [[nodiscard]] bool picture_wanted() const { return !picture_for_.empty(); }
  /// Takes the ids of these requests. One picture is taken for all of them; their answer is its file, or why there is
  /// none.
  [[nodiscard]] std::vector<std::uint64_t> take_picture_requests() { return std::exchange(picture_for_, {}); }
  /// Whether a technician has asked that the display be started again, and the answer was sent.
  [[nodiscard]] bool restart_wanted() const { return restart_ == Restart::answered; }
  void picture_taken(const std::vector<std::uint64_t>& requests, const std::string& file);
  void picture_failed(const std::vector<std::uint64_t>& requests, const Error& error);

  void drawn(Duration took, TimePoint now) { meter_.drawn(took, now); }
  [[nodiscard]] bool report_due(TimePoint now) const { return now >= next_report_; }
  void report(const DisplayFacts& facts, TimePoint now);

 private:
  enum class Restart : std::uint8_t { none, asked, answered };
  void answer(const client::DisplayRequest& request);
  void say(client::RequestAnswer answer);

  client::Client& client_;
  DisplayIdentity identity_;
  client::DisplaySettings settings_;
  PictureMeter meter_;
  TrafficMeter traffic_;
  TimePoint began_;
  TimePoint next_report_;
  std::string host_;
  std::vector<std::uint64_t> picture_for_;  ///< ids of requests that still wait for a picture
  std::deque<client::RequestAnswer> answers_;
  Restart restart_ = Restart::none;
  std::uint64_t codes_told_ = 0;
};

}  // namespace mechane::display
