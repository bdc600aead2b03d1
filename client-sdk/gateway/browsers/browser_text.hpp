// What browsers are told in texts, as JSON: STREAM.md has the form. Pure.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "client-sdk/gateway/browsers/browser_hand.hpp"
#include "client-sdk/gateway/browsers/hand_finders.hpp"
#include "client-sdk/picture/overlay_content.hpp"
#include <mechane/client/client.hpp>
#include <mechane/client/displays.hpp>

namespace mechane::gateway {

inline constexpr int kStreamVersion = 1;

[[nodiscard]] std::string hello_text(const std::string& kiosk, const std::string& display, const HandFinders& finders);
[[nodiscard]] std::string link_text(client::LinkState state, const std::string& refusal);
[[nodiscard]] std::string world_text(const client::WorldStatus& status);
[[nodiscard]] std::string scene_text(std::span<const client::SceneObject> objects);
[[nodiscard]] std::string presentation_text(const client::WorldPresentation& presentation);
/// What is written over the picture for one browser.
struct BrowserWords {
  const picture::OverlayContent& content;
  std::string language;
  std::vector<std::string> languages;  ///< of the exhibit
  std::string subtitle;
};
[[nodiscard]] std::string overlay_text(const BrowserWords& words);
/// As the wire calls it: none, waiting, joined, refused.
[[nodiscard]] std::string_view link_word(pointer::PointerLinkState link);
/// At least one.
[[nodiscard]] std::string pointer_text(std::span<const HandTold> hands);
[[nodiscard]] std::string event_text(const client::WorldEvent& event);
[[nodiscard]] std::string settings_text(const client::DisplaySettings& settings);
[[nodiscard]] std::string bye_text(const std::string& reason, const std::string& remedy);

}  // namespace mechane::gateway
