#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "server/base/utf8.hpp"
#include <mechane/client/displays.hpp>

namespace mechane::client {
namespace {

constexpr double kDay_s = 86'400;

std::optional<double> read_number(const std::string& text, double least, double most) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || last != end || !(value >= least && value <= most)) return std::nullopt;
  return value;
}

/// One setting: its name and values, and how it is read and written.
struct SettingKind {
  DisplaySettingInfo info;
  bool (*read)(const std::string& text, DisplaySettings& into);
  std::string (*write)(const DisplaySettings& from);
};

template <double DisplaySettings::*kMember, int kLeast, int kMost>
constexpr SettingKind number_setting(std::string_view name, std::string_view values) {
  return {{name, values},
          [](const std::string& text, DisplaySettings& into) {
            const auto number = read_number(text, kLeast, kMost);
            if (number) into.*kMember = *number;
            return number.has_value();
          },
          [](const DisplaySettings& from) { return fmt::format("{:.6g}", from.*kMember); }};
}

template <bool DisplaySettings::*kMember>
constexpr SettingKind switch_setting(std::string_view name) {
  return {{name, "on, off"},
          [](const std::string& text, DisplaySettings& into) {
            if (text != "on" && text != "off") return false;
            into.*kMember = text == "on";
            return true;
          },
          [](const DisplaySettings& from) { return std::string(from.*kMember ? "on" : "off"); }};
}

template <std::string DisplaySettings::*kMember, const auto& kWords>
constexpr SettingKind word_setting(std::string_view name, std::string_view values) {
  return {{name, values},
          [](const std::string& text, DisplaySettings& into) {
            if (std::ranges::find(kWords, text) == kWords.end()) return false;
            into.*kMember = text;
            return true;
          },
          [](const DisplaySettings& from) { return from.*kMember; }};
}

/// One line of well-formed text, or nothing.
bool is_message(const std::string& text) {
  return text.size() <= DisplaySettings::kMostMessage && !first_bad_utf8(text) &&
         std::ranges::none_of(text, [](char c) { return is_control(c); });
}

template <std::string DisplaySettings::*kMember>
constexpr SettingKind message_setting(std::string_view name) {
  return {{name, "one line, 240 bytes at most; empty: none"},
          [](const std::string& text, DisplaySettings& into) {
            if (!is_message(text)) return false;
            into.*kMember = text;
            return true;
          },
          [](const DisplaySettings& from) { return from.*kMember; }};
}

constexpr std::array<std::string_view, 3> kSigns{"none", "closed", "maintenance"};
/// The first part of a web address, without a path.
bool is_origin(std::string_view text) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!text.starts_with(scheme)) continue;
    const std::string_view host = text.substr(scheme.size());
    return !host.empty() && std::ranges::all_of(host, [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '.' || c == '-' || c == ':' || c == '[' || c == ']';
    });
  }
  return false;
}

bool is_token(std::string_view text) {
  return std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; });
}

constexpr std::size_t kLongestPart = 63;  // a longer address makes a code too fine for a phone

constexpr SettingKind kPhoneAddress{{"phone-address", "http(s)://HOST(:PORT), of 63 characters at most, or nothing"},
                                    [](const std::string& text, DisplaySettings& into) {
                                      const bool good = text.empty() || is_origin(text);
                                      if (!good || text.size() > kLongestPart) return false;
                                      into.phone_address = text;
                                      return true;
                                    },
                                    [](const DisplaySettings& from) { return from.phone_address; }};
constexpr SettingKind kPhoneCode{{"phone-code", "letters, digits, - and _, or nothing"},
                                 [](const std::string& text, DisplaySettings& into) {
                                   if (!is_token(text) || text.size() > kLongestPart) return false;
                                   into.phone_code = text;
                                   return true;
                                 },
                                 [](const DisplaySettings& from) {  // who reads a display's status learns no secret
                                   return std::string(from.phone_code.empty() ? "" : "set");
                                 }};

constexpr std::array<std::string_view, 2> kLanguages{"el", "en"};
constexpr std::array<std::string_view, 3> kAsks{"none", "after", "both"};
constexpr std::array<std::string_view, 5> kQualities{"auto", "high", "medium", "low", "cached"};
constexpr std::array<std::string_view, 4> kHands{"light", "medium", "dark", "glove"};
constexpr int kMostSeconds = static_cast<int>(kDay_s);

constexpr std::array<SettingKind, 16> kSettings{{
    number_setting<&DisplaySettings::volume, 0, 1>("volume", "0 to 1"),
    switch_setting<&DisplaySettings::muted>("mute"),
    word_setting<&DisplaySettings::language, kLanguages>("language", "el, en"),
    switch_setting<&DisplaySettings::large_text>("large-text"),
    switch_setting<&DisplaySettings::high_contrast>("high-contrast"),
    word_setting<&DisplaySettings::ask, kAsks>("ask", "none, after, both"),
    number_setting<&DisplaySettings::home_after_s, 0, kMostSeconds>("home-after", "0 (never) to 86400 seconds"),
    switch_setting<&DisplaySettings::attract>("attract"),
    number_setting<&DisplaySettings::attract_after_s, 5, kMostSeconds>("attract-after", "5 to 86400 seconds"),
    word_setting<&DisplaySettings::quality, kQualities>("quality", "auto, high, medium, low, cached"),
    word_setting<&DisplaySettings::hand, kHands>("hand", "light, medium, dark, glove"),
    word_setting<&DisplaySettings::sign, kSigns>("sign", "none, closed, maintenance"),
    message_setting<&DisplaySettings::message_el>("message-el"),
    message_setting<&DisplaySettings::message_en>("message-en"),
    kPhoneAddress,
    kPhoneCode,
}};

/// A name or value from outside in quotes, without characters that could drive a terminal.
std::string quoted(const std::string& text) {
  return "'" + without_controls(utf8_beginning(text, 40)) + "'";
}

}  // namespace

const std::vector<DisplaySettingInfo>& display_settings() {
  static const std::vector<DisplaySettingInfo> kAll = [] {
    std::vector<DisplaySettingInfo> all(kSettings.size());
    std::ranges::transform(kSettings, all.begin(), &SettingKind::info);
    return all;
  }();
  return kAll;
}

Expected<void> apply(const DisplaySetting& setting, DisplaySettings& settings) {
  std::string names;
  for (const SettingKind& kind : kSettings) {
    names += (names.empty() ? "" : ", ") + std::string(kind.info.name);
    if (kind.info.name != setting.name) continue;
    if (kind.read(setting.value, settings)) return {};
    return fail(ErrorCode::invalid_value, fmt::format("{} is not a value of {}", quoted(setting.value), kind.info.name),
                std::string(kind.info.name), fmt::format("write {}=... with {}", kind.info.name, kind.info.values));
  }
  return fail(ErrorCode::unknown_name, "a display has no setting " + quoted(setting.name), "setting",
              "choose one of " + names);
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
  all.reserve(kSettings.size());
  for (const SettingKind& kind : kSettings)
    all.push_back({std::string(kind.info.name), kind.write(settings)});
  return all;
}

Expected<DisplaySetting> read_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    return fail(ErrorCode::invalid_value, quoted(text) + " is not a setting with its value", "setting",
                "write name=value, as in volume=0.5");
  return DisplaySetting{text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace mechane::client
