// Colours that people with any kind of colour vision can distinguish.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "server/base/math.hpp"
#include "server/collision/object.hpp"
#include "server/geometry/solid/solid_mesh.hpp"

namespace mechane::fit {

/// Linear light, 0 to 1; pictures are shaded and averaged in it.
using Colour = Eigen::Array3f;

[[nodiscard]] Colour from_srgb(std::uint32_t rgb);  ///< 0xRRGGBB
[[nodiscard]] std::uint32_t to_srgb(const Colour& colour);
[[nodiscard]] std::string css(const Colour& colour);  ///< "#rrggbb"

/// A colour for each part, so that parts that touch get different ones as long as there are enough.
[[nodiscard]] std::vector<Colour> part_colours(const collision::Object& object);

/// A scale from pale to dark, with steadily decreasing lightness, so that it can also be read in grey.
enum class Scale : std::uint8_t {
  error,  ///< pale straw, orange, dark plum
  depth,  ///< pale sand, green, dark blue
};
[[nodiscard]] Colour colour_at(Scale scale, double share);  ///< share of the scale's length, 0 to 1; clamped

/// "linear-gradient(...)" of the scale from left to right.
[[nodiscard]] std::string css_gradient(Scale scale);

[[nodiscard]] Colour not_felt_colour();  ///< outside the scales: where a map feels nothing
[[nodiscard]] Colour plain_colour();     ///< the object, without a meaning
[[nodiscard]] Colour origin_colour(geometry::SurfaceOrigin origin);

}  // namespace mechane::fit
