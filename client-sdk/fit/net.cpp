#include "client-sdk/fit/net.hpp"

#include <algorithm>
#include <cmath>

#include "server/geometry/superquadric_mesh.hpp"

namespace mechane::fit {
namespace {

constexpr int kShellCells = 20;  // along an edge of the cube
constexpr int kFewCells = 10;    // for many small parts
constexpr std::size_t kManyParts = 60;
constexpr int kLinesPerFace = 4;  // of the cube, each way
constexpr int kPointsPerLine = 48;
constexpr double kLineRadius = 1.3;  // pixels of the buffer
constexpr double kLift = 2.5;        // pixels towards the viewer, so that a line is not hidden by its own surface

class Pen {
 public:
  Pen(const DepthBuffer& glass, const DepthBuffer& solid) : glass_(glass), solid_(solid) {
    ink_.assign(glass.z.size(), DepthBuffer::kNothing);
  }

  void line(const Vec3& from, const Vec3& to, std::uint32_t part) {
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).head<2>().cwiseAbs().maxCoeff())));
    for (int i = 0; i <= steps; ++i)
      dot(from + (to - from) * i / steps, part);
  }

  [[nodiscard]] std::vector<std::uint32_t> ink() && { return std::move(ink_); }

 private:
  void dot(const Vec3& p, std::uint32_t part) {
    const int reach = static_cast<int>(std::ceil(kLineRadius));
    const int cx = static_cast<int>(std::floor(p.x()));
    const int cy = static_cast<int>(std::floor(p.y()));
    for (int y = std::max(cy - reach, 0); y <= std::min(cy + reach, glass_.height - 1); ++y) {
      for (int x = std::max(cx - reach, 0); x <= std::min(cx + reach, glass_.width - 1); ++x) {
        if (std::hypot(x + 0.5 - p.x(), y + 0.5 - p.y()) > kLineRadius) continue;
        const std::size_t at = static_cast<std::size_t>(y) * glass_.width + x;
        if (p.z() + kLift >= std::max(glass_.z[at], solid_.z[at])) ink_[at] = part;
      }
    }
  }

  const DepthBuffer& glass_;
  const DepthBuffer& solid_;
  std::vector<std::uint32_t> ink_;
};

/// Lines of one coordinate on the six faces of the cube; the edges belong to two faces and are drawn twice.
template <class Line>
void for_each_line(const Line& line) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      for (int along = 1; along <= 2; ++along) {
        for (int i = 0; i <= kLinesPerFace; ++i) {
          Vec3 d;
          d[axis] = side;
          d[(axis + 3 - along) % 3] = -1 + 2.0 * i / kLinesPerFace;
          line(d, (axis + along) % 3);
        }
      }
    }
  }
}

}  // namespace

Vec3 surface_at(const geometry::Superquadric& shape, const Vec3& d) {
  geometry::Superquadric plain = shape;
  plain.taper_x = plain.taper_y = plain.bend_per_m = 0;
  const Vec3 direction = d.cwiseProduct(shape.a);
  const Vec3 p = direction / geometry::radial_form(plain, direction);
  return geometry::is_deformed(shape) ? geometry::deform(shape, p) : p;
}

Shells make_shells(const collision::Object& object) {
  Shells shells;
  const int cells = object.parts.size() > kManyParts ? kFewCells : kShellCells;
  for (std::uint32_t i = 0; i < object.parts.size(); ++i) {
    const geometry::Mesh mesh = geometry::tessellate(object.parts[i].superquadric, cells);
    const auto base = static_cast<std::uint32_t>(shells.mesh.vertices.size());
    for (const Vec3& v : mesh.vertices)
      shells.mesh.vertices.push_back(object.parts[i].X_OQ * v);
    for (const auto& t : mesh.triangles)
      shells.mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    shells.part_of_triangle.resize(shells.mesh.triangles.size(), i);
  }
  return shells;
}

std::vector<std::uint32_t> draw_net(const collision::Object& object, const View& view, const DepthBuffer& glass,
                                    const DepthBuffer& solid) {
  Pen pen(glass, solid);
  for (std::uint32_t i = 0; i < object.parts.size(); ++i) {
    const collision::Part& part = object.parts[i];
    for_each_line([&](Vec3 d, int along) {
      Vec3 before;
      for (int k = 0; k <= kPointsPerLine; ++k) {
        d[along] = -1 + 2.0 * k / kPointsPerLine;
        const Vec3 here = view.to_screen(part.X_OQ * surface_at(part.superquadric, d));
        if (k > 0) pen.line(before, here, i);
        before = here;
      }
    });
  }
  return std::move(pen).ink();
}

}  // namespace mechane::fit
