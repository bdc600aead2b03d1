#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include <mechane/client/displays.hpp>

namespace mechane::client {
namespace {

constexpr double kDay_s = 86'400;

Expected<double> read_number(const std::string& text, double least, double most) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || last != end || !(value >= least && value <= most))
    return fail("", "", fmt::format("{} to {}", least, most));
  return value;
}

/// How one setting is read and written.
struct SettingWay {
  DisplaySettingInfo info;
  bool (*read)(const std::string& text, DisplaySettings& into);
  std::string (*write)(const DisplaySettings& from);
};

template <double DisplaySettings::*kMember, int kLeast, int kMost>
constexpr SettingWay number_way(std::string_view name, std::string_view values) {
  return {{name, values},
          [](const std::string& text, DisplaySettings& into) {
            const auto number = read_number(text, kLeast, kMost);
            if (number) into.*kMember = *number;
            return number.has_value();
          },
          [](const DisplaySettings& from) { return fmt::format("{:.6g}", from.*kMember); }};
}

template <bool DisplaySettings::*kMember>
constexpr SettingWay switch_way(std::string_view name) {
  return {{name, "on, off"},
          [](const std::string& text, DisplaySettings& into) {
            if (text != "on" && text != "off") return false;
            into.*kMember = text == "on";
            return true;
          },
          [](const DisplaySettings& from) { return std::string(from.*kMember ? "on" : "off"); }};
}

template <std::string DisplaySettings::*kMember, const std::array<std::string_view, 3>& kWords>
constexpr SettingWay word_way(std::string_view name, std::string_view values) {
  return {{name, values},
          [](const std::string& text, DisplaySettings& into) {
            if (text.empty() || std::ranges::find(kWords, text) == kWords.end()) return false;
            into.*kMember = text;
            return true;
          },
          [](const DisplaySettings& from) { return from.*kMember; }};
}

constexpr std::array<std::string_view, 3> kLanguages{"el", "en", ""};
constexpr std::array<std::string_view, 3> kAsks{"none", "after", "both"};
constexpr int kMostSeconds = static_cast<int>(kDay_s);

constexpr std::array<SettingWay, 9> kWays{{
    number_way<&DisplaySettings::volume, 0, 1>("volume", "0 to 1"),
    switch_way<&DisplaySettings::muted>("mute"),
    word_way<&DisplaySettings::language, kLanguages>("language", "el, en"),
    switch_way<&DisplaySettings::large_text>("large-text"),
    switch_way<&DisplaySettings::high_contrast>("high-contrast"),
    word_way<&DisplaySettings::ask, kAsks>("ask", "none, after, both"),
    number_way<&DisplaySettings::home_after_s, 0, kMostSeconds>("home-after", "0 (never) to 86400 seconds"),
    switch_way<&DisplaySettings::attract>("attract"),
    number_way<&DisplaySettings::attract_after_s, 5, kMostSeconds>("attract-after", "5 to 86400 seconds"),
}};

/// A name or value from outside, as it may stand in a message.
std::string quoted(const std::string& text) {
  std::string out = text.substr(0, 40);
  std::ranges::replace_if(
      out, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return "'" + out + "'";
}

}  // namespace

const std::vector<DisplaySettingInfo>& display_settings() {
  static const std::vector<DisplaySettingInfo> kAll = [] {
    std::vector<DisplaySettingInfo> all(kWays.size());
    std::ranges::transform(kWays, all.begin(), &SettingWay::info);
    return all;
  }();
  return kAll;
}

Expected<void> apply(const DisplaySetting& setting, DisplaySettings& settings) {
  std::string names;
  for (const SettingWay& way : kWays) {
    names += (names.empty() ? "" : ", ") + std::string(way.info.name);
    if (way.info.name != setting.name) continue;
    if (way.read(setting.value, settings)) return {};
    return fail(fmt::format("{} is not a value of {}", quoted(setting.value), way.info.name),
                std::string(way.info.name), fmt::format("write {}=... with {}", way.info.name, way.info.values));
  }
  return fail("a display has no setting " + quoted(setting.name), "setting", "choose one of " + names);
}

Expected<void> apply(const std::vector<DisplaySetting>& requested, DisplaySettings& settings) {
  DisplaySettings changed = settings;
  for (const DisplaySetting& setting : requested) {
    if (auto ok = apply(setting, changed); !ok) return ok;
  }
  settings = changed;
  return {};
}

std::vector<DisplaySetting> settings_of(const DisplaySettings& settings) {
  std::vector<DisplaySetting> all;
  all.reserve(kWays.size());
  for (const SettingWay& way : kWays)
    all.push_back({std::string(way.info.name), way.write(settings)});
  return all;
}

Expected<DisplaySetting> read_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    return fail(quoted(text) + " sets nothing", "setting", "write name=value, as in volume=0.5");
  return DisplaySetting{text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace mechane::client
