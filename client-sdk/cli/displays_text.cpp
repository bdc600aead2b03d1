#include "client-sdk/cli/displays_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client-sdk/cli/columns.hpp"
#include <mechane/client/client.hpp>

namespace mechane::cli {
namespace {

using client::DisplayStatus;

constexpr double kLossWorthTelling = 0.005;
/// Below this share of the requested rate pictures visibly stutter; below the next rate in any case.
constexpr double kSlowShare = 0.5;
constexpr double kSlow_per_s = 20;

std::string_view link_name(const DisplayStatus& display) {
  return client::link_name(static_cast<client::LinkState>(display.link));  // checked on receipt
}

/// Whether it is one of Mesa's software rasterisers.
bool draws_on_processor(const std::string& renderer) {
  return std::ranges::any_of(std::array<std::string_view, 3>{"llvmpipe", "softpipe", "swrast"},
                             [&](std::string_view name) { return renderer.find(name) != std::string::npos; });
}

std::string link_remark(const DisplayStatus& display) {
  switch (static_cast<client::LinkState>(display.link)) {
    case client::LinkState::searching:
      return "it is looking for a server: start one (its first start takes minutes), or check the cable and "
             "CYCLONEDDS_URI (mechane doctor)";
    case client::LinkState::refused:
      return "the server refuses: " + display.refusal;
    case client::LinkState::lost:
      return "the server has fallen silent: the last picture stays, and the display continues by itself when the "
             "server "
             "is back";
    default:
      return {};
  }
}

std::string name_of(const DisplayStatus& display) {
  return display.kiosk + "/" + display.display;
}

std::string setting_of(const DisplayStatus& display, std::string_view name) {
  const auto found = std::ranges::find(display.settings, name, &client::DisplaySetting::name);
  return found == display.settings.end() ? std::string() : found->value;
}

std::string sound_word(const DisplayStatus& display) {
  if (setting_of(display, "mute") == "on") return "muted";
  return display.sound.empty() ? "none" : "volume " + setting_of(display, "volume");
}

std::vector<std::string> row_of(const DisplayStatus& display) {
  return {name_of(display),
          std::string(link_name(display)),
          display.showing == "attract" ? "recorded visit" : display.scenario,
          fmt::format("{}x{}", display.width, display.height),
          fmt::format("{:.1f}", display.pictures_per_s),
          fmt::format("{:.0f}/{:.0f}", display.picture_ms_median, display.picture_ms_p99),
          fmt::format("{:.1f}", 100 * display.frames_lost),
          sound_word(display),
          display.host};
}

std::string missing_remark(const DisplayStatus& display) {
  return fmt::format("{}: {}{}; start it in the server's folder, or give --assets or --catalogue",
                     display.missing_total == 1
                         ? std::string("1 file is missing, a plain box stands in its place")
                         : fmt::format("{} files are missing, plain boxes stand in their place", display.missing_total),
                     fmt::join(display.missing, ", "), display.missing_total > display.missing.size() ? ", ..." : "");
}

bool shares_name(const DisplayStatus& display, const std::vector<DisplayStatus>& displays) {
  return std::ranges::count_if(displays, [&](const DisplayStatus& other) {
           return other.kiosk == display.kiosk && other.display == display.display;
         }) > 1;
}

/// The remarks on one display, including those that need all displays.
std::vector<std::string> remarks_among(const DisplayStatus& display, const std::vector<DisplayStatus>& displays) {
  std::vector<std::string> remarks = remarks_of(display);
  if (shares_name(display, displays)) {
    remarks.push_back(
        fmt::format("another display has the same name (this one is process {} on {}): start one with another --name",
                    display.process_id, display.host));
  }
  return remarks;
}

/// Rounds to three decimals, the precision of the wire's float: 0.8, not 0.800000011920929.
double rounded(double number) {
  return std::round(1000 * number) / 1000;
}

nlohmann::ordered_json settings_json(const DisplayStatus& display) {
  nlohmann::ordered_json settings = nlohmann::ordered_json::object();
  for (const client::DisplaySetting& setting : display.settings)
    settings[setting.name] = setting.value;
  return settings;
}

}  // namespace

std::vector<std::string> remarks_of(const DisplayStatus& display) {
  std::vector<std::string> remarks;
  if (std::string link = link_remark(display); !link.empty()) remarks.push_back(std::move(link));
  if (display.width < 2 || display.height < 2) remarks.emplace_back("its window is minimised: restore it");
  if (draws_on_processor(display.renderer)) {
    remarks.push_back("it draws on the processor (" + display.renderer + "): install the graphics card's driver");
  }
  const bool slow = display.pictures_per_s < kSlow_per_s && display.pictures_per_s < kSlowShare * display.wanted_per_s;
  if (slow && !display.offscreen && display.uptime_s > 10) {
    remarks.push_back(
        fmt::format("{:.1f} pictures a second are too few: choose a smaller --size or a faster graphics card",
                    display.pictures_per_s));
  }
  if (display.frames_lost >= kLossWorthTelling) {
    remarks.push_back(fmt::format(
        "{:.1f} % of the scene's frames are lost on the network: check the cable and the switch; do not use Wi-Fi",
        100 * display.frames_lost));
  }
  if (display.missing_total > 0) {
    remarks.push_back(missing_remark(display));
  }
  const bool meant_silent = display.offscreen || setting_of(display, "mute") == "on";
  if (display.sound.empty() && !meant_silent && !display.sound_problem.empty())
    remarks.push_back("nothing is heard: " + display.sound_problem);
  if (!display.last_warning.empty()) {
    remarks.push_back(fmt::format("warning {} of {}: {}", display.warnings, display.warnings, display.last_warning));
  }
  return remarks;
}

bool is_meant(const DisplayStatus& display, const std::string& kiosk, const std::string& name) {
  return (kiosk.empty() || display.kiosk == kiosk) && (name.empty() || display.display == name);
}

Error no_display(const std::vector<DisplayStatus>& all, const std::string& kiosk, const std::string& display) {
  if (all.empty()) {
    return {ErrorCode::not_found, "no display answered", "network",
            "start one with 'mechane display', in the same DDS domain and network (mechane doctor)"};
  }
  std::set<std::string> names;
  for (const DisplayStatus& other : all)
    names.insert(name_of(other));
  return {ErrorCode::unknown_name, "there is no such display", kiosk + "/" + (display.empty() ? "*" : display),
          fmt::format("name one of: {}", fmt::join(names, ", "))};
}

std::string displays_table(const std::vector<DisplayStatus>& displays) {
  Columns table({"display", "link", "shows", "picture", "a second", "ms median/p99", "lost %", "sound", "host"}, "<");
  std::string notes;
  for (const DisplayStatus& display : displays) {
    table.add(row_of(display));
    for (const std::string& remark : remarks_among(display, displays))
      notes += name_of(display) + ": " + remark + "\n";
  }
  return table.text() + (notes.empty() ? "" : "\n" + notes);
}

std::string displays_json(const std::vector<DisplayStatus>& displays) {
  std::string out;
  for (const DisplayStatus& d : displays) {
    const nlohmann::ordered_json json{
        {"kiosk", d.kiosk},
        {"display", d.display},
        {"host", d.host},
        {"process_id", d.process_id},
        {"version", d.version},
        {"uptime_s", d.uptime_s},
        {"link", link_name(d)},
        {"refusal", d.refusal},
        {"world", d.world},
        {"scenario", d.scenario},
        {"showing", d.showing},
        {"picture", {{"width", d.width}, {"height", d.height}, {"offscreen", d.offscreen}}},
        {"pictures", d.pictures},
        {"pictures_per_s", rounded(d.pictures_per_s)},
        {"picture_ms", {{"median", rounded(d.picture_ms_median)}, {"p99", rounded(d.picture_ms_p99)}}},
        {"frames_per_s", rounded(d.frames_per_s)},
        {"frames_lost", rounded(d.frames_lost)},
        {"missing_total", d.missing_total},
        {"missing", d.missing},
        {"renderer", d.renderer},
        {"sound", d.sound},
        {"sound_problem", d.sound_problem},
        {"warnings", d.warnings},
        {"last_warning", d.last_warning},
        {"settings", settings_json(d)},
        {"remarks", remarks_among(d, displays)},
    };
    out += json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  }
  return out;
}

}  // namespace mechane::cli
