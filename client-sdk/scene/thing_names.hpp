// What things are called, for who points at them. Pure.
#pragma once

#include <optional>
#include <span>

#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/picture/sight.hpp"
#include <mechane/client/types.hpp>

namespace mechane::scene {

/// What a fingertip is about to touch: the nearest of all things within a hand's breadth. A hand that holds something, or whose device is
/// silent, asks for no name.
[[nodiscard]] std::optional<picture::Touched> named_near(std::span<const picture::NamedThing> things,
                                                         std::span<const client::HandPose> hands);

/// The name of what is meant, where it is seen; of a large thing, about the place that is pointed at. None where it has no name, or what is
/// meant is not before the eye.
[[nodiscard]] std::optional<picture::OverlayLabel> label_of(std::span<const picture::NamedThing> things,
                                                            const picture::Touched& meant, const picture::Sight& sight);

}  // namespace mechane::scene
