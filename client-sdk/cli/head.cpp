#include "client-sdk/cli/head.hpp"

#include <array>
#include <csignal>
#include <istream>
#include <ostream>
#include <sstream>

#include <fmt/format.h>

#include "server/base/clock.hpp"
#include <mechane/client/head.hpp>

namespace mechane::cli {
namespace {

constexpr Duration kTellEvery = std::chrono::milliseconds(16);
constexpr std::size_t kLinesTold = 5;

volatile std::sig_atomic_t head_interrupted = 0;

/// The same place again and again, as a tracker would, until it is enough.
int hold(client::HeadTracker& tracker, const Pose& X_SV, double seconds) {
  std::signal(SIGINT, [](int) { head_interrupted = 1; });
  std::signal(SIGTERM, [](int) { head_interrupted = 1; });
  SystemClock clock;
  const TimePoint began = clock.now();
  while (head_interrupted == 0 && (seconds <= 0 || to_seconds(clock.now() - began) < seconds)) {
    (void)tracker.tell(X_SV);
    clock.sleep_until(clock.now() + kTellEvery);
  }
  (void)tracker.tell_nobody();
  return 0;
}

int pass_on(client::HeadTracker& tracker, std::istream& in, std::ostream& err) {
  std::size_t wrong = 0;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const auto head = read_head(line);
    if (!head) {
      if (++wrong <= kLinesTold) err << "mechane head: line " << number << ": " << head.error().to_string() << "\n";
    } else if (*head) {
      (void)tracker.tell(**head);
    } else {
      (void)tracker.tell_nobody();
    }
  }
  (void)tracker.tell_nobody();
  if (wrong > kLinesTold) err << "mechane head: " << wrong << " of " << number << " lines were wrong\n";
  return wrong == 0 ? 0 : 1;
}

}  // namespace

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
    return fail("no place of a head: '" + line.substr(0, 80) + "'", "tracker", kRemedy);
  const Pose X_SV{{numbers[0], numbers[1], numbers[2]}, Quat(numbers[3], numbers[4], numbers[5], numbers[6])};
  if (!X_SV.p.allFinite() || std::abs(X_SV.R.norm() - 1) > 0.01)
    return fail("no rotation, or a number that is none: '" + line.substr(0, 80) + "'", "tracker", kRemedy);
  return std::optional<Pose>(X_SV);
}

int run_head(const HeadOptions& options, std::istream& in, std::ostream& err) {
  std::optional<Pose> held;
  if (!options.at.empty()) {
    const auto read = read_head(fmt::format("{}", fmt::join(options.at, " ")));
    if (!read) return err << "mechane head: " << read.error().to_string() << "\n", 2;
    held = *read;
  }
  auto tracker = client::HeadTracker::open(options.kiosk, options.display, options.domain);
  if (!tracker) return err << "mechane head: " << tracker.error().to_string() << "\n", 1;
  return held ? hold(**tracker, *held, options.seconds) : pass_on(**tracker, in, err);
}

}  // namespace mechane::cli
