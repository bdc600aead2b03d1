#include "client-sdk/cli/head.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <istream>
#include <ostream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "client-sdk/cli/displays_text.hpp"

namespace mechane::cli {
namespace {

constexpr Duration kTellEvery = std::chrono::milliseconds(16);
constexpr Duration kAudienceEvery = std::chrono::milliseconds(100);
constexpr double kFarthest_m = 20;
/// Longer than seven numbers ever are. Input without line ends does not come from a tracker, and must not fill the
/// memory.
constexpr std::size_t kLongestLine = 500;
constexpr std::size_t kQuoted = 80;

volatile std::sig_atomic_t head_interrupted = 0;

/// Sends the same pose again and again, as a tracker would, for `seconds`.
int hold(client::HeadTracker& tracker, const Pose& X_SV, double seconds, Audience& audience, std::ostream& err) {
  std::signal(SIGINT, [](int) { head_interrupted = 1; });
  std::signal(SIGTERM, [](int) { head_interrupted = 1; });
  SystemClock clock;
  const TimePoint began = clock.now();
  while (head_interrupted == 0 && (seconds <= 0 || to_seconds(clock.now() - began) < seconds)) {
    (void)tracker.tell(X_SV);
    audience.look(clock.now(), err);
    clock.sleep_until(clock.now() + kTellEvery);
  }
  (void)tracker.tell_nobody();
  return 0;
}

/// Reads to the line's end; what exceeds the longest line is dropped.
bool read_line(std::istream& in, std::string& line) {
  using Traits = std::istream::traits_type;
  line.clear();
  int c = in.get();
  if (c == Traits::eof()) return false;
  for (; c != Traits::eof() && c != '\n'; c = in.get()) {
    if (line.size() < kLongestLine) line.push_back(static_cast<char>(c));
  }
  return true;
}

/// The line in quotes, without characters that could drive a terminal.
std::string quoted(const std::string& line) {
  std::string out = line.substr(0, kQuoted);
  std::ranges::replace_if(
      out, [](char c) { return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f; }, '?');
  return "'" + out + "'";
}

}  // namespace

std::string BadLines::hear(std::size_t number, const Error& error, TimePoint now) {
  ++count_;
  if (said_ && now - *said_ < kEvery) {
    ++unsaid_;
    return {};
  }
  said_ = now;
  const std::size_t others = std::exchange(unsaid_, 0);
  return fmt::format("line {}: {}{}", number, error.to_string(),
                     others == 0 ? "" : fmt::format(" ({} more bad lines since the last message)", others));
}

void Audience::look(TimePoint now, std::ostream& err) {
  if (known_ || (looked_ && now - *looked_ < kAudienceEvery)) return;
  looked_ = now;
  const std::vector<client::DisplayStatus> all = watch_.displays();
  known_ = std::ranges::any_of(all, [this](const client::DisplayStatus& d) { return is_meant(d, kiosk_, display_); });
  if (known_ || now - began_ < kTime) return;
  known_ = true;
  err << "mechane head: " << no_display(all, kiosk_, display_).to_string()
      << ". Positions are still sent, for a display that starts later\n"
      << std::flush;
}

int pass_on(client::HeadTracker& tracker, std::istream& in, std::ostream& err, Audience& audience, Clock& clock) {
  BadLines bad;
  std::size_t number = 0;
  for (std::string line; read_line(in, line);) {
    ++number;
    const TimePoint now = clock.now();
    audience.look(now, err);
    const auto head = read_head(line);
    if (!head) {
      const std::string words = bad.hear(number, head.error(), now);
      if (!words.empty()) err << "mechane head: " << words << "\n" << std::flush;
    } else if (*head) {
      (void)tracker.tell(**head);
    } else {
      (void)tracker.tell_nobody();
    }
  }
  (void)tracker.tell_nobody();
  if (bad.count() > 1) err << "mechane head: " << bad.count() << " of " << number << " lines were bad\n";
  // A short input is read before displays have answered: wait for them, so that a mistyped name is reported here too.
  for (; number > 0 && !audience.is_known(); audience.look(clock.now(), err))
    clock.sleep_until(clock.now() + kAudienceEvery);
  return number > 0 && bad.count() == number ? 1 : 0;
}

Expected<std::optional<Pose>> read_head(const std::string& line) {
  constexpr const char* kRemedy = "write 'x y z' in metres, 'x y z qw qx qy qz', or 'nobody'";
  std::istringstream words(line);
  std::array<double, 7> numbers{0, 0, 0, 1, 0, 0, 0};
  std::size_t count = 0;
  if (std::string first; std::istringstream(line) >> first && first == "nobody") return std::optional<Pose>();
  while (count < numbers.size() && words >> numbers[count])
    ++count;
  words.clear();
  if (std::string rest; words >> rest || (count != 3 && count != 7))
    return fail(ErrorCode::invalid_value, "this is not the position of a head: " + quoted(line), "tracker", kRemedy);
  const Pose X_SV{{numbers[0], numbers[1], numbers[2]}, Quat(numbers[3], numbers[4], numbers[5], numbers[6])};
  if (!X_SV.p.allFinite())
    return fail(ErrorCode::invalid_value, "a number is not finite: " + quoted(line), "tracker", kRemedy);
  if (!(std::abs(X_SV.R.norm() - 1) <= 0.01)) {
    return fail(ErrorCode::invalid_value,
                fmt::format("the rotation is not a unit quaternion (norm {:.3g}): {}", X_SV.R.norm(), quoted(line)),
                "tracker", kRemedy);
  }
  if (!(X_SV.p.z() > 0) || X_SV.p.norm() > kFarthest_m) {
    return fail(ErrorCode::invalid_value,
                fmt::format("the head is not in front of the screen and within {} m of its middle: {}", kFarthest_m,
                            quoted(line)),
                "tracker",
                "write metres from the screen's middle: right, up, towards the visitor; the third number is above 0");
  }
  return std::optional<Pose>(X_SV);
}

int run_head(const HeadOptions& options, std::istream& in, std::ostream& err) {
  const auto tell = [&err](const Error& error, int status) {
    err << "mechane head: " << error.to_string() << "\n";
    return status;
  };
  std::optional<Pose> held;
  if (!options.at.empty()) {
    const auto read = read_head(fmt::format("{}", fmt::join(options.at, " ")));
    if (!read) {
      Error error = read.error();
      error.where = "--at";
      return tell(error, 2);
    }
    held = *read;
  }
  auto tracker = client::HeadTracker::open(options.kiosk, options.display, options.domain);
  if (!tracker) return tell(tracker.error(), 1);
  auto watch = client::DisplayWatch::open(options.domain);
  if (!watch) return tell(watch.error(), 1);
  SystemClock clock;
  Audience audience(options, **watch, clock.now());
  return held ? hold(**tracker, *held, options.seconds, audience, err) : pass_on(**tracker, in, err, audience, clock);
}

}  // namespace mechane::cli
