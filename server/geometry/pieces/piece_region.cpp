#include "server/geometry/pieces/piece_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "server/geometry/mesh_check.hpp"

namespace mechane::geometry {
namespace {

constexpr double kUnits = 60000;  // of chord depth in a diagonal
constexpr std::size_t kRoughPoints = 120;
constexpr std::size_t kFinalPoints = 280;
constexpr std::size_t kWholePoints = 700;
constexpr double kCornerShare = 0.3;  // of the points are corners of triangles: tips that samples by area miss
constexpr double kCutShare = 0.2;     // as many points again are on the cuts
constexpr std::size_t kExactChords = 32;
constexpr double kCrumb = 0.02;  // of the voxels: a smaller body is not a lump
constexpr std::size_t kLeastLump = 8;
constexpr double kLumpDepth = 1.5;  // of the bound: what a chord between lumps counts at least
constexpr std::uint8_t kNoLump = 255;
constexpr double kAboveSurface = 1e-6;  // of the diagonal

/// Of the cube about p: how much lies in the half-space, as if its faces were parallel to the plane.
double share_within(const DistanceGrid& grid, const HalfSpace& plane, const Vec3& p) {
  return std::clamp(0.5 - plane.excess(p) / grid.cell_m(), 0.0, 1.0);
}

std::vector<OrientedPoint> exposed_only(const DecomposeModel& model, std::vector<OrientedPoint> points) {
  if (!model.grid.overlaps()) return points;
  std::erase_if(points, [&](const OrientedPoint& s) {
    return model.query.contains(s.p + kAboveSurface * model.diagonal_m * s.n);
  });
  return points;
}

/// The deepest of the deep chords, by the exact distance where the grid says they are deepest.
double exact_concavity(const DecomposeModel& model, const PieceRegion& region) {
  double most = 0;
  for (const auto& [i, j] : region.chords.deep_pairs(kExactChords)) {
    const ChordDepth chord = chord_depth(model.grid, region.points[i], region.points[j]);
    if (chord.depth_m <= 0) continue;
    most = std::max(most, model.query.signed_distance(chord.p));
  }
  return most;
}

/// The lump of each grid node, by flooding the region's voxels from face to face; crumbs are kNoLump. Returns the number of lumps.
int flood_lumps(const DecomposeModel& model, const PieceRegion& region, std::vector<std::uint8_t>& lump_of) {
  constexpr std::uint8_t kUnseen = 254;
  lump_of.assign(model.grid.nodes(), kNoLump);
  for (const Voxel& voxel : region.voxels) {
    if (voxel.share > 0) lump_of[voxel.node] = kUnseen;
  }
  const auto sx = static_cast<std::ptrdiff_t>(model.grid.size()[0]);
  const std::array<std::ptrdiff_t, 6> neighbours = {
      1, -1, sx, -sx, sx * model.grid.size()[1], -sx * model.grid.size()[1]};
  const std::size_t least =
      std::max(kLeastLump, static_cast<std::size_t>(kCrumb * static_cast<double>(region.voxels.size())));
  int lumps = 0;
  std::vector<std::uint32_t> body;
  for (const Voxel& seed : region.voxels) {
    if (lump_of[seed.node] != kUnseen || lumps > 100) continue;
    const auto mark = static_cast<std::uint8_t>(lumps);
    body.assign(1, seed.node);
    lump_of[seed.node] = mark;
    for (std::size_t k = 0; k < body.size(); ++k) {
      for (const std::ptrdiff_t step : neighbours) {  // the grid's margin holds no voxels, so no step leaves the grid
        const auto next = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(body[k]) + step);
        if (lump_of[next] != kUnseen) continue;
        lump_of[next] = mark;
        body.push_back(static_cast<std::uint32_t>(next));
      }
    }
    if (body.size() >= least) {
      ++lumps;
      continue;
    }
    for (const std::uint32_t node : body)
      lump_of[node] = kNoLump;
  }
  return std::max(lumps, 1);
}

std::uint8_t lump_near(const DecomposeModel& model, const std::vector<std::uint8_t>& lump_of, const Vec3& p) {
  std::uint8_t best = kNoLump;
  double least = 1e300;
  for (int n = 0; n < 27; ++n) {
    const Vec3 step = Eigen::Vector3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1).cast<double>();
    const std::size_t node = model.grid.nearest(p + model.grid.cell_m() * step);
    const double away = (model.grid.position(node) - p).squaredNorm();
    if (lump_of[node] == kNoLump || away >= least) continue;
    least = away;
    best = lump_of[node];
  }
  return best;
}

void part_lumps(const DecomposeModel& model, PieceRegion& region) {
  std::vector<std::uint8_t> lump_of;
  region.lumps = flood_lumps(model, region, lump_of);
  if (region.lumps < 2) return;
  std::vector<std::uint8_t> lumps;
  for (const Vec3& p : region.points)
    lumps.push_back(lump_near(model, lump_of, p));
  const auto units = static_cast<std::uint16_t>(std::min(kLumpDepth * model.bound_m / region.chords.unit_m(), 60000.0));
  bool parted = false;
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (lumps[i] == lumps[j] || lumps[i] == kNoLump || lumps[j] == kNoLump) continue;
      region.chords.raise(i, j, units);
      parted = true;
    }
  }
  if (!parted) region.lumps = 1;  // no surface of its own, so a cut could part nothing
}

