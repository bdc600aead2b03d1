// What browsers send over their WebSocket, read and checked: STREAM.md has the form.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "client-sdk/picture/named_thing.hpp"
#include "client-sdk/picture/overlay_controls.hpp"
#include "client-sdk/picture/sight.hpp"
#include "client-sdk/pointer/pointer_event.hpp"
#include "server/base/error.hpp"

namespace mechane::gateway {

struct PointerMessage {
  struct One {
    pointer::PointerEvent event;
    std::optional<picture::Touched> pick{};  ///< what the browser's ray hit
  };
  std::vector<One> events;
  picture::Sight sight;
};
struct PressMessage {
  picture::OverlayAction action;
};
struct TouchMessage {};
struct LanguageMessage {
  std::string code;
};
struct ClickMessage {
  std::uint32_t object = 0;
};
struct SettingsMessage {
  std::optional<bool> large_text{};
  std::optional<bool> high_contrast{};
};
/// How a browser's pictures are: see client::DisplayStatus.
struct StatusMessage {
  double pictures_per_s = 0;
  double picture_ms_median = 0;
  double picture_ms_p99 = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::string> missing{};
  std::string renderer{};
};
using BrowserMessage = std::variant<PointerMessage, PressMessage, TouchMessage, LanguageMessage, ClickMessage,
                                    SettingsMessage, StatusMessage>;

inline constexpr std::size_t kMostEvents = 64;

/// Errors: damaged (no JSON), unknown_name (no such type), invalid_value (with the field's name as the place), too_large. All numbers of a
/// message are finite, all texts short and well-formed.
[[nodiscard]] Expected<BrowserMessage> parse_browser_message(std::string_view text);

/// As a browser gets it for a button, and sends it back: "home", "language:en", "answer:3".
[[nodiscard]] std::string action_text(const picture::OverlayAction& action);
[[nodiscard]] std::optional<picture::OverlayAction> action_of(std::string_view text);

}  // namespace mechane::gateway
