// Texels that are fitted to the whole of their cells, not only to the rays through their own centres.
#pragma once

#include <span>
#include <vector>

namespace mechane::collision_build {

/// How many rays are cast along a cell's edge: fewer for fine maps, whose cells show little between their corners.
[[nodiscard]] constexpr int rays_per_cell(int resolution) {
  return resolution <= 16 ? 3 : resolution <= 32 ? 2 : 1;
}

/// The texels of one face, u fastest, whose bilinear interpolation fits `sigma` best, by least squares over the surface's
/// place: values at n n points, n = (resolution - 1) rays_per_cell + 1, of which every rays_per_cell-th is a texel's centre. A
/// texel that holds its centre's value alone cuts off every crest that runs between centres. Each texel stays within the values
/// around it, so that a step in the surface makes no ripples.
[[nodiscard]] std::vector<float> fit_texels(int resolution, std::span<const float> sigma);

/// Texels of two or three faces that lie on a common edge of the cube get their mean: no step from face to face.
void join_faces(int resolution, std::span<float> texels);

}  // namespace mechane::collision_build
