#include "client-sdk/fit/picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "client-sdk/fit/net.hpp"
#include "client-sdk/fit/shading.hpp"
#include "server/base/math.hpp"
#include "server/base/parallel.hpp"

namespace mechane::fit {
namespace {

constexpr int kFine = 3;  // pixels of the buffer along a pixel of the picture
constexpr int kMargin = 6;
constexpr int kLeastSide = 24;
constexpr double kSides_rad[kSides][2] = {{-0.6, 0.38}, {2.54, 0.38}, {-0.25, 1.2}};  // azimuth, elevation
constexpr float kGlass = 0.30F;
constexpr float kNetLine = 0.85F;
constexpr float kErrorLight = 0.45F;  // less shading for colours that stand for a number
constexpr double kScaleQuantile = 0.995;
constexpr double kLeastScale_mm = 0.01;
constexpr float kPlain = std::numeric_limits<float>::quiet_NaN();  // no error: a seam
constexpr float kNotFelt = std::numeric_limits<float>::infinity();

Colour error_colour(float error_mm, double scale_mm) {
  if (std::isnan(error_mm)) return plain_colour();
  return std::isinf(error_mm) ? not_felt_colour() : colour_at(Scale::error, error_mm / scale_mm);
}

/// The buffer's pixel that represents a pixel of the picture: the middle one, or else the first covered one.
std::size_t witness_of(const DepthBuffer& buffer, int x, int y) {
  const auto at = [&](int dx, int dy) {
    return static_cast<std::size_t>(y * kFine + dy) * buffer.width + static_cast<std::size_t>(x * kFine + dx);
  };
  if (buffer.covered(at(kFine / 2, kFine / 2))) return at(kFine / 2, kFine / 2);
  for (int i = 0; i < kFine * kFine; ++i) {
    if (buffer.covered(at(i % kFine, i / kFine))) return at(i % kFine, i / kFine);
  }
  return at(0, 0);
}

/// The three views of all vertices of `mesh`, side by side, at the scale that the row's room allows.
std::array<View, kSides> views_of(const geometry::Mesh& mesh, int row_width, int max_height) {
  std::array<View, kSides> views;
  std::array<Vec3, kSides> size_m;
  double widths_m = 0;
  double height_m = 0;
  for (std::size_t i = 0; i < kSides; ++i) {
    views[i] = view_from(mesh, kSides_rad[i][0], kSides_rad[i][1], size_m[i]);
    // From above, a long object is shown lying across the picture, however it lies in the model.
    Vec3 turned_m;
    const View turned = view_from(mesh, kSides_rad[i][0] + kPi / 2, kSides_rad[i][1], turned_m);
    if (i == kSides - 1 && turned_m.y() < size_m[i].y()) {
      views[i] = turned;
      size_m[i] = turned_m;
    }
    widths_m += size_m[i].x();
    height_m = std::max(height_m, size_m[i].y());
  }
  const double margins = 2.0 * kMargin;
  const double px_per_m = std::min((row_width - kSides * margins) / std::max(widths_m, 1e-9),
                                   (max_height - margins) / std::max(height_m, 1e-9));
  for (std::size_t i = 0; i < kSides; ++i) {
    views[i].px_per_m = px_per_m;
    views[i].width = std::max(kLeastSide, static_cast<int>(std::ceil(px_per_m * size_m[i].x() + margins)));
    views[i].height = std::max(kLeastSide, static_cast<int>(std::ceil(px_per_m * height_m + margins)));
  }
  return views;
}

}  // namespace

Pictures::Pictures(const Surface& surface, const collision::Object& object, int row_width, int max_height)
    : surface_(surface),
      object_(object),
      row_width_(row_width),
      max_height_(max_height),
      part_colours_(part_colours(object)) {
  const auto views = views_of(surface.mesh(), row_width, max_height);
  for (std::size_t i = 0; i < kSides; ++i)
    sides_[i] = side_of(views[i]);
}

Pictures::Side Pictures::side_of(const View& view) const {
  Side side{view.finer(kFine), {}, {}};
  side.buffer = rasterise(surface_.mesh(), side.view);
  side.light = light_of(side.buffer, surface_.mesh(), side.view);
  return side;
}

Image Pictures::average(const Side& side, const std::function<Paint(std::size_t)>& paint) {
  Image image{side.view.width / kFine, side.view.height / kFine, {}};
  image.rgba.resize(std::size_t{4} * image.width * image.height);
  for_each_index(static_cast<std::size_t>(image.height), [&](std::size_t y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(image.width); ++x) {
      Colour sum = Colour::Zero();
      float alpha = 0;
      for (std::size_t i = 0; i < std::size_t{kFine} * kFine; ++i) {
        const Paint p = paint((y * kFine + i / kFine) * side.buffer.width + x * kFine + i % kFine);
        sum += p.alpha * p.colour;
        alpha += p.alpha;
      }
      if (alpha <= 0) continue;
      const std::uint32_t rgb = to_srgb(sum / alpha);
      std::uint8_t* out = image.rgba.data() + 4 * (y * image.width + x);
      for (int i = 0; i < 3; ++i)
        out[i] = static_cast<std::uint8_t>(rgb >> (16 - 8 * i));
      out[3] = static_cast<std::uint8_t>(std::lround(255 * alpha / (kFine * kFine)));
    }
  });
  return image;
}