void measure_with(const DecomposeModel& model, PieceRegion& region, std::size_t count) {
  region.points = surface_points(model, region, count);
  const auto share_of = [&](double share) { return static_cast<std::size_t>(share * static_cast<double>(count)); };
  for (const OrientedPoint& corner : exposed_only(model, region.surface.corners(share_of(kCornerShare))))
    region.points.push_back(corner.p);
  const double spacing = std::sqrt(region.surface.area_m2() / static_cast<double>(count));
  const std::vector<Vec3> cuts = cut_points(model, region.cell, spacing, 4 * count);
  const std::size_t stride = 1 + cuts.size() / share_of(kCutShare);
  for (std::size_t i = 0; i < cuts.size(); i += stride)
    region.points.push_back(cuts[i]);
  region.chords = ChordTable(model.grid, region.points, model.diagonal_m / kUnits);
  region.concavity_m = exact_concavity(model, region);
  part_lumps(model, region);
}

}  // namespace

DecomposeModel::DecomposeModel(Mesh welded, double max_concavity, int grid_cells, std::uint64_t seed_)
    : mesh(std::move(welded)),
      query(mesh, open_edges(mesh) == 0 ? Inside::by_rays : Inside::by_winding_number),
      grid(mesh, query, grid_cells),
      box(mesh.bounds()),
      diagonal_m(box.diagonal().norm()),
      bound_m(max_concavity * diagonal_m),
      seed(seed_) {
  if (grid.overlaps()) return;
  double voxels = 0;
  for (std::size_t node = 0; node < grid.nodes(); ++node)
    voxels += grid.inside_share(node);
  const double counted = voxels * std::pow(grid.cell_m(), 3);
  if (counted > 0) volume_scale = enclosed_volume_m3(mesh) / counted;
}

double PieceRegion::volume_m3(const DecomposeModel& model) const {
  double sum = 0;
  for (const Voxel& voxel : voxels)
    sum += static_cast<double>(voxel.share) * model.grid.inside_share(voxel.node);
  return sum * std::pow(model.grid.cell_m(), 3) * model.volume_scale;
}

PieceRegion whole_region(const DecomposeModel& model) {
  PieceRegion region{{}, PieceSurface(model.mesh), {}, {}, {}};
  for (std::size_t node = 0; node < model.grid.nodes(); ++node) {
    if (model.grid.inside_share(node) > 0) region.voxels.push_back({static_cast<std::uint32_t>(node), 1.0F});
  }
  return region;
}

std::pair<PieceRegion, PieceRegion> divide(const DecomposeModel& model, const PieceRegion& region,
                                           const HalfSpace& plane) {
  auto [within, beyond] = region.surface.split(plane);
  std::pair<PieceRegion, PieceRegion> sides{PieceRegion{region.cell, std::move(within), {}, {}, {}},
                                            PieceRegion{region.cell, std::move(beyond), {}, {}, {}}};
  sides.first.cell.push_back(plane);
  sides.second.cell.push_back(plane.flipped());
  for (const Voxel& voxel : region.voxels) {
    const auto share = static_cast<float>(share_within(model.grid, plane, model.grid.position(voxel.node)));
    if (share > 0) sides.first.voxels.push_back({voxel.node, voxel.share * share});
    if (share < 1) sides.second.voxels.push_back({voxel.node, voxel.share * (1 - share)});
  }
  return sides;
}

PieceRegion confined(const DecomposeModel& model, const PieceRegion& region, std::span<const HalfSpace> more) {
  PieceRegion left{region.cell, region.surface, region.voxels, {}, {}};
  for (const HalfSpace& plane : more)
    left = divide(model, left, plane).first;
  return left;
}

void measure(const DecomposeModel& model, PieceRegion& region) {
  if (region.cell.empty()) return measure_with(model, region, kWholePoints);
  measure_with(model, region, kRoughPoints);
  if (!region.needs_cut(model)) measure_with(model, region, kFinalPoints);
}

std::vector<Vec3> surface_points(const DecomposeModel& model, const PieceRegion& region, std::size_t count) {
  std::vector<Vec3> points;
  for (const OrientedPoint& s : exposed_only(model, region.surface.sample(count, model.seed)))
    points.push_back(s.p);
  return points;
}

std::vector<Vec3> cut_points(const DecomposeModel& model, std::span<const HalfSpace> cell, double spacing_m,
                             std::size_t most) {
  const double unsure = 0.5 * model.grid.cell_m();
  std::vector<Vec3> points;
  for (const HalfSpace& plane : cell) {
    for (const Vec3& p : lattice_on(plane_section(plane, cell, model.box), plane.n, spacing_m, most)) {
      const double d = model.grid.at(p);
      // Beside edges the grid is off by a third of a cell.
      if (d > unsure || (d > -unsure && !model.query.contains(p))) continue;
      points.push_back(p);
    }
  }
  return points;
}

}  // namespace mechane::geometry
