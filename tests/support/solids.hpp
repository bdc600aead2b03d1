// Closed meshes that are not convex, for tests that take solids apart. A person sees a known number of parts in each.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "server/geometry/mesh.hpp"

namespace mechane::test {

/// The solid between z = -half_length and half_length over a polygon that runs counter-clockwise and is seen whole from `middle`.
inline geometry::Mesh prism(const std::vector<std::pair<double, double>>& polygon, double half_length,
                            std::pair<double, double> middle = {0, 0}) {
  geometry::Mesh mesh;
  for (const double z : {-half_length, half_length}) {
    for (const auto& [x, y] : polygon)
      mesh.vertices.emplace_back(x, y, z);
    mesh.vertices.emplace_back(middle.first, middle.second, z);
  }
  const auto n = static_cast<std::uint32_t>(polygon.size());
  const std::uint32_t top = n + 1;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.triangles.push_back({i, j, top + j});
    mesh.triangles.push_back({i, top + j, top + i});
    mesh.triangles.push_back({n, j, i});
    mesh.triangles.push_back({top + n, top + i, top + j});
  }
  return mesh;
}

/// A grid of `around` x `along` squares, closed both ways: p(u, v) with u, v in [0, 1).
inline geometry::Mesh closed_grid(std::uint32_t around, std::uint32_t along,
                                  const std::function<Vec3(double, double)>& p) {
  geometry::Mesh mesh;
  for (std::uint32_t j = 0; j < along; ++j) {
    for (std::uint32_t i = 0; i < around; ++i)
      mesh.vertices.push_back(p(static_cast<double>(i) / around, static_cast<double>(j) / along));
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j % along * around + i % around; };
  for (std::uint32_t j = 0; j < along; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// A surface that its middle sees whole: `radius_m` along the unit vector of polar angle and azimuth about z.
inline geometry::Mesh globe(std::uint32_t around, std::uint32_t down,
                            const std::function<double(double polar, double azimuth)>& radius_m) {
  geometry::Mesh mesh;
  const auto put = [&](double polar, double azimuth) {
    const Vec3 way(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
    mesh.vertices.push_back(radius_m(polar, azimuth) * way);
  };
  put(0, 0);
  for (std::uint32_t j = 1; j < down; ++j) {
    for (std::uint32_t i = 0; i < around; ++i)
      put(kPi * j / down, 2 * kPi * i / around);
  }
  put(kPi, 0);
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return 1 + (j - 1) * around + i % around; };
  const std::uint32_t last = static_cast<std::uint32_t>(mesh.vertices.size()) - 1;
  for (std::uint32_t i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, at(i, 1), at(i + 1, 1)});
    mesh.triangles.push_back({last, at(i + 1, down - 1), at(i, down - 1)});
    for (std::uint32_t j = 1; j + 1 < down; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

inline geometry::Mesh ball(double radius_m, std::uint32_t around = 32) {
  return globe(around, around / 2, [&](double, double) { return radius_m; });
}

/// Two legs of a square section, 0.2 m thick, along x and y from a common corner at the origin.
inline geometry::Mesh l_shape(double x_m = 1, double y_m = 0.7) {
  return prism({{0, 0}, {x_m, 0}, {x_m, 0.2}, {0.2, 0.2}, {0.2, y_m}, {0, y_m}}, 0.1, {0.1, 0.1});
}

/// Two balls of 0.4 m with their middles at z = +-0.3 m: the union's surface.
inline geometry::Mesh peanut() {
  return globe(40, 40, [](double polar, double) {
    const double height = 0.3 * std::abs(std::cos(polar));
    return height + std::sqrt(height * height + 0.4 * 0.4 - 0.3 * 0.3);
  });
}

/// A wheel of 0.42 m with teeth out to 0.55 m, 0.24 m thick.
inline geometry::Mesh gear(int teeth = 12) {
  std::vector<std::pair<double, double>> outline;
  const double step = 2 * kPi / teeth;
  const auto put = [&](double angle, double radius) {
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int k = 0; k < teeth; ++k) {
    for (const double share : {-0.5, -0.4, -0.31})
      put((k + share) * step, 0.42);
    for (const double share : {-0.19, 0.0, 0.19})
      put((k + share) * step, 0.55);
    for (const double share : {0.31, 0.4})
      put((k + share) * step, 0.42);
  }
  return prism(outline, 0.12);
}

/// A tube along z, open at both ends, its wall between the two radii.
inline geometry::Mesh tube(double inner_m, double outer_m, double half_length, std::uint32_t around = 48) {
  const std::array<std::pair<double, double>, 4> section = {
      {{inner_m, -half_length}, {outer_m, -half_length}, {outer_m, half_length}, {inner_m, half_length}}};
  return closed_grid(around, 4, [&](double u, double v) {
    const auto& [r, z] = section[static_cast<std::size_t>(4 * v)];
    return Vec3(r * std::cos(2 * kPi * u), r * std::sin(2 * kPi * u), z);
  });
}

inline geometry::Mesh torus(double ring_m, double tube_m, std::uint32_t around = 48, std::uint32_t section = 20) {
  return closed_grid(around, section, [&](double u, double v) {
    const double r = ring_m + tube_m * std::cos(2 * kPi * v);
    return Vec3(r * std::cos(2 * kPi * u), r * std::sin(2 * kPi * u), tube_m * std::sin(2 * kPi * v));
  });
}

/// A solid rod of 0.25 m with a helical ridge of 0.06 m every 0.24 m, 1.2 m long.
inline geometry::Mesh screw(std::uint32_t around = 24, std::uint32_t along = 36) {
  const double length = 1.2;
  geometry::Mesh mesh;
  for (std::uint32_t k = 0; k <= along; ++k) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2 * kPi * i / around;
      const double z = length * k / along - length / 2;
      const double turns = z / 0.24 - static_cast<double>(i) / around;
      const double r = 0.25 + 0.06 * (1 - std::abs(2 * (turns - std::floor(turns)) - 1));
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
  }
  const auto bottom = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 0, -length / 2);
  mesh.vertices.emplace_back(0, 0, length / 2);
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t j = (i + 1) % around;
    for (std::uint32_t k = 0; k < along; ++k) {
      mesh.triangles.push_back({k * around + i, k * around + j, (k + 1) * around + j});
      mesh.triangles.push_back({k * around + i, (k + 1) * around + j, (k + 1) * around + i});
    }
    mesh.triangles.push_back({bottom, j, i});
    mesh.triangles.push_back({bottom + 1, along * around + i, along * around + j});
  }
  return mesh;
}

/// A ball of 0.5 m with shallow bumps, of about `around` times `around` triangles.
inline geometry::Mesh bumpy_ball(std::uint32_t around = 44) {
  return globe(around, around / 2, [](double polar, double azimuth) {
    const double sine = std::sin(polar);
    return 0.5 * (1 + 0.07 * std::sin(4 * azimuth) * sine * sine + 0.06 * std::cos(5 * polar));
  });
}

}  // namespace mechane::test