Row Pictures::painted(const std::function<Colour(std::uint32_t triangle)>& colour_of) const {
  Row row;
  for (std::size_t i = 0; i < kSides; ++i) {
    const Side& side = sides_[i];
    row[i] = average(side, [&](std::size_t pixel) -> Paint {
      if (!side.buffer.covered(pixel)) return {};
      return {side.light[pixel] * colour_of(side.buffer.triangle[pixel]), 1};
    });
  }
  return row;
}

Row Pictures::parts() const {
  return painted([&](std::uint32_t triangle) { return part_colours_[surface_.part_of_triangle()[triangle]]; });
}

Row Pictures::origins() const {
  return painted([&](std::uint32_t triangle) { return origin_colour(surface_.origin_of_triangle()[triangle]); });
}

std::vector<float> Pictures::probe_pixels(const Side& side) const {
  const int width = side.view.width / kFine;
  std::vector<float> errors_mm(static_cast<std::size_t>(width) * (side.view.height / kFine), kPlain);
  for_each_index(static_cast<std::size_t>(side.view.height / kFine), [&](std::size_t y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t at = witness_of(side.buffer, x, static_cast<int>(y));
      if (!side.buffer.covered(at)) continue;
      const std::size_t row = at / side.buffer.width;
      const std::size_t column = at % side.buffer.width;
      const Vec3 p_screen(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5, side.buffer.z[at]);
      const auto error = surface_.error_at(side.view.to_object(p_screen), side.buffer.triangle[at]);
      if (!error) continue;
      errors_mm[y * width + x] = error->felt ? static_cast<float>(1000 * error->error_m) : kNotFelt;
    }
  });
  return errors_mm;
}

ErrorRow Pictures::errors() const {
  ErrorRow row;
  std::array<std::vector<float>, kSides> errors_mm;
  std::vector<float> felt;
  for (std::size_t i = 0; i < kSides; ++i) {
    errors_mm[i] = probe_pixels(sides_[i]);
    for (const float error : errors_mm[i]) {
      if (std::isfinite(error)) felt.push_back(error);
    }
  }
  std::sort(felt.begin(), felt.end());
  const auto quantile = [&](double share) {
    return felt.empty() ? 0.0 : felt[static_cast<std::size_t>(share * static_cast<double>(felt.size() - 1))];
  };
  row.scale_mm = round_up_to_scale(std::max(quantile(kScaleQuantile), kLeastScale_mm));
  for (std::size_t i = 0; i < kSides; ++i) {
    const Side& side = sides_[i];
    const std::size_t fine_width = side.buffer.width;
    row.images[i] = average(side, [&](std::size_t pixel) -> Paint {
      if (!side.buffer.covered(pixel)) return {};
      const std::size_t coarse = pixel / fine_width / kFine * (fine_width / kFine) + pixel % fine_width / kFine;
      const float light = 1 - kErrorLight + kErrorLight * side.light[pixel];
      return {light * error_colour(errors_mm[i][coarse], row.scale_mm), 1};
    });
  }
  return row;
}

Row Pictures::superquadrics() const {
  const Shells shells = make_shells(object_);
  geometry::Mesh all = shells.mesh;  // the glass reaches beyond the object
  all.vertices.insert(all.vertices.end(), surface_.mesh().vertices.begin(), surface_.mesh().vertices.end());
  const auto views = views_of(all, row_width_, max_height_);
  Row row;
  for (std::size_t i = 0; i < kSides; ++i)
    row[i] = draw_superquadrics(shells, side_of(views[i]));
  return row;
}

Image Pictures::draw_superquadrics(const Shells& shells, const Side& side) const {
  const DepthBuffer glass = rasterise(shells.mesh, side.view);
  const std::vector<float> glass_light = light_of(glass, shells.mesh, side.view);
  const std::vector<std::uint32_t> lines = draw_net(object_, side.view, glass, side.buffer);
  return average(side, [&](std::size_t pixel) -> Paint {
    Paint paint;
    if (side.buffer.covered(pixel)) paint = {side.light[pixel] * plain_colour(), 1};
    if (lines[pixel] != DepthBuffer::kNothing) {
      const Colour ink = 0.55F * part_colours_[lines[pixel]];
      const float rest = (1 - kNetLine) * paint.alpha;
      return {(kNetLine * ink + rest * paint.colour) / (kNetLine + rest), kNetLine + rest};
    }
    if (!glass.covered(pixel) || glass.z[pixel] < side.buffer.z[pixel] - 1) return paint;
    const Colour tint = glass_light[pixel] * part_colours_[shells.part_of_triangle[glass.triangle[pixel]]];
    const float rest = (1 - kGlass) * paint.alpha;
    return {(kGlass * tint + rest * paint.colour) / (kGlass + rest), kGlass + rest};
  });
}

}  // namespace mechane::fit
