#include "client-sdk/gateway/kiosk_keeper.hpp"

#include <algorithm>
#include <ctime>

#include <fmt/format.h>

#include "client-sdk/gateway/operations/wake_on_lan.hpp"
#include "client-sdk/gateway/operator_api.hpp"
#include "server/log/log.hpp"

namespace mechane::gateway {
namespace {

constexpr Duration kKeepEvery = std::chrono::milliseconds(500);
/// A display tells of its settings once a second; a request that was lost is sent again.
constexpr Duration kAskAgain = std::chrono::seconds(4);
constexpr Duration kWakeAgain = std::chrono::seconds(5);
constexpr int kWakes = 3;
constexpr int kTries = 15;

const std::string* setting_in(const client::DisplayStatus& display, std::string_view name) {
  const auto found = std::ranges::find(display.settings, name, &client::DisplaySetting::name);
  return found == display.settings.end() ? nullptr : &found->value;
}

void ask(GatewaySite& site, const client::DisplayStatus& display, const std::vector<client::DisplaySetting>& settings) {
  const auto sent = site.watch().request(display.kiosk, display.display, {.settings = settings});
  if (!sent) log::error(sent.error());
}

Site::Done told_if_refused(const std::string& what) {
  return [what](const HttpAnswer& answer) {
    if (answer.status != 200) log::warning(what + ": " + *answer.body);
  };
}

}  // namespace

std::int64_t wall_now() {
  return std::time(nullptr);
}

void KioskKeeper::tick(GatewaySite& site, std::int64_t now, TimePoint at) {
  if (at < next_look_) return;
  next_look_ = at + kKeepEvery;
  Operations& operations = site.operations();
  if (auto tidied = operations.change(without_ended(operations.state(), now)); !tidied) log::error(tidied.error());
  for (const std::string& kiosk : site.kiosks()) {
    const KioskTarget target = target_of(operations.state(), kiosk, now);
    lead_home(site, kiosk, target);
    keep_displays(site, kiosk, target, at);
  }
  wake_kiosks(site, now, at);
  take_back(site, now, at);
  std::erase_if(asked_, [at](const auto& one) { return one.second.again < at; });
}

/// A visit ends politely where its kiosk gets a sign: the kiosk goes home.
void KioskKeeper::lead_home(GatewaySite& site, const std::string& kiosk, const KioskTarget& target) {
  Kept& kept = kept_[kiosk];
  if (std::exchange(kept.sign, target.sign) == target.sign) return;
  site.note_own("sign", kiosk + ": " + target.sign);
  if (target.sign == "none") return;
  // Nobody visits a dark kiosk. A browser that has just come is not among the displays yet.
  const auto hub = site.hubs().find(kiosk);
  const bool shown = (hub != site.hubs().end() && hub->second->browsers() > 0) ||
                     std::ranges::count(site.watch().displays(), kiosk, &client::DisplayStatus::kiosk) > 0;
  if (shown) open_at_kiosk(site, kiosk, "", told_if_refused(kiosk + " did not go home"));
}

void KioskKeeper::keep_displays(GatewaySite& site, const std::string& kiosk, const KioskTarget& target, TimePoint at) {
  const std::vector<client::DisplaySetting> wanted{
      {"sign", target.sign}, {"message-el", target.message_el}, {"message-en", target.message_en}};
  for (const client::DisplayStatus& display : site.watch().displays()) {
    if (display.kiosk != kiosk) continue;
    std::vector<client::DisplaySetting> different;
    for (const client::DisplaySetting& setting : wanted)
      if (const std::string* has = setting_in(display, setting.name); has != nullptr && *has != setting.value)
        different.push_back(setting);
    // What was asked otherwise since is asked at once.
    const auto asked = asked_.find(display.session);
    if (different.empty() || (asked != asked_.end() && asked->second.settings == different)) continue;
    ask(site, display, different);
    asked_.insert_or_assign(display.session, Asked{at + kAskAgain, std::move(different)});
  }
}

void KioskKeeper::wake_kiosks(GatewaySite& site, std::int64_t now, TimePoint at) {
  const OperationsState& state = site.operations().state();
  for (const auto& [kiosk, mac] : state.hours.wake) {
    Kept& kept = kept_[kiosk];
    const bool open = target_of(state, kiosk, now).open;
    if (open != std::exchange(kept.open, open)) kept.wakes_left = open ? kWakes : 0;
    if (kept.wakes_left == 0 || at < kept.next_wake) continue;
    --kept.wakes_left;
    kept.next_wake = at + kWakeAgain;
    const auto address = parse_mac(mac);
    if (!address) continue;
    if (auto sent = wake(*address, site.options().wake_to); !sent) log::error(sent.error());
    site.note_own("wake", fmt::format("{}: {}", kiosk, mac));
  }
}

void KioskKeeper::take_back(GatewaySite& site, std::int64_t now, TimePoint at) {
  OperationsState next = site.operations().state();
  std::erase_if(next.changes, [&](const TimedChange& change) {
    if (change.until > now) return false;
    Tries& tries = tries_[change.id];
    if (at < tries.next) return false;
    tries.next = at + kAskAgain;
    if (tries.count == 0) site.note_own("ended", fmt::format("{}: {}={}", change.kiosk, change.name, change.value));
    const bool done = is_back(site, change) || ++tries.count >= kTries;
    if (done) tries_.erase(change.id);
    return done;
  });
  if (auto written = site.operations().change(std::move(next)); !written) log::error(written.error());
}

bool KioskKeeper::is_back(GatewaySite& site, const TimedChange& change) {
  if (change.name == "exhibit") {
    const auto before = change.before.find("");
    if (before != change.before.end())
      open_at_kiosk(site, change.kiosk, before->second, told_if_refused(change.kiosk + " did not go back"));
    return true;  // with words in the log where it did not work
  }
  bool all = true;
  for (const client::DisplayStatus& display : site.watch().displays()) {
    const auto before = change.before.find(display.display);
    if (display.kiosk != change.kiosk || before == change.before.end()) continue;
    const std::string* has = setting_in(display, change.name);
    if (has == nullptr || *has != change.value) continue;  // somebody has changed it since, or it has returned
    all = false;
    ask(site, display, {{change.name, before->second}});
  }
  return all;
}

}  // namespace mechane::gateway
