// `mechane head`: sends the position of the visitor's head to a kiosk's displays. A bridge for any tracker program that
// can print lines.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include <mechane/client/displays.hpp>
#include <mechane/client/head.hpp>

namespace mechane::cli {

struct HeadOptions {
  std::string kiosk = "kiosk-1";
  std::string display;  ///< empty: all displays of the kiosk
  std::uint32_t domain = 0;
  std::vector<double> at;  ///< metres, in S; empty: lines are read
  double seconds = 0;      ///< 0: no end
};

/// Reads a tracker's line: "x y z", "x y z qw qx qy qz" (metres and a unit quaternion in S), or "nobody", which gives
/// no pose. Errors: other words, a rotation that is not a unit quaternion, a position behind the screen or over 20 m
/// from its middle.
[[nodiscard]] Expected<std::optional<Pose>> read_head(const std::string& line);

/// Messages about bad lines of a tracker: the first at once, then only one from time to time, as a tracker sends up to
/// 250 lines a second.
class BadLines {
 public:
  static constexpr Duration kEvery = std::chrono::seconds(10);

  /// The message for a bad line; `number` counts from 1. Empty if there was a message a short time ago.
  [[nodiscard]] std::string hear(std::size_t number, const Error& error, TimePoint now);
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0;
  std::size_t unsaid_ = 0;
  std::optional<TimePoint> said_;
};

/// Reports once that no display receives the positions, after displays have had time to answer. Any one thread.
class Audience {
 public:
  /// Displays report once a second, and must find this program first.
  static constexpr Duration kTime = std::chrono::seconds(3);

  /// `began`: since when displays can be heard.
  Audience(const HeadOptions& options, client::DisplayWatch& watch, TimePoint began)
      : kiosk_(options.kiosk), display_(options.display), watch_(watch), began_(began) {}

  /// Checks for displays; call it at any rate.
  void look(TimePoint now, std::ostream& err);
  /// Whether a display was found, or its absence was reported.
  [[nodiscard]] bool is_known() const { return known_; }

 private:
  std::string kiosk_;
  std::string display_;
  client::DisplayWatch& watch_;
  TimePoint began_;
  std::optional<TimePoint> looked_;
  bool known_ = false;
};

/// Sends on a tracker's lines until the input ends; bad lines are reported on `err` and skipped. Returns 1 if there
/// were lines, but no good one, else 0.
[[nodiscard]] int pass_on(client::HeadTracker& tracker, std::istream& in, std::ostream& err, Audience& audience,
                          Clock& clock);

/// Runs until the input ends, or Ctrl-C. Returns the exit status: 2 for a bad pose, 1 if a name is bad or the network
/// cannot be joined, else that of pass_on(). If there is no display of that name, this is reported once, and it
/// continues, for a display that starts later.
[[nodiscard]] int run_head(const HeadOptions& options, std::istream& in, std::ostream& err);

}  // namespace mechane::cli
