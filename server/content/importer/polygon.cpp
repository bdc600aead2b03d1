#include "server/content/importer/polygon.hpp"

#include <algorithm>

namespace mechane::content {
namespace {

using Flat = Eigen::Vector2d;
using Triangle = std::array<std::uint32_t, 3>;

/// Above 0 where a, b, c turn to the left.
double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// The polygon seen from the side to which its normal points most.
std::vector<Flat> flattened(std::span<const Vec3> ring, const Vec3& normal) {
  Eigen::Index out = 0;
  normal.cwiseAbs().maxCoeff(&out);
  const Eigen::Index u = (out + 1) % 3, v = (out + 2) % 3;
  const double side = normal[out] < 0 ? -1 : 1;
  std::vector<Flat> flat;
  for (const Vec3& p : ring)
    flat.emplace_back(p[u], side * p[v]);
  return flat;
}

/// The corners that are left, in a circle.
class Ring {
 public:
  explicit Ring(std::vector<Flat> points) : points_(std::move(points)) {
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      left_.push_back(i);
  }
  [[nodiscard]] std::size_t size() const { return left_.size(); }
  [[nodiscard]] std::uint32_t at(std::size_t i) const { return left_[i % left_.size()]; }
  [[nodiscard]] Triangle ear(std::size_t i) const { return {at(i + left_.size() - 1), at(i), at(i + 1)}; }
  void cut(std::size_t i) { left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i % left_.size())); }

  [[nodiscard]] bool is_convex(std::size_t i) const {
    const Triangle t = ear(i);
    return turn(points_[t[0]], points_[t[1]], points_[t[2]]) > 0;
  }
  /// A convex corner whose triangle holds no other corner. Only corners that are not convex can lie in it.
  [[nodiscard]] bool is_ear(std::size_t i) const {
    if (!is_convex(i)) return false;
    const Triangle t = ear(i);
    for (std::size_t k = i + 2; k + 1 < i + left_.size(); ++k) {
      const Flat& p = points_[at(k)];
      const auto same = [&](std::uint32_t corner) { return points_[corner] == p; };
      if (std::any_of(t.begin(), t.end(), same) || is_convex(k % left_.size())) continue;
      bool inside = true;
      for (std::size_t e = 0; e < 3; ++e)
        inside = inside && turn(points_[t[e]], points_[t[(e + 1) % 3]], p) >= 0;
      if (inside) return false;
    }
    return true;
  }

 private:
  std::vector<Flat> points_;
  std::vector<std::uint32_t> left_;
};

}  // namespace

Vec3 area_vector(std::span<const Vec3> ring) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += (ring[i] - ring[0]).cross(ring[i + 1] - ring[0]);
  return sum;
}

std::vector<Triangle> triangulate(std::span<const Vec3> ring) {
  const Vec3 normal = area_vector(ring);
  if (ring.size() < 3 || !(normal.norm() > 0)) return {};
  if (ring.size() == 3) return {{0, 1, 2}};
  std::vector<Triangle> triangles;
  Ring left(flattened(ring, normal));
  std::size_t i = 0;
  while (left.size() > 3) {
    std::size_t tried = 0;
    while (tried < left.size() && !left.is_ear(i)) {
      i = (i + 1) % left.size();
      ++tried;
    }
    // A polygon that crosses itself may have no ear: any corner then takes its place.
    triangles.push_back(left.ear(i));
    left.cut(i);
    i %= left.size();
  }
  triangles.push_back({left.at(0), left.at(1), left.at(2)});
  return triangles;
}

}  // namespace mechane::content
