#include "server/geometry/pieces/cut_search.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "server/geometry/pieces/fan_plan.hpp"

namespace mechane::geometry {
namespace {

constexpr std::size_t kPlacesTried = 40;
constexpr double kPlacesApart = 1.0 / 14;  // of the region's extent
constexpr double kBesideCut = 0.5;         // cells: a place this close to a cut is used up
constexpr std::size_t kMostPairs = 80;
constexpr double kAlike = 0.7;  // cosine between the creases of a pair
constexpr std::size_t kCutFinalists = 24;
constexpr int kQuantiles = 8;
constexpr std::size_t kRatedPoints = 160;
constexpr std::size_t kLeastPoints = 4;
constexpr double kLeastShare = 0.004;  // of the points that a child must have
constexpr double kExcessFrom = 0.5;    // of the bound: shallower chords do not count
constexpr double kExcessTo = 5;        // of the bound: deeper ones count the same
constexpr std::size_t kAreaProbes = 400;
constexpr double kPriceOfArea = 1.0;
constexpr double kWorthOfDepth = 0.5;
constexpr double kWorthOfDone = 0.3;

/// How much a chord counts, for each pair of some of the region's points.
struct ExcessTable {
  ExcessTable(const DecomposeModel& model, const PieceRegion& region, std::size_t stride) {
    const double from = kExcessFrom * model.bound_m / region.chords.unit_m();
    const double to = kExcessTo * model.bound_m / region.chords.unit_m();
    for (std::size_t i = 0; i < region.points.size(); i += stride)
      points.push_back(region.points[i]);
    size = points.size();
    excess.reserve(size * size);
    for (std::size_t i = 0; i < size; ++i) {
      const auto row = region.chords.row(i * stride);
      for (std::size_t j = 0; j < size; ++j) {
        const double units = std::clamp<double>(row[j * stride], from, to) - from;
        excess.push_back(static_cast<std::uint16_t>(units / (to - from) * 4095));
        total += excess.back();
      }
    }
  }

  std::vector<Vec3> points;
  std::size_t size = 0;
  std::vector<std::uint16_t> excess;
  std::uint64_t total = 0;
};

struct Parting {
  double left = 1;  ///< share of the excess that lies within the two children
  std::size_t within = 0;
  std::size_t beyond = 0;
};

Parting part(const ExcessTable& table, const HalfSpace& plane, std::vector<std::uint16_t>& side) {
  Parting parting;
  side.resize(table.size);
  for (std::size_t i = 0; i < table.size; ++i) {
    side[i] = plane.excess(table.points[i]) <= 0 ? 0xFFFF : 0;
    ++(side[i] != 0 ? parting.within : parting.beyond);
  }
  std::uint64_t left = 0;
  for (std::size_t i = 0; i < table.size; ++i) {
    const std::uint16_t* row = table.excess.data() + i * table.size;
    const std::uint16_t mine = side[i];
    std::uint32_t sum = 0;  // at most 4095 times a few thousand
    for (std::size_t j = 0; j < table.size; ++j)
      sum += static_cast<std::uint32_t>(row[j] & static_cast<std::uint16_t>(~(side[j] ^ mine)));
    left += sum;
  }
  if (table.total > 0) parting.left = static_cast<double>(left) / static_cast<double>(table.total);
  return parting;
}

/// The region's own concave places, the strongest first and apart from each other.
std::vector<ConcavePlace> places_in(const DecomposeModel& model, const PieceRegion& region,
                                    std::span<const ConcavePlace> places) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : region.points)
    box.extend(p);
  const double apart = kPlacesApart * box.diagonal().norm();
  std::vector<ConcavePlace> chosen;
  for (const ConcavePlace& place : places) {
    if (!cell_contains(region.cell, place.p, -kBesideCut * model.grid.cell_m())) continue;
    const bool crowded = std::any_of(chosen.begin(), chosen.end(),
                                     [&](const ConcavePlace& other) { return (other.p - place.p).norm() < apart; });
    if (crowded) continue;
    chosen.push_back(place);
    if (chosen.size() == kPlacesTried) break;
  }
  return chosen;
}

void add_plane(const Vec3& p, const Vec3& normal, std::vector<HalfSpace>& planes) {
  const double length = normal.norm();
  if (length > 1e-6) planes.push_back(HalfSpace::through(p, normal / length));
}

/// Planes through two places with solid between them, containing the direction of their creases: the shortest first.
void add_pairs(const DecomposeModel& model, const std::vector<ConcavePlace>& places, std::vector<HalfSpace>& planes) {
  struct Pair {
    double length = 0;
    std::size_t a = 0;
    std::size_t b = 0;
  };
  std::vector<Pair> pairs;
  for (std::size_t b = 1; b < places.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      if (std::abs(places[a].along.dot(places[b].along)) < kAlike) continue;
      pairs.push_back({(places[a].p - places[b].p).norm(), a, b});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& l, const Pair& r) { return l.length < r.length; });
  std::size_t kept = 0;
  for (const Pair& pair : pairs) {
    if (kept == kMostPairs) break;
    const ConcavePlace& a = places[pair.a];
    const ConcavePlace& b = places[pair.b];
    const Vec3 middle = 0.5 * (a.p + b.p);
    if (model.grid.at(middle) > -0.25 * model.grid.cell_m()) continue;  // along a groove, or through the air
    if (chord_depth(model.grid, a.p, b.p).depth_m > kExcessFrom * model.bound_m) continue;
    const Vec3 along = a.along.dot(b.along) < 0 ? Vec3(a.along - b.along) : Vec3(a.along + b.along);
    add_plane(middle, (b.p - a.p).cross(along), planes);
    ++kept;
  }
}

