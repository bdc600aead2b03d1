// What the picture shows of the display's own hand: rings, dots on its way, a word. Pure.
#pragma once

#include <optional>
#include <string>

#include "client-sdk/picture/overlay_content.hpp"
#include "client-sdk/pointer/pointer_link.hpp"

namespace mechane::pointer {

/// What the visitor uses, as far as the words must know.
enum class PointerMeans : std::uint8_t { mouse, fingers, keys };

struct PointerAid {
  picture::Sight sight;
  PointerView view;
  std::optional<Vec3> p_WT{};                  ///< what could be taken here
  std::optional<picture::PixelPlace> focus{};  ///< of the keys, in the eye's picture
  PointerLinkState link = PointerLinkState::none;
  PointerMeans means = PointerMeans::mouse;
};

/// Adds dots, and a note where there is none. Words are Greek or English.
void add_pointer_aid(const PointerAid& aid, const std::string& language, picture::OverlayContent& content);

/// Without a device's software beside the display, nobody else begins the next activity. None while one goes on; after the last, the first
/// again.
[[nodiscard]] std::optional<picture::OverlayButton> go_on_button(const client::WorldStatus* status,
                                                                 const std::string& language);

}  // namespace mechane::pointer
