#include "client-sdk/cli/displays.hpp"

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>

#include "client-sdk/cli/displays_text.hpp"
#include "server/base/clock.hpp"
#include <mechane/client/displays.hpp>

namespace mechane::cli {
namespace {

using client::DisplayStatus;

constexpr Duration kLook = std::chrono::milliseconds(50);
/// Each display reports once a second, so when no new one was found for longer, all are known.
constexpr Duration kStill = std::chrono::milliseconds(1500);
/// Drawing on the processor can be slow.
constexpr double kPictureSeconds = 20;

int tell(const Error& error, int status) {
  std::cerr << "mechane displays: " << error.to_string() << "\n";
  return status;
}

Duration duration_of(double s) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(s));
}

/// All running displays; returns when no new one is found any more.
std::vector<DisplayStatus> find_all(client::DisplayWatch& watch, const DisplaysOptions& options) {
  SystemClock clock;
  const TimePoint until = clock.now() + duration_of(options.seconds);
  TimePoint changed = clock.now();
  std::vector<DisplayStatus> found;
  while (clock.now() < until && (found.empty() || clock.now() - changed < kStill)) {
    watch.wait(kLook);
    std::vector<DisplayStatus> now = watch.displays();
    if (now.size() != found.size()) changed = clock.now();
    found = std::move(now);
  }
  return found;
}

Expected<std::vector<DisplayStatus>> find(client::DisplayWatch& watch, const DisplaysOptions& options) {
  const std::vector<DisplayStatus> all = find_all(watch, options);
  std::vector<DisplayStatus> found;
  std::ranges::copy_if(all, std::back_inserter(found),
                       [&](const DisplayStatus& d) { return is_meant(d, options.kiosk, options.display); });
  if (found.empty()) return tl::unexpected(no_display(all, options.kiosk, options.display));
  return found;
}

/// The answers so far, by session.
std::map<std::uint64_t, client::RequestAnswer> answers_to(std::uint64_t id, client::DisplayWatch& watch) {
  std::map<std::uint64_t, client::RequestAnswer> answers;
  for (const DisplayStatus& display : watch.displays()) {
    const auto found = std::ranges::find(display.answers, id, &client::RequestAnswer::id);
    if (found != display.answers.end()) answers[display.session] = *found;
  }
  return answers;
}

/// Sends the request and prints each display's answer.
int request(client::DisplayWatch& watch, const DisplaysOptions& options, const client::DisplayRequest& wanted) {
  const auto displays = find(watch, options);
  if (!displays) return tell(displays.error(), 1);
  const auto id = watch.request(options.kiosk, options.display, wanted);
  if (!id) return tell(id.error(), 2);
  SystemClock clock;
  const TimePoint until =
      clock.now() + duration_of(wanted.picture ? std::max(options.seconds, kPictureSeconds) : options.seconds);
  std::map<std::uint64_t, client::RequestAnswer> answers;
  while (answers.size() < displays->size() && clock.now() < until) {
    watch.wait(kLook);
    answers = answers_to(*id, watch);
  }
  int status = 0;
  for (const DisplayStatus& display : *displays) {
    const auto answer = answers.find(display.session);
    const bool refused = answer == answers.end() || !answer->second.refusal.empty();
    if (refused) status = 1;
    const std::string word = answer == answers.end()           ? "no answer"
                             : !answer->second.refusal.empty() ? "refused: " + answer->second.refusal
                             : wanted.picture                  ? display.host + ":" + answer->second.picture
                                                               : "done";
    (refused ? std::cerr : std::cout) << display.kiosk << "/" << display.display << ": " << word << "\n";
  }
  return status;
}

}  // namespace

int run_displays(const std::string& verb, const DisplaysOptions& options) {
  client::DisplayRequest wanted;
  wanted.picture = verb == "picture";
  wanted.restart = verb == "restart";
  client::DisplaySettings tried;
  for (const std::string& text : options.settings) {
    const auto setting = client::read_setting(text);
    if (!setting) return tell(setting.error(), 2);
    if (auto ok = client::apply(*setting, tried); !ok) return tell(ok.error(), 2);
    wanted.settings.push_back(*setting);
  }
  if (!verb.empty() && options.kiosk.empty())
    return tell(Error{ErrorCode::missing, "no kiosk was named", "--kiosk",
                      "write --kiosk kiosk-1; 'mechane displays' lists the kiosks"},
                2);
  auto watch = client::DisplayWatch::open(options.domain);
  if (!watch) return tell(watch.error(), 1);
  if (!verb.empty()) return request(**watch, options, wanted);
  const auto displays = find(**watch, options);
  if (!displays) return tell(displays.error(), 1);
  std::cout << (options.json ? displays_json(*displays) : displays_table(*displays));
  return 0;
}

}  // namespace mechane::cli
