// The lattice of a DistanceBrick: blocks, and kFinest cells along the edge of each. Inside this room only.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "server/base/math.hpp"
#include "server/collision/distance_brick.hpp"

namespace mechane::collision {

/// A node of the finest lattice, or a block.
using Node = std::array<int, 3>;

/// From corner to middle of a block of edge 1, rounded up.
inline constexpr float kHalfDiagonal = 0.8661F;

/// The place of a node among all below `count`, x fastest.
[[nodiscard]] inline std::size_t index_of(const Node& count, const Node& node) {
  const int at = (node[2] * count[1] + node[1]) * count[0] + node[0];
  return static_cast<std::size_t>(at);
}

/// What a trilinear function takes of each of a block's corners, x fastest, at a place from 0 to 1 along each edge.
[[nodiscard]] inline Eigen::Matrix<double, 8, 1> corner_weights(const Vec3& p_B) {
  Eigen::Matrix<double, 8, 1> weights;
  for (int corner = 0; corner < 8; ++corner) {
    weights[corner] = 1;
    for (int axis = 0; axis < 3; ++axis)
      weights[corner] *= (corner >> axis & 1) != 0 ? p_B[axis] : 1 - p_B[axis];
  }
  return weights;
}

/// Calls body(node) for all below `count`, x fastest.
template <class Body>
void for_each_node(const Node& count, const Body& body) {
  for (int z = 0; z < count[2]; ++z)
    for (int y = 0; y < count[1]; ++y)
      for (int x = 0; x < count[0]; ++x)
        body(Node{x, y, z});
}

/// Calls body(node) for the nodes of a block that lie `stride` apart.
template <class Body>
void for_each_node_of(const Node& block, int stride, const Body& body) {
  constexpr int kFinest = DistanceBrick::kFinest;
  const int count = kFinest / stride + 1;
  for_each_node({count, count, count}, [&](const Node& at) {
    body(Node{kFinest * block[0] + stride * at[0], kFinest * block[1] + stride * at[1],
              kFinest * block[2] + stride * at[2]});
  });
}

/// Between the eight corners of a cell, `f` of the way along each edge: value(corner) with 0 and 1 for each axis.
template <class Value>
[[nodiscard]] double trilinear(const Vec3& f, const Value& value) {
  double sum = 0;
  for_each_node({2, 2, 2}, [&](const Node& corner) {
    double weight = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = f[static_cast<Eigen::Index>(i)];
      weight *= corner[i] == 1 ? share : 1 - share;
    }
    if (weight > 0) sum += weight * static_cast<double>(value(corner));
  });
  return sum;
}

/// At a node of a block, as those of its nodes have it that lie `stride` apart: value(node).
template <class Value>
[[nodiscard]] double interpolate(const Node& block, int stride, const Node& node, const Value& value) {
  Node low{};
  Vec3 f;
  for (std::size_t i = 0; i < 3; ++i) {
    const int begin = DistanceBrick::kFinest * block[i];
    low[i] = begin + std::min((node[i] - begin) / stride, DistanceBrick::kFinest / stride - 1) * stride;
    f[static_cast<Eigen::Index>(i)] = static_cast<double>(node[i] - low[i]) / stride;
  }
  return trilinear(f, [&](const Node& corner) {
    return value(Node{low[0] + stride * corner[0], low[1] + stride * corner[1], low[2] + stride * corner[2]});
  });
}

}  // namespace mechane::collision
