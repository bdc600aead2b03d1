// `mechane head`: tells a kiosk's displays where the visitor's head is. A bridge for any tracker whose program can print lines.
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
  std::string display;  ///< empty: all of the kiosk
  std::uint32_t domain = 0;
  std::vector<double> at;  ///< metres, in S; empty: lines are read
  double seconds = 0;      ///< 0: no end
};

/// A line of a tracker: "x y z", "x y z qw qx qy qz" (metres and a unit quaternion in S), or "nobody", which gives no pose.
/// Errors: other words, words that are not numbers, a rotation that is not a unit quaternion, a place behind the
/// screen or over 20 m from its middle.
[[nodiscard]] Expected<std::optional<Pose>> read_head(const std::string& line);

/// What is said of a tracker's lines that are bad: of the first at once, then of one in a while, for a tracker sends up to 250 a second.
class BadLines {
 public:
  static constexpr Duration kEvery = std::chrono::seconds(10);

  /// `number` counts from 1. Empty: something was said a short while ago.
  [[nodiscard]] std::string hear(std::size_t number, const Error& error, TimePoint now);
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0;
  std::size_t unsaid_ = 0;
  std::optional<TimePoint> said_;
};

/// Says once that no display hears, when displays have had time to tell of themselves. Any one thread.
class Audience {
 public:
  /// Displays report once a second, and must find this program first.
  static constexpr Duration kTime = std::chrono::seconds(3);

  /// `began`: since when displays can be heard.
  Audience(const HeadOptions& options, client::DisplayWatch& watch, TimePoint began)
      : kiosk_(options.kiosk), display_(options.display), watch_(watch), began_(began) {}

  /// As often as you like.
  void look(TimePoint now, std::ostream& err);
  /// One was seen, or it was said that there is none.
  [[nodiscard]] bool is_known() const { return known_; }

 private:
  std::string kiosk_;
  std::string display_;
  client::DisplayWatch& watch_;
  TimePoint began_;
  std::optional<TimePoint> looked_;
  bool known_ = false;
};

/// Passes a tracker's lines on, until the input ends; a bad line is told on `err`, and the next is read. Returns 1 where there were lines, and
/// not a good one among them, else 0.
[[nodiscard]] int pass_on(client::HeadTracker& tracker, std::istream& in, std::ostream& err, Audience& audience,
                          Clock& clock);

/// Returns the exit status: 2 where a pose is bad, 1 where a name is bad or the network cannot be joined, else that of pass_on(). Until the input
/// ends, or Ctrl-C. Where no display of that name is there, it is told once, and goes on: one may come.
[[nodiscard]] int run_head(const HeadOptions& options, std::istream& in, std::ostream& err);

}  // namespace mechane::cli
