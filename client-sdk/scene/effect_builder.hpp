// From a scenario's effects, driven by the frame's quantities, to what the renderer draws.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "client-sdk/picture/render_scene.hpp"
#include <mechane/client/types.hpp>

namespace mechane::scene {

/// A quantity's value, in SI where its unit is a flow of water (l/s, l/min, kg/s become m^3/s). 0 where the frame has
/// none.
[[nodiscard]] double quantity_value(const client::Frame& frame, const client::WorldStatus& status,
                                    std::uint32_t quantity);

/// How strong an effect is, 0 to 1.
[[nodiscard]] double effect_strength(const client::Effect& effect, const client::Frame& frame);

/// The width of a stream with this flow and speed; its section is an ellipse of width w and thickness 0.45 w.
[[nodiscard]] double stream_width_m(double flow_m3_per_s, double speed_m_per_s);

/// How high the water in a node of the mesh file stands above its modelled place; none if no effect raises it.
[[nodiscard]] std::optional<double> level_of(const client::WorldPresentation& presentation, const client::Frame& frame,
                                             const std::string& node);

/// The horizontal velocity of a node's water, in W; zero if no effect makes it flow.
[[nodiscard]] Vec3 flow_of(const client::WorldPresentation& presentation, const std::string& node);

/// Adds streams, jets and particles. `pose_of` gives an object's pose in W; `landing_height_m` is where falling water
/// ends.
void add_effects(const client::WorldPresentation& presentation, const client::Frame& frame,
                 const client::WorldStatus& status, const std::function<Pose(std::uint32_t)>& pose_of,
                 float landing_height_m, picture::RenderScene& out);

}  // namespace mechane::scene
