// The names of things that visitors point at. Pure.
#pragma once

#include <optional>
#include <span>

#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/picture/sight.hpp"
#include <mechane/client/types.hpp>

namespace mechane::scene {

/// What a fingertip is about to touch: the nearest thing within a hand's breadth. None for a hand that holds something
/// or whose device is silent.
[[nodiscard]] std::optional<picture::Touched> named_near(std::span<const picture::NamedThing> things,
                                                         std::span<const client::HandPose> hands);

/// The name of the touched thing and its place in the picture; for a large thing, near the touched point. None if it
/// has no name or is behind the eye.
[[nodiscard]] std::optional<picture::OverlayLabel> label_of(std::span<const picture::NamedThing> things,
                                                            const picture::Touched& meant, const picture::Sight& sight);

}  // namespace mechane::scene
