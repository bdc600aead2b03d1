// Any mesh as the surface of a solid: holes closed, pieces that overlap made one, sheets given a thickness.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/geometry/mesh.hpp"

namespace mechane::geometry {

/// What an author says of a mesh's inside.
enum class SolidKind {
  automatic,  ///< each shell is closed where it encloses something, else it is a sheet
  closed,     ///< holes are closed, however flat the mesh is
  sheet,      ///< every surface is a sheet, even that of a closed box
};

struct SolidChoice {
  SolidKind kind = SolidKind::automatic;
  double thickness_m = 0.001;  ///< of sheets

  friend bool operator==(const SolidChoice&, const SolidChoice&) = default;
};

inline constexpr double kLeastSheet_m = 1e-4;
inline constexpr double kMostSheet_m = 0.1;

/// What authors write: "auto", "closed", "sheet" or "sheet 0.002", in metres. None: it is nothing of these, or too thin or too thick.
[[nodiscard]] std::optional<SolidChoice> solid_choice_of(std::string_view text);
[[nodiscard]] std::string text_of(const SolidChoice& choice);

/// Where a triangle of the solid's surface comes from.
enum class SurfaceOrigin : std::uint8_t { mesh, membrane, sheet };

struct SolidMesh {
  Mesh mesh;  ///< where triangles were cut or holes closed, cracks of some thousandths of the diagonal remain
  std::vector<SurfaceOrigin> origin;  ///< of each triangle
  std::size_t open_edges = 0;         ///< of the mesh as given
  std::size_t turned = 0;             ///< triangles that faced inwards
  std::size_t doubled = 0;            ///< triangles that stood on another one's back
  double hidden_area_m2 = 0;          ///< of the mesh, left out: inner walls of pieces that overlap
  double membrane_area_m2 = 0;        ///< that was put over holes
  double sheet_area_m2 = 0;           ///< of the mesh, that was made a sheet
};

/// The surface where the mesh's generalized winding number passes one half, outer sides outwards. Triangles of the mesh that border on air
/// on one side stay as they are; others are cut there, to a thousandth of the diagonal, and what lies inside is left out; holes are closed
/// by membranes. Before that, triangles that are turned against their neighbours or inwards are turned, and of triangles that stand back to
/// back one is left. An empty mesh: it encloses nothing. The mesh must be welded and have an area. Same mesh and choice: same result, to
/// the bit. Uses all cores; seconds for a hundred thousand triangles.
[[nodiscard]] SolidMesh make_solid(const Mesh& welded, const SolidChoice& choice);

}  // namespace mechane::geometry
