#include "server/geometry/solid/outer_surface.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "server/base/parallel.hpp"

namespace mechane::geometry {
namespace {

// All as shares of the diagonal.
constexpr double kBefore = 1e-6;
constexpr double kAskedApart = 1.0 / 48;
constexpr double kFlat = 1.0 / 200;  // of a triangle with edges below this, the middle speaks for all
constexpr double kCut = 1.0 / 1000;
constexpr double kInset = 0.1;  // from a corner, at which a triangle is asked
constexpr std::size_t kTrianglesTogether = 64;
constexpr double kFaint = 0.01;  // a flat sheet has a winding number of one half on its back, and encloses nothing

using Corners = std::array<Vec3, 3>;

/// Sorts the pieces of one triangle.
class Sorter {
 public:
  Sorter(const MeshQuery& query, const Vec3& n, double diagonal_m, std::vector<Corners>& outer, std::vector<Vec3>& cuts)
      : query_(query), n_(n), diagonal_m_(diagonal_m), outer_(outer), cuts_(cuts) {}

  /// Whether all of it is outer, or none; where both are found, the outer pieces have been put out.
  std::optional<bool> sort(const Corners& t) {
    const std::size_t k = longest(t);
    const double length = (t[(k + 1) % 3] - t[k]).norm() / diagonal_m_;
    if (length <= kAskedApart) {
      const std::optional<bool> all = ask(t, length <= kFlat);
      if (all || length <= kCut) return all ? all : is_outer((t[0] + t[1] + t[2]) / 3);
    }
    const Vec3 middle = 0.5 * (t[k] + t[(k + 1) % 3]);
    Corners a = t;
    Corners b = t;
    a[(k + 1) % 3] = middle;
    b[k] = middle;
    const std::optional<bool> first = sort(a);
    const std::optional<bool> second = sort(b);
    if (first && second && *first == *second) return first;
    if (first && *first) outer_.push_back(a);
    if (second && *second) outer_.push_back(b);
    if (first && second) cuts_.push_back(middle);
    return std::nullopt;
  }

 private:
  static std::size_t longest(const Corners& t) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if ((t[(k + 1) % 3] - t[k]).squaredNorm() > (t[(best + 1) % 3] - t[best]).squaredNorm()) best = k;
    }
    return best;
  }

  [[nodiscard]] bool is_outer(const Vec3& p) const {
    const double before = winding_before(query_, p, n_, diagonal_m_);
    return before < 0.5 && before + 1 > 0.5 + kFaint;
  }

  /// The common answer at the middle and near the corners, if there is one.
  [[nodiscard]] std::optional<bool> ask(const Corners& t, bool middle_alone) const {
    const Vec3 middle = (t[0] + t[1] + t[2]) / 3;
    const bool outer = is_outer(middle);
    if (middle_alone) return outer;
    for (const Vec3& corner : t) {
      if (is_outer(kInset * middle + (1 - kInset) * corner) != outer) return std::nullopt;
    }
    return outer;
  }

  const MeshQuery& query_;
  Vec3 n_;
  double diagonal_m_;
  std::vector<Corners>& outer_;
  std::vector<Vec3>& cuts_;
};

}  // namespace

double winding_before(const MeshQuery& query, const Vec3& p, const Vec3& n, double diagonal_m) {
  return query.winding_number(p + kBefore * diagonal_m * n);
}

OuterSurface outer_surface(const Mesh& mesh, const MeshQuery& query) {
  const std::size_t count = mesh.triangles.size();
  const double diagonal_m = mesh.bounds().diagonal().norm();
  OuterSurface surface;
  surface.pieces.resize(count);
  std::vector<std::vector<Vec3>> cuts(count);
  std::vector<std::uint8_t> whole(count);
  for_each_index((count + kTrianglesTogether - 1) / kTrianglesTogether, [&](std::size_t chunk) {
    for (std::size_t i = kTrianglesTogether * chunk; i < std::min(count, kTrianglesTogether * (chunk + 1)); ++i) {
      const auto& v = mesh.triangles[i];
      const Corners t = {mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]};
      const Vec3 n = query.triangle_normal(static_cast<std::uint32_t>(i));
      const std::optional<bool> all = Sorter(query, n, diagonal_m, surface.pieces[i], cuts[i]).sort(t);
      whole[i] = all && *all ? 1 : 0;
      if (whole[i] != 0) surface.pieces[i] = {t};
    }
  });
  for (std::size_t i = 0; i < count; ++i) {
    surface.whole.push_back(whole[i] != 0);
    surface.cuts.insert(surface.cuts.end(), cuts[i].begin(), cuts[i].end());
  }
  return surface;
}

}  // namespace mechane::geometry