void add_axes(const PieceRegion& region, std::vector<HalfSpace>& planes) {
  const Vec3 middle = middle_of(region.points);
  std::vector<double> heights(region.points.size());
  for (const Vec3& axis : likely_axes(region.points)) {
    for (std::size_t i = 0; i < heights.size(); ++i)
      heights[i] = axis.dot(region.points[i]);
    std::sort(heights.begin(), heights.end());
    planes.push_back(HalfSpace::through(middle, axis));
    const double low = heights.front();
    const double high = heights.back();
    for (int q = 1; q < kQuantiles; ++q) {
      const auto at = heights.size() * static_cast<std::size_t>(q) / kQuantiles;
      planes.push_back({axis, heights[at]});
      planes.push_back({axis, low + (high - low) * q / kQuantiles});
    }
  }
}

/// Area of the solid on the plane, within the cell.
double cut_area(const DecomposeModel& model, const PieceRegion& region, const HalfSpace& plane) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : region.points)
    box.extend(p);
  const std::vector<Vec3> polygon = plane_section(plane, region.cell, box);
  const std::vector<Vec3> probes = lattice_on(polygon, plane.n, 0, kAreaProbes);
  if (probes.empty()) return 0;
  const auto inside = std::count_if(probes.begin(), probes.end(), [&](const Vec3& p) { return model.grid.at(p) < 0; });
  return polygon_area_m2(polygon) * static_cast<double>(inside) / static_cast<double>(probes.size());
}

double score(const DecomposeModel& model, const PieceRegion& region, const ExcessTable& table, const HalfSpace& plane,
             std::vector<std::uint16_t>& side) {
  const Parting parting = part(table, plane, side);
  const auto least = std::max(kLeastPoints, static_cast<std::size_t>(kLeastShare * static_cast<double>(table.size)));
  if (std::min(parting.within, parting.beyond) < least) return -1;
  std::uint16_t deepest[2] = {0, 0};
  for (std::size_t i = 0; i < table.size; ++i) {
    const auto row = region.chords.row(i);
    std::uint16_t& most = deepest[side[i] != 0 ? 1 : 0];
    for (std::size_t j = 0; j < i; ++j) {
      if (side[j] == side[i]) most = std::max(most, row[j]);
    }
  }
  const double all = std::max<double>(region.chords.deepest(), 1);
  const double share = static_cast<double>(parting.within) / static_cast<double>(table.size);
  const double depth_left = (share * deepest[1] + (1 - share) * deepest[0]) / all;
  const double bound = model.bound_m / region.chords.unit_m();
  const double done = (deepest[0] <= bound ? 0.5 : 0) + (deepest[1] <= bound ? 0.5 : 0);
  const double small_area = region.surface.area_m2() * std::min(share, 1 - share);
  const double price = small_area > 0 ? std::min(1.0, cut_area(model, region, plane) / small_area) : 1;
  return (1 - parting.left) + kWorthOfDepth * (1 - depth_left) + kWorthOfDone * done - kPriceOfArea * price;
}

std::vector<HalfSpace> candidates(const DecomposeModel& model, const PieceRegion& region,
                                  std::span<const ConcavePlace> all_places) {
  const std::vector<ConcavePlace> places = places_in(model, region, all_places);
  std::vector<HalfSpace> planes;
  add_pairs(model, places, planes);
  for (const ConcavePlace& place : places) {
    add_plane(place.p, place.across, planes);
    add_plane(place.p, place.face_a, planes);
    add_plane(place.p, place.face_b, planes);
  }
  add_axes(region, planes);
  return planes;
}

}  // namespace

std::optional<HalfSpace> best_cut(const DecomposeModel& model, const PieceRegion& region,
                                  std::span<const ConcavePlace> places) {
  if (region.points.size() < 2 * kLeastPoints) return std::nullopt;
  const std::vector<HalfSpace> planes = candidates(model, region, places);
  const ExcessTable rough(model, region, 1 + region.points.size() / kRatedPoints);
  std::vector<std::uint16_t> side;
  struct Rated {
    double left = 1;
    std::size_t plane = 0;
  };
  std::vector<Rated> rated;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Parting parting = part(rough, planes[i], side);
    if (parting.within > 0 && parting.beyond > 0) rated.push_back({parting.left, i});
  }
  std::stable_sort(rated.begin(), rated.end(), [](const Rated& a, const Rated& b) { return a.left < b.left; });
  if (rated.size() > kCutFinalists) rated.resize(kCutFinalists);

  const ExcessTable table(model, region, 1);
  double best = -1;
  std::optional<HalfSpace> cut;
  for (const Rated& finalist : rated) {
    const double value = score(model, region, table, planes[finalist.plane], side);
    if (value <= best) continue;
    best = value;
    cut = planes[finalist.plane];
  }
  return cut;
}

}  // namespace mechane::geometry
