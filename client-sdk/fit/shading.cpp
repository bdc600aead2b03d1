#include "client-sdk/fit/shading.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/parallel.hpp"

namespace mechane::fit {
namespace {

constexpr double kCrease_rad = 40 * kPi / 180;
constexpr float kAmbient = 0.42F;
constexpr float kSky = 0.10F;
constexpr float kLamp = 0.52F;
constexpr float kHollow = 0.45F;        // how dark the deepest hollow gets
constexpr double kHollowShare = 0.035;  // its width, of the picture's larger side
constexpr float kOutline = 0.42F;
constexpr int kLinePixels = 2;
constexpr double kStepShare = 0.02;  // a step in depth that counts as an outline

Vec3f lamp_direction_V() {
  return Vec3f(-0.45F, 0.65F, 0.62F).normalized();
}

double larger_side(const DepthBuffer& buffer) {
  return std::max(buffer.width, buffer.height);
}

/// Barycentric weights of a point of a triangle's plane.
Vec3 weights_of(const geometry::Mesh& mesh, std::uint32_t triangle, const Vec3& p) {
  const auto& v = mesh.triangles[triangle];
  const Vec3& a = mesh.vertices[v[0]];
  const Vec3 ab = mesh.vertices[v[1]] - a;
  const Vec3 ac = mesh.vertices[v[2]] - a;
  const Vec3 n = ab.cross(ac);
  const double area = std::max(n.squaredNorm(), 1e-300);
  const double w1 = (p - a).cross(ac).dot(n) / area;
  const double w2 = ab.cross(p - a).dot(n) / area;
  return {1 - w1 - w2, w1, w2};
}

/// Sums over rectangles in constant time (Crow 1984), of depths and of covered pixels.
class AreaSums {
 public:
  explicit AreaSums(const DepthBuffer& buffer) : width_(buffer.width + 1), height_(buffer.height + 1) {
    z_.assign(static_cast<std::size_t>(width_) * height_, 0);
    count_ = z_;
    for (int y = 1; y < height_; ++y) {
      for (int x = 1; x < width_; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y - 1) * buffer.width + (x - 1);
        const bool covered = buffer.covered(pixel);
        z_[at(x, y)] = (covered ? buffer.z[pixel] : 0) + z_[at(x - 1, y)] + z_[at(x, y - 1)] - z_[at(x - 1, y - 1)];
        count_[at(x, y)] = (covered ? 1 : 0) + count_[at(x - 1, y)] + count_[at(x, y - 1)] - count_[at(x - 1, y - 1)];
      }
    }
  }

  /// Mean depth of the covered pixels within `radius` of (x, y), which itself must be covered.
  [[nodiscard]] double mean(int x, int y, int radius) const {
    const int left = std::max(x - radius, 0);
    const int top = std::max(y - radius, 0);
    const int right = std::min(x + radius + 1, width_ - 1);
    const int bottom = std::min(y + radius + 1, height_ - 1);
    const auto sum = [&](const std::vector<double>& s) {
      return s[at(right, bottom)] - s[at(left, bottom)] - s[at(right, top)] + s[at(left, top)];
    };
    return sum(z_) / sum(count_);
  }

 private:
  [[nodiscard]] std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  int width_;
  int height_;
  std::vector<double> z_;
  std::vector<double> count_;
};

/// Whether this pixel is on an outline: next to it is nothing, or something far behind it.
bool on_outline(const DepthBuffer& buffer, int x, int y) {
  const float z = buffer.z[static_cast<std::size_t>(y) * buffer.width + x];
  const auto step = static_cast<float>(kStepShare * larger_side(buffer));
  constexpr int kAround[4][2] = {{-kLinePixels, 0}, {kLinePixels, 0}, {0, -kLinePixels}, {0, kLinePixels}};
  return std::any_of(std::begin(kAround), std::end(kAround), [&](const auto& offset) {
    const int nx = std::clamp(x + offset[0], 0, buffer.width - 1);
    const int ny = std::clamp(y + offset[1], 0, buffer.height - 1);
    return buffer.z[static_cast<std::size_t>(ny) * buffer.width + nx] < z - step;
  });
}

}  // namespace

std::vector<float> light_of(const DepthBuffer& buffer, const geometry::Mesh& mesh, const View& view) {
  const auto normals = corner_normals(mesh, kCrease_rad);
  const AreaSums sums(buffer);
  const int radius = std::max(2, static_cast<int>(kHollowShare * larger_side(buffer)));
  const Vec3f lamp_O = view.R_VO.transpose().cast<float>() * lamp_direction_V();
  const Vec3f viewer_O = view.R_VO.row(2).transpose().cast<float>();
  std::vector<float> light(buffer.z.size(), 0);
  for_each_index(static_cast<std::size_t>(buffer.height), [&](std::size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < buffer.width; ++x) {
      const std::size_t pixel = row * static_cast<std::size_t>(buffer.width) + static_cast<std::size_t>(x);
      if (!buffer.covered(pixel)) continue;
      const std::uint32_t triangle = buffer.triangle[pixel];
      const Vec3f w = weights_of(mesh, triangle, view.to_object({x + 0.5, y + 0.5, buffer.z[pixel]})).cast<float>();
      Vec3f n = (w[0] * normals[triangle][0] + w[1] * normals[triangle][1] + w[2] * normals[triangle][2]).normalized();
      if (n.dot(viewer_O) < 0) n = -n;  // the back of an open or inverted mesh
      const auto hollow = static_cast<float>((sums.mean(x, y, radius) - buffer.z[pixel]) / radius);
      const float shade = kAmbient + kSky * n.y() + kLamp * std::max(0.0F, n.dot(lamp_O));
      light[pixel] = shade * (1 - kHollow * std::clamp(hollow, 0.0F, 1.0F)) * (on_outline(buffer, x, y) ? kOutline : 1);
    }
  });
  return light;
}

}  // namespace mechane::fit
