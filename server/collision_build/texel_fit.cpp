#include "server/collision_build/texel_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Dense>

namespace mechane::collision_build {
namespace {

constexpr int kIterations = 12;  // of conjugate gradients: more would change nothing in the 16 bits of a texel

/// Bilinear interpolation from N x N texels to n x n rays, and its transpose.
class Spread {
 public:
  explicit Spread(int resolution)
      : per_cell_(rays_per_cell(resolution)), texels_(resolution), rays_((resolution - 1) * per_cell_ + 1) {}

  [[nodiscard]] int rays() const { return rays_; }

  [[nodiscard]] Eigen::MatrixXf up(const Eigen::MatrixXf& texels) const {
    Eigen::MatrixXf rays(rays_, rays_);
    for (int j = 0; j < rays_; ++j)
      for (int i = 0; i < rays_; ++i) {
        const auto [u, s] = place(i);
        const auto [v, t] = place(j);
        rays(i, j) = (1 - t) * ((1 - s) * texels(u, v) + s * texels(u + 1, v)) +
                     t * ((1 - s) * texels(u, v + 1) + s * texels(u + 1, v + 1));
      }
    return rays;
  }
  [[nodiscard]] Eigen::MatrixXf down(const Eigen::MatrixXf& rays) const {
    Eigen::MatrixXf texels = Eigen::MatrixXf::Zero(texels_, texels_);
    for (int j = 0; j < rays_; ++j)
      for (int i = 0; i < rays_; ++i) {
        const auto [u, s] = place(i);
        const auto [v, t] = place(j);
        texels(u, v) += (1 - t) * (1 - s) * rays(i, j);
        texels(u + 1, v) += (1 - t) * s * rays(i, j);
        texels(u, v + 1) += t * (1 - s) * rays(i, j);
        texels(u + 1, v + 1) += t * s * rays(i, j);
      }
    return texels;
  }
  /// The rays around a texel: first and last along one axis.
  [[nodiscard]] std::array<int, 2> around(int texel) const {
    return {std::max(0, (texel - 1) * per_cell_), std::min(rays_ - 1, (texel + 1) * per_cell_)};
  }
  [[nodiscard]] int center(int texel) const { return texel * per_cell_; }

 private:
  struct Place {
    int texel;
    float share;
  };
  [[nodiscard]] Place place(int ray) const {
    const int texel = std::min(ray / per_cell_, texels_ - 2);
    return {texel, static_cast<float>(ray - texel * per_cell_) / static_cast<float>(per_cell_)};
  }

  int per_cell_, texels_, rays_;
};

void keep_within(const Spread& spread, const Eigen::MatrixXf& sigma, Eigen::MatrixXf& texels) {
  for (int v = 0; v < texels.cols(); ++v)
    for (int u = 0; u < texels.rows(); ++u) {
      const auto [u0, u1] = spread.around(u);
      const auto [v0, v1] = spread.around(v);
      const auto near = sigma.block(u0, v0, u1 - u0 + 1, v1 - v0 + 1);
      texels(u, v) = std::clamp(texels(u, v), near.minCoeff(), near.maxCoeff());
    }
}

}  // namespace

std::vector<float> fit_texels(int resolution, std::span<const float> sigma) {
  const Spread spread(resolution);
  const Eigen::MatrixXf wanted = Eigen::Map<const Eigen::MatrixXf>(sigma.data(), spread.rays(), spread.rays());
  Eigen::MatrixXf texels(resolution, resolution);
  for (int v = 0; v < resolution; ++v)
    for (int u = 0; u < resolution; ++u)
      texels(u, v) = wanted(spread.center(u), spread.center(v));
  // The surface lies at rho = 1/sigma: an error of sigma moves it by that over sigma squared.
  const Eigen::MatrixXf weight = wanted.array().square().square().max(1e-6F).inverse().matrix();
  Eigen::MatrixXf left = spread.down(weight.cwiseProduct(wanted - spread.up(texels)));
  Eigen::MatrixXf way = left;
  float square = left.squaredNorm();
  const float enough = 1e-10F * spread.down(weight.cwiseProduct(wanted)).squaredNorm();
  for (int i = 0; i < kIterations && square > enough; ++i) {
    const Eigen::MatrixXf turned = spread.down(weight.cwiseProduct(spread.up(way)));
    const float step = square / std::max(way.cwiseProduct(turned).sum(), 1e-30F);
    texels += step * way;
    left -= step * turned;
    const float next = left.squaredNorm();
    way = left + (next / square) * way;
    square = next;
  }
  keep_within(spread, wanted, texels);
  return {texels.data(), texels.data() + texels.size()};
}

void join_faces(int resolution, std::span<float> texels) {
  std::map<std::array<int, 3>, std::vector<std::size_t>> shared;
  const int last = resolution - 1;
  for (int face = 0; face < 6; ++face) {
    for (int v = 0; v <= last; ++v) {
      for (int u = 0; u <= last; ++u) {
        if (u > 0 && u < last && v > 0 && v < last) continue;
        const auto axis = static_cast<std::size_t>(face / 2);
        std::array<int, 3> at{};
        at[axis] = face % 2 == 0 ? last : -last;
        at[(axis + 1) % 3] = 2 * u - last;
        at[(axis + 2) % 3] = 2 * v - last;
        shared[at].push_back(static_cast<std::size_t>((face * resolution + v) * resolution + u));
      }
    }
  }
  for (const auto& [at, same] : shared) {
    float mean = 0;
    for (const std::size_t i : same)
      mean += texels[i] / static_cast<float>(same.size());
    for (const std::size_t i : same)
      texels[i] = mean;
  }
}

}  // namespace mechane::collision_build
