// One point through a kernel that takes 16: for builders and tests. Inside this room only.
#pragma once

#include "server/collision/kernels.hpp"
#include "server/collision/map_hit.hpp"

namespace mechane::collision {

[[nodiscard]] inline const Kernels& portable() noexcept {
  return kernels_of(InstructionSet::portable);
}

template <class View, class Inside, class Depth>
[[nodiscard]] MapHit evaluate_one(const Vec3f& p_QP, const View& view, Inside inside, Depth depth) noexcept {
  static constexpr BlockTransform kIdentity{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {}};
  PointBlock points;
  points.x.fill(p_QP.x());
  points.y.fill(p_QP.y());
  points.z.fill(p_QP.z());
  InsideBlock in;
  MapHit hit;
  if ((inside(view, kIdentity, points.view(), in) & 1U) == 0) return hit;
  DepthBlock out;
  depth(view, in.p_Q, 1, out);
  if (!(out.depth_m[0] > 0)) return hit;  // covered on all sides: deep in the solid of several parts
  hit.hit = true;
  hit.depth_m = out.depth_m[0];
  hit.m = in.m[0];
  hit.n_Q = {out.n_Q.x[0], out.n_Q.y[0], out.n_Q.z[0]};
  hit.p_QS = p_QP + hit.depth_m * hit.n_Q;
  return hit;
}

}  // namespace mechane::collision
