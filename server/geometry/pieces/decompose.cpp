#include "server/geometry/pieces/decompose.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "server/base/parallel.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/pieces/concave_places.hpp"
#include "server/geometry/pieces/cut_tree.hpp"
#include "server/geometry/pieces/piece_merge.hpp"
#include "server/geometry/pieces/piece_region.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::geometry {
namespace {

constexpr double kLeastVolume = 1e-9;  // of the diagonal's cube
constexpr std::size_t kPiecePoints = 1200;
const char* const kWhere = "decomposition";

Expected<void> check_config(const DecomposeConfig& config) {
  const auto outside = [](const char* what, const char* remedy) {
    return fail(ErrorCode::invalid_value, what, kWhere, remedy);
  };
  if (!(config.max_concavity >= 0.001 && config.max_concavity <= 1))
    return outside("max_concavity is outside 0.001 to 1", "use 0.02, a fiftieth of the object's diagonal");
  if (config.max_parts < 1 || config.max_parts > 1000) return outside("max_parts is outside 1 to 1000", "use 48");
  if (config.grid_cells < 8 || config.grid_cells > 256) return outside("grid_cells is outside 8 to 256", "use 64");
  return {};
}

/// The mesh welded, without stray vertices. Whether it is closed is checked later.
Expected<Mesh> usable_mesh(const Mesh& mesh) {
  if (auto ok = check_mesh(mesh, kWhere); !ok) return tl::unexpected(ok.error());
  Mesh used;  // a stray vertex would widen the box
  {
    Mesh welded = weld(mesh);
    std::vector<std::uint32_t> new_index(welded.vertices.size(), 0xFFFFFFFFU);
    for (auto t : welded.triangles) {
      for (std::uint32_t& v : t) {
        if (new_index[v] == 0xFFFFFFFFU) {
          new_index[v] = static_cast<std::uint32_t>(used.vertices.size());
          used.vertices.push_back(welded.vertices[v]);
        }
        v = new_index[v];
      }
      used.triangles.push_back(t);
    }
  }
  if (used.triangles.empty() || !(surface_area_m2(used) > 0)) {
    return fail(ErrorCode::invalid_value, "no triangle of the mesh has an area", kWhere,
                "export the model with its faces");
  }
  return used;
}

Expected<void> check_closed(const Mesh& mesh) {
  const double volume = enclosed_volume_m3(mesh);
  const double least = kLeastVolume * std::pow(mesh.bounds().diagonal().norm(), 3);
  if (volume < -least)
    return fail(ErrorCode::invalid_value, "the mesh is inside out", kWhere,
                "turn its faces, so that their normals point outwards");
  if (volume < least)
    return fail(ErrorCode::invalid_value, "the mesh encloses no volume", kWhere, "give the sheet a thickness");
  return {};
}

Decomposition one_open_piece(const Mesh& mesh, const DecomposeConfig& config) {
  Piece piece;
  for (const SurfaceSample& sample : sample_by_area(mesh, kPiecePoints, config.seed))
    piece.surface_points.push_back(sample.p);
  piece.concavity_pct = 100;
  return {{std::move(piece)}, false};
}

Piece finished(const DecomposeModel& model, const PieceRegion& region) {
  Piece piece;
  piece.cell = without_redundant(region.cell, model.box);
  piece.surface_points = surface_points(model, region, kPiecePoints);
  const double spacing = std::sqrt(region.surface.area_m2() / static_cast<double>(kPiecePoints));
  piece.cut_points = cut_points(model, piece.cell, spacing, kPiecePoints);
  piece.concavity_pct = 100 * region.concavity_m / model.diagonal_m;
  piece.volume_m3 = region.volume_m3(model);
  return piece;
}

std::vector<PieceRegion> search(const DecomposeModel& model, const DecomposeConfig& config,
                                const std::function<void(double)>& heard) {
  CutTree tree(model);
  heard(0.1);
  // Joining may save a third of the pieces again: a gear's hub is cut into wedges at first.
  const std::size_t most = config.max_parts == 1 ? 1 : config.max_parts + config.max_parts / 2;
  tree.grow(find_concave_places(model.mesh, model.grid, model.seed), most,
            [&](double done) { heard(0.1 + 0.6 * done); });
  tree.replace_by_fans();
  heard(0.8);
  std::vector<PieceRegion> pieces = tree.leaves();
  std::size_t leaves = pieces.size();
  merge_pieces(model, pieces);
  while (pieces.size() > config.max_parts) {  // one leaf has one piece, so this ends
    leaves -= std::min(leaves - 1, pieces.size() - config.max_parts);
    tree.collapse(leaves);
    pieces = tree.leaves();
    leaves = pieces.size();
    merge_pieces(model, pieces);
  }
  heard(0.95);
  return pieces;
}

}  // namespace

Expected<Decomposition> decompose(const Mesh& mesh, const DecomposeConfig& config,
                                  const std::function<void(double share)>& progress) {
  if (auto ok = check_config(config); !ok) return tl::unexpected(ok.error());
  auto used = usable_mesh(mesh);
  if (!used) return tl::unexpected(used.error());
  double last = 0;
  const auto heard =
      [&](double share) {  // a new leaf that is not done lowers the share; a progress bar must not go back
        last = std::max(last, share);
        if (progress) progress(last);
      };
  const auto closed = check_closed(*used);
  if (!closed && open_edges(*used) > 0) {
    heard(1);
    return one_open_piece(*used, config);
  }
  if (!closed) return tl::unexpected(closed.error());

  const DecomposeModel model(std::move(*used), config.max_concavity, config.grid_cells, config.seed);
  const std::vector<PieceRegion> regions = search(model, config, heard);
  Decomposition result;
  result.pieces.resize(regions.size());
  for_each_index(regions.size(), [&](std::size_t i) { result.pieces[i] = finished(model, regions[i]); });
  result.met = std::all_of(regions.begin(), regions.end(),
                           [&](const PieceRegion& region) { return region.concavity_m <= model.bound_m; });
  heard(1);
  return result;
}

}  // namespace mechane::geometry
