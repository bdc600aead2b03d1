#include "server/geometry/pieces/piece_merge.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace mechane::geometry {
namespace {

constexpr double kExact = 1e-6;         // of the diagonal
constexpr double kCoreVoxel = 0.75;     // of a voxel that a piece must hold to count as its own
constexpr double kStraySurface = 1e-4;  // of a piece's area

/// Whether the piece reaches beyond the plane. Its extreme points are corners of its surface, or of its cuts inside the solid.
bool reaches_beyond(const DecomposeModel& model, const PieceRegion& piece, const HalfSpace& plane) {
  const double slack = kExact * model.diagonal_m;
  for (const Vec3& p : piece.points) {
    if (plane.excess(p) > slack) return true;
  }
  if (piece.surface.reach(plane.n) - plane.d > slack) return true;
  for (const HalfSpace& cut : piece.cell) {
    for (const Vec3& p : plane_section(cut, piece.cell, model.box)) {
      if (plane.excess(p) > slack && model.query.signed_distance(p) < slack) return true;
    }
  }
  return false;
}

std::vector<HalfSpace> shrunk(std::vector<HalfSpace> cell, double by_m) {
  for (HalfSpace& h : cell)
    h.d -= by_m;
  return cell;
}

/// Whether a cell holds some of a piece.
bool holds_some(const DecomposeModel& model, const std::vector<HalfSpace>& cell, const PieceRegion& piece) {
  const std::vector<HalfSpace> core = shrunk(cell, 10 * kExact * model.diagonal_m);
  for (const Vec3& p : piece.points) {
    if (cell_contains(core, p)) return true;
  }
  for (const Voxel& voxel : piece.voxels) {
    if (voxel.share > kCoreVoxel && cell_contains(cell, model.grid.position(voxel.node), -0.5 * model.grid.cell_m())) {
      return true;
    }
  }
  PieceSurface inside = piece.surface;
  for (const HalfSpace& h : core)
    inside = inside.split(h).first;
  return inside.area_m2() > kStraySurface * piece.surface.area_m2();
}

std::vector<Voxel> joined_voxels(const std::vector<Voxel>& a, const std::vector<Voxel>& b) {
  std::vector<Voxel> all = a;
  all.insert(all.end(), b.begin(), b.end());
  std::stable_sort(all.begin(), all.end(), [](const Voxel& l, const Voxel& r) { return l.node < r.node; });
  std::vector<Voxel> joined;
  for (const Voxel& voxel : all) {
    if (!joined.empty() && joined.back().node == voxel.node) {
      joined.back().share += voxel.share;
    } else {
      joined.push_back(voxel);
    }
  }
  return joined;
}

/// The union of pieces i and j, if it is a piece.
std::optional<PieceRegion> joined(const DecomposeModel& model, const std::vector<PieceRegion>& pieces, std::size_t i,
                                  std::size_t j) {
  const PieceRegion& a = pieces[i];
  const PieceRegion& b = pieces[j];
  std::vector<HalfSpace> cell;
  for (const auto& [mine, other] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    for (const HalfSpace& h : mine->cell) {
      if (!reaches_beyond(model, *other, h)) cell.push_back(h);
    }
  }
  cell = without_redundant(cell, model.box);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (k != i && k != j && holds_some(model, cell, pieces[k])) return std::nullopt;
  }
  PieceRegion both{
      std::move(cell), PieceSurface::joined(a.surface, b.surface), joined_voxels(a.voxels, b.voxels), {}, {}};
  measure(model, both);
  if (both.needs_cut(model)) return std::nullopt;
  return both;
}

}  // namespace

void merge_pieces(const DecomposeModel& model, std::vector<PieceRegion>& pieces) {
  std::vector<std::size_t> name(pieces.size());
  for (std::size_t i = 0; i < name.size(); ++i)
    name[i] = i;
  std::size_t next_name = pieces.size();
  // A union that now contains some of a third piece may be possible once that piece has been joined to another; so try again then.
  std::set<std::pair<std::size_t, std::size_t>> refused;
  for (std::size_t apart = 1; apart < pieces.size();) {
    bool found = false;
    for (std::size_t i = 0; i + apart < pieces.size() && !found; ++i) {
      const std::size_t j = i + apart;
      if (refused.contains({name[i], name[j]})) continue;
      auto both = joined(model, pieces, i, j);
      if (!both) {
        refused.insert({name[i], name[j]});
        continue;
      }
      pieces[i] = std::move(*both);
      name[i] = next_name++;
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
      name.erase(name.begin() + static_cast<std::ptrdiff_t>(j));
      found = true;
    }
    apart = found ? 1 : apart + 1;
  }
}

}  // namespace mechane::geometry
