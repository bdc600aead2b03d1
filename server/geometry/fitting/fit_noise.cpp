#include "server/geometry/fitting/fit_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "server/base/random.hpp"

namespace mechane::geometry {
namespace {

constexpr double kLeastScale = 3e-4;  // of the diagonal
constexpr double kWithin = 0.7;       // of the points, at least, are not outliers
constexpr double kGaussian = 0.9648;  // standard deviation over this quantile of the unsigned distances
constexpr int kCells = 9;             // along an edge of the cube that carries the simulated points
constexpr int kStrayCells = 6;
constexpr double kFarOff = 10;          // of the diagonal: a greater distance counts the same
constexpr std::size_t kNeighbours = 7;  // the distance of the last of them tells how dense the points are
constexpr double kLonely = 1.8;         // times as far to that neighbour as for most
constexpr int kRounds = 6;
constexpr double kSettled = 4e-4;  // of the diagonal: how far the surface moves in the last round
constexpr double kMostNoise = 0.1;

/// Pairs of opposite Gaussian vectors: their mean is 0, so that only effects that are not linear in the noise are left.
std::vector<Vec3> opposite_noise(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> noise(count);
  for (std::size_t i = 0; i + 1 < count; i += 2) {
    for (double& n : noise[i])
      n = std::sqrt(-2 * std::log(1 - random.unit())) * std::cos(2 * kPi * random.unit());
    noise[i + 1] = -noise[i];
  }
  return noise;
}

}  // namespace

double spread_of(std::span<const double> distances) {
  if (distances.empty()) return kLeastScale;
  std::vector<double> off(distances.begin(), distances.end());
  for (double& d : off)
    d = std::abs(d);
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(kWithin * static_cast<double>(off.size()));
  std::nth_element(off.begin(), middle, off.end());
  return std::max(kLeastScale, kGaussian * *middle);
}

OwnSurface own_surface(const FitState& state, int cells) {
  const Superquadric shape = state.shape();
  Superquadric plain = shape;
  plain.taper_x = plain.taper_y = plain.bend_per_m = 0;
  const auto at = [&](int axis, double side, double u, double v) {
    Vec3 direction;
    direction[axis] = side;
    direction[(axis + 1) % 3] = u;
    direction[(axis + 2) % 3] = v;
    direction = direction.cwiseProduct(shape.a);
    return deform(shape, direction / radial_form(plain, direction));
  };
  const auto line = [cells](double cell) { return 2 * cell / cells - 1; };
  OwnSurface surface;
  std::vector<Vec3> corners(static_cast<std::size_t>((cells + 1) * (cells + 1)));
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double side = face % 2 == 0 ? 1 : -1;
    for (int i = 0; i <= cells; ++i)
      for (int k = 0; k <= cells; ++k)
        corners[i * (cells + 1) + k] = at(axis, side, line(i), line(k));
    for (int i = 0; i < cells; ++i) {
      for (int k = 0; k < cells; ++k) {
        const Vec3* corner = &corners[i * (cells + 1) + k];
        const Vec3 first = corner[cells + 2] - corner[0];
        const Vec3 second = corner[cells + 1] - corner[1];
        surface.areas.push_back(0.5 * first.cross(second).norm());
        surface.area += surface.areas.back();
        surface.points_O.push_back(state.X_OQ * at(axis, side, line(i + 0.5), line(k + 0.5)));
      }
    }
  }
  return surface;
}

Stray stray_of(const FitState& state, std::span<const Vec3> points, double reach) {
  const OwnSurface surface = own_surface(state, kStrayCells);
  Stray stray;
  for (std::size_t i = 0; i < surface.points_O.size(); ++i) {
    double least = kFarOff * kFarOff;
    for (const Vec3& p : points)
      least = std::min(least, (p - surface.points_O[i]).squaredNorm());
    const double far = std::sqrt(least);
    stray.max = std::max(stray.max, far);
    stray.mean_beyond += surface.areas[i] / surface.area * std::max(0.0, far - reach);
  }
  return stray;
}

std::vector<Vec3> among_others(std::span<const Vec3> points, std::size_t wanted) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / wanted);
  std::vector<double> to_neighbour;
  for (std::size_t i = 0; i < points.size(); i += step) {
    std::array<double, kNeighbours> least;  // squares, ascending; the point itself is the first
    least.fill(std::numeric_limits<double>::max());
    for (const Vec3& p : points) {
      double square = (p - points[i]).squaredNorm();
      if (square >= least.back()) continue;
      for (double& kept : least)
        if (square < kept) std::swap(square, kept);
    }
    to_neighbour.push_back(least.back());
  }
  std::vector<double> sorted = to_neighbour;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double lonely = *middle > 0 ? kLonely * kLonely * *middle : std::numeric_limits<double>::max();
  std::vector<Vec3> chosen;
  for (std::size_t n = 0; n < to_neighbour.size(); ++n)
    if (to_neighbour[n] <= lonely) chosen.push_back(points[n * step]);
  return chosen;
}

int remove_noise_bias(FitState& state, std::span<const Vec3> points, const ImproveConfig& config, std::uint64_t seed) {
  const std::size_t count = std::size_t{2} * 6 * kCells * kCells;
  const std::vector<Vec3> unit_noise = opposite_noise(count, seed);
  std::vector<Vec3> simulated(count);
  std::vector<double> weights(count);
  double sigma = config.scale;
  int rounds = 0;
  while (rounds < kRounds) {
    ++rounds;
    const OwnSurface surface = own_surface(state, kCells);
    for (std::size_t i = 0; i < count; ++i) {
      simulated[i] = surface.points_O[i / 2] + sigma * unit_noise[i];
      weights[i] = 0.5 * static_cast<double>(points.size()) * surface.areas[i / 2] / surface.area;
    }
    LossModel model = loss_model(state, points, config);
    const LossModel own = loss_model(state, simulated, config, weights);
    if (!std::isfinite(model.cost) || !std::isfinite(own.cost)) break;
    const double moves = sigma;
    sigma = std::min(kMostNoise, sigma * std::sqrt(model.cost / own.cost));
    model.g -= own.g;
    const FitState::Step step = damped_step(state, model, config.deformed, 1e-3);
    const FitState next = state.moved(step);
    if (!step.allFinite() || !is_valid(next.shape())) break;
    state = next;
    const double moved = std::sqrt(std::max(0.0, step.dot(model.H * step)) / static_cast<double>(points.size()));
    if (moved < kSettled && std::abs(moves - sigma) < kSettled) break;
  }
  return rounds;
}

}  // namespace mechane::geometry
