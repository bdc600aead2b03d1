// What the picture shows of the display's own hand: rings, dots along its path, a hint. Pure.
#pragma once

#include <optional>
#include <string>

#include "client-sdk/picture/overlay_content.hpp"
#include "client-sdk/pointer/pointer_link.hpp"

namespace mechane::pointer {

/// What the visitor uses, for the words of the hints.
enum class PointerMeans : std::uint8_t { mouse, fingers, keys };

struct PointerAid {
  picture::Sight sight;
  PointerView view;
  std::optional<Vec3> p_WT{};                  ///< a point of the thing that can be taken here
  std::optional<picture::PixelPlace> focus{};  ///< where the keys point, in the eye's picture
  PointerLinkState link = PointerLinkState::none;
  PointerMeans means = PointerMeans::mouse;
};

/// Adds dots, and a note unless there is one already. Words are Greek or English.
void add_pointer_aid(const PointerAid& aid, const std::string& language, picture::OverlayContent& content);

/// The activity that the display should begin: where no device's software runs beside the display, nobody else begins
/// the next one. None while one is running; after the last, the first again.
[[nodiscard]] std::optional<picture::OverlayButton> go_on_button(const client::WorldStatus* status,
                                                                 const std::string& language);

}  // namespace mechane::pointer
