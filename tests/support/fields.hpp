// Distance fields for tests: any that a kernel may read, and one that is a ball.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "server/base/random.hpp"
#include "server/collision/distance_field.hpp"
#include "server/collision/object.hpp"
#include "server/collision/samples.hpp"

namespace mechane::test {

/// Each coordinate from -1 to 1.
inline Vec3 any_vector(Random& random) {
  const double x = 2 * random.unit() - 1;
  const double y = 2 * random.unit() - 1;
  return {x, y, 2 * random.unit() - 1};
}

/// Smooth, or of two or three sheets that meet in any way.
inline collision::DistanceField::Leaf any_leaf(Random& random) {
  const auto any_corners = [&] {
    std::array<double, 8> corners{};
    for (double& corner : corners)
      corner = 2 * random.unit() - 1.2;
    return corners;
  };
  if (random.below(2) == 0) return collision::DistanceField::Leaf::smooth(any_corners(), 0.3 * any_vector(random));
  const int count = 2 + static_cast<int>(random.below(2));
  return collision::DistanceField::Leaf::of_sheets(
      {count, {any_corners(), any_corners(), any_corners()}, random.below(2) == 0, random.below(2) == 0});
}

/// A few blocks with any planes and leaves, some halved, some more than once: no distance, but all that a kernel may read.
inline collision::DistanceField any_field(Random& random) {
  collision::DistanceField::Data data;
  for (int& n : data.grid.blocks)
    n = static_cast<int>(1 + random.below(5));
  data.grid.origin_Q = (0.15 * any_vector(random) - Vec3::Constant(0.25)).cast<float>();
  data.grid.block_m = static_cast<float>(0.05 + 0.15 * random.unit());
  data.slack_m = 0.001F;
  data.slots = {{}};
  const auto any_word = [&](const auto& self, int level) -> std::uint32_t {
    const std::size_t kind = random.below(4);
    if (kind == 0) return 0;
    if (kind == 1 && level < collision::kFieldLevels) {
      const std::size_t first = data.children.size();
      data.children.resize(first + collision::DistanceField::kChildren);
      for (std::size_t i = 0; i < collision::DistanceField::kChildren; ++i) {
        const std::uint32_t word = self(self, level + 1);
        data.children[first + i] = word;
      }
      return collision::DistanceField::split_word(first);
    }
    const collision::DistanceField::Leaf leaf = any_leaf(random);
    const std::size_t spans = level == 0 ? collision::DistanceField::kMaxSpan + 1 : 1;
    const auto span = static_cast<int>(random.below(spans));
    const std::uint32_t word = collision::DistanceField::leaf_word(data.slots.size(), span);
    data.slots.push_back(leaf.first);
    if (leaf.has_sheets) data.slots.push_back(leaf.second);
    return word;
  };
  for (std::size_t i = 0; i < data.grid.block_count(); ++i) {
    const auto any_slope = [&] { return static_cast<int>(random.below(127)) - 63; };
    const collision::DistanceField::Plane plane{static_cast<int>(random.below(80)) - 60,
                                                {any_slope(), any_slope(), any_slope()}};
    data.entries.push_back(std::uint64_t{any_word(any_word, 0)} << 32 | plane.packed());
  }
  return collision::DistanceField(std::move(data));
}

constexpr double kBall_m = 0.08;

/// A ball in blocks of 2 cm: its distance is fitted by eye, corners and what lies half way between them. Planes are those of the middle,
/// lowered by more than the ball bends in a block.
inline collision::DistanceField ball_field() {
  constexpr double kBlock = 0.02;
  collision::DistanceField::Data data;
  data.grid = {{10, 10, 10}, Vec3f::Constant(-0.1F), static_cast<float>(kBlock)};
  data.slack_m = 0.001F;
  data.slots = {{}};
  const auto distance = [&](const Vec3& blocks) {
    return ((kBlock * blocks - Vec3::Constant(0.1)).norm() - kBall_m) / kBlock;
  };
  for (std::size_t i = 0; i < data.grid.block_count(); ++i) {
    const Vec3 low(static_cast<double>(i % 10), static_cast<double>(i / 10 % 10), static_cast<double>(i / 100));
    const Vec3 middle = low + Vec3::Constant(0.5);
    std::array<double, 8> corners{};
    double least = 1;
    for (int c = 0; c < 8; ++c) {
      double& corner = corners[static_cast<std::size_t>(c)];
      corner = distance(low + Vec3(c & 1, c >> 1 & 1, c >> 2));
      least = std::min(least, corner);
    }
    Vec3 bubbles;
    collision::DistanceField::Plane plane;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 half = 0.5 * Vec3::Unit(axis);
      bubbles[axis] = 4 * (distance(middle) - 0.5 * (distance(middle - half) + distance(middle + half)));
      const double slope = distance(middle + half) - distance(middle - half);
      plane.slope[static_cast<std::size_t>(axis)] = static_cast<int>(std::lround(62 * slope));
    }
    plane.value = static_cast<int>(std::floor(64 * (distance(middle) - 0.2)));
    std::uint64_t word = 0;
    if (least < 0.2) {
      word = collision::DistanceField::leaf_word(data.slots.size());
      data.slots.push_back(collision::DistanceField::Leaf::smooth(corners, bubbles).first);
    }
    data.entries.push_back(word << 32 | plane.packed());
  }
  return collision::DistanceField(std::move(data));
}

/// It as an object of one part at the origin, without samples.
inline collision::Object object_of(collision::DistanceField field) {
  collision::Object object;
  object.parts.resize(1);
  const collision::BoxView box = field.box();
  const Vec3f center(box.center[0], box.center[1], box.center[2]);
  const Vec3f half(box.half[0], box.half[1], box.half[2]);
  object.parts[0].bound_O = {center.cast<double>(), static_cast<double>(half.norm())};
  object.parts[0].map = std::move(field);
  collision::close_clusters(object);
  return object;
}

}  // namespace mechane::test
