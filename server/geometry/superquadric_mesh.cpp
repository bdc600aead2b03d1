#include "server/geometry/superquadric_mesh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mechane::geometry {

Mesh tessellate(const Superquadric& shape, int cells) {
  Superquadric plain = shape;
  plain.taper_x = plain.taper_y = plain.bend_per_m = 0;
  Mesh mesh;
  // Integer coordinates on the cube [-cells, cells]^3, in steps of 2, name a vertex that faces share.
  constexpr std::uint32_t kNew = ~std::uint32_t{0};
  const auto edge = static_cast<std::size_t>(cells) + 1;
  std::vector<std::uint32_t> index_of(edge * edge * edge, kNew);
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto along = [&](int i) { return static_cast<std::size_t>(at[i] + cells) / 2; };
    std::uint32_t& index = index_of[(along(0) * edge + along(1)) * edge + along(2)];
    if (index == kNew) {
      index = static_cast<std::uint32_t>(mesh.vertices.size());
      const Vec3 direction = Vec3(at[0], at[1], at[2]).cwiseProduct(shape.a) / cells;
      const Vec3 p = direction / radial_form(plain, direction);
      mesh.vertices.push_back(is_deformed(shape) ? deform(shape, p) : p);
    }
    return index;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = -1; side <= 1; side += 2) {
      for (int cell = 0; cell < cells * cells; ++cell) {
        const int u = -cells + 2 * (cell % cells);
        const int v = -cells + 2 * (cell / cells);
        const auto corner = [&](int du, int dv) {
          std::array<int, 3> at{};
          at[axis] = side * cells;
          at[(axis + 1) % 3] = u + du;
          at[(axis + 2) % 3] = v + dv;
          return vertex(at);
        };
        const std::uint32_t a = corner(0, 0);
        const std::uint32_t b = side > 0 ? corner(2, 0) : corner(0, 2);
        const std::uint32_t c = corner(2, 2);
        const std::uint32_t d = side > 0 ? corner(0, 2) : corner(2, 0);
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
    }
  }
  return mesh;
}

}  // namespace mechane::geometry
