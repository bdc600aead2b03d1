#include "client-sdk/fit/map_image.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "client-sdk/fit/net.hpp"
#include "client-sdk/fit/palette.hpp"
#include "client-sdk/fit/probe.hpp"

namespace mechane::fit {
namespace {

constexpr int kCastSteps = 64;
constexpr int kCastHalvings = 8;
constexpr double kCoveredShare = 0.01;  // of the diagonal: a greater depth at the start is not a rounding error
constexpr std::uint32_t kCovered = 0xB4B0A8;
constexpr std::uint32_t kNoHit = 0xE4E1DA;
constexpr std::uint32_t kNoHitDot = 0xA19C92;

enum class RayEnd : std::uint8_t { outside_net, depth, no_hit, covered };
struct Cast {
  RayEnd end = RayEnd::outside_net;
  double depth_m = 0;
};

/// The direction of the net's cell (column, row); the net is four faces wide and three high. Zero outside the net.
Vec3 net_direction(int x, int y, int texels) {
  const int column = x / texels;
  const int row = y / texels;
  const double u = (2.0 * (x % texels) + 1) / texels - 1;  // to the right
  const double w = 1 - (2.0 * (y % texels) + 1) / texels;  // up
  if (row == 0) return column == 0 ? Vec3(-w, u, 1) : Vec3::Zero();
  if (row == 2) return column == 0 ? Vec3(w, u, -1) : Vec3::Zero();
  switch (column) {
    case 0:
      return {1, u, w};
    case 1:
      return {-u, 1, w};
    case 2:
      return {-1, -u, w};
    default:
      return {u, -1, w};
  }
}

Cast cast_inwards(const Probe& probe, const collision::Part& part, const Vec3& d) {
  const Vec3 p_Q = surface_at(part.superquadric, d);
  const Vec3 slope = geometry::gradient(part.superquadric, p_Q);
  const Vec3 inward_O = part.X_OQ.rotate(-(slope.allFinite() && slope.norm() > 0 ? slope : p_Q).normalized());
  const Vec3 p_O = part.X_OQ * p_Q;
  const double reach = 2 * part.bound_O.radius;
  const double step = reach / kCastSteps;
  const Felt first = probe.at(p_O + 1e-4 * reach * inward_O);
  if (first.hit) return {first.depth_m > kCoveredShare * reach ? RayEnd::covered : RayEnd::depth, 0};
  for (int i = 1; i <= kCastSteps; ++i) {
    if (!probe.at(p_O + i * step * inward_O).hit) continue;
    double air = (i - 1) * step;
    double solid = i * step;
    for (int k = 0; k < kCastHalvings; ++k) {
      const double middle = 0.5 * (air + solid);
      (probe.at(p_O + middle * inward_O).hit ? solid : air) = middle;
    }
    return {RayEnd::depth, solid};
  }
  return {RayEnd::no_hit, 0};
}

void paint(std::uint8_t* out, std::uint32_t rgb) {
  for (int i = 0; i < 3; ++i)
    out[i] = static_cast<std::uint8_t>(rgb >> (16 - 8 * i));
  out[3] = 255;
}

}  // namespace

MapPicture draw_map(const collision::Object& object, std::size_t part, int texels) {
  const Probe probe(object, part);
  MapPicture map{{4 * texels, 3 * texels, {}}};
  std::vector<Cast> casts;
  std::size_t counts[4] = {};
  for (int i = 0; i < map.image.width * map.image.height; ++i) {
    const Vec3 d = net_direction(i % map.image.width, i / map.image.width, texels);
    casts.push_back(d.isZero() ? Cast{} : cast_inwards(probe, object.parts[part], d));
    ++counts[static_cast<std::size_t>(casts.back().end)];
    map.deepest_mm = std::max(map.deepest_mm, 1000 * casts.back().depth_m);
  }
  const double places = 6.0 * texels * texels;
  map.no_hit_share = static_cast<double>(counts[static_cast<std::size_t>(RayEnd::no_hit)]) / places;
  map.covered_share = static_cast<double>(counts[static_cast<std::size_t>(RayEnd::covered)]) / places;
  map.image.rgba.assign(4 * casts.size(), 0);
  for (std::size_t i = 0; i < casts.size(); ++i) {
    const std::size_t x = i % static_cast<std::size_t>(map.image.width);
    const std::size_t y = i / static_cast<std::size_t>(map.image.width);
    const bool dot = x % 3 == 1 && y % 3 == 1;
    std::uint8_t* out = map.image.rgba.data() + 4 * i;
    if (casts[i].end == RayEnd::depth) {
      paint(out, to_srgb(colour_at(Scale::depth, 1000 * casts[i].depth_m / std::max(map.deepest_mm, 1e-6))));
    } else if (casts[i].end != RayEnd::outside_net) {
      paint(out, casts[i].end == RayEnd::covered ? kCovered : dot ? kNoHitDot : kNoHit);
    }
  }
  return map;
}

}  // namespace mechane::fit
