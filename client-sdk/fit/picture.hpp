// The pictures of a report: the object from three sides in the colours of its parts, of its error, and under its
// superquadrics.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "client-sdk/fit/image.hpp"
#include "client-sdk/fit/net.hpp"
#include "client-sdk/fit/palette.hpp"
#include "client-sdk/fit/raster.hpp"
#include "client-sdk/fit/surface.hpp"

namespace mechane::fit {

inline constexpr std::size_t kSides = 3;
inline constexpr std::array<const char*, kSides> kSideNames{"seen from +z", "seen from −z", "seen from +y"};
using Row = std::array<Image, kSides>;

struct ErrorRow {
  Row images;
  double scale_mm = 0;  ///< the error at the dark end of the scale
};

/// Pictures are transparent around the object, for light and dark pages. All sides have the same scale. The surface and
/// the object must outlive this.
class Pictures {
 public:
  /// Three pictures side by side fill `row_width` pixels, unless they would be higher than `max_height`.
  Pictures(const Surface& surface, const collision::Object& object, int row_width, int max_height);

  [[nodiscard]] Row parts() const;

  /// Where each place of the surface comes from: origin_colour().
  [[nodiscard]] Row origins() const;

  /// Evaluates Surface::error_at for each pixel. The scale ends at the rounded-up error of 99.5 % of the places, and at
  /// 0.01 mm at least. Places that are not felt have a colour of their own; surface between parts is plain.
  [[nodiscard]] ErrorRow errors() const;

  /// The superquadrics as glass, with a net of lines where nothing is in front of them.
  [[nodiscard]] Row superquadrics() const;

 private:
  /// Drawn with more pixels than the picture has, and averaged at the end.
  struct Side {
    View view;
    DepthBuffer buffer;
    std::vector<float> light;  ///< 0 to about 1, of each pixel of the buffer
  };
  struct Paint {
    Colour colour = Colour::Zero();
    float alpha = 0;
  };
  [[nodiscard]] Row painted(const std::function<Colour(std::uint32_t triangle)>& colour_of) const;
  [[nodiscard]] static Image average(const Side& side, const std::function<Paint(std::size_t)>& paint);
  [[nodiscard]] std::vector<float> probe_pixels(const Side& side) const;
  [[nodiscard]] Side side_of(const View& view) const;
  [[nodiscard]] Image draw_superquadrics(const Shells& shells, const Side& side) const;

  const Surface& surface_;
  const collision::Object& object_;
  int row_width_;
  int max_height_;
  std::vector<Colour> part_colours_;
  std::array<Side, kSides> sides_;
};

}  // namespace mechane::fit
