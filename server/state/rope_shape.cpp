#include "server/state/rope_shape.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::state {
namespace {

constexpr std::size_t kArcPoints = 9;    // round a sheave
constexpr std::size_t kSpanPoints = 8;   // within a free part
constexpr std::size_t kCoilPoints = 60;  // wound on a drum
constexpr double kMostTurns = 5;         // further turns lie in layers below, and are not seen

/// A point on the sheave, turned about its axis from p_W by an angle.
Vec3 turned(const Vec3& p_W, const Vec3& p_WC, const Vec3& axis_W, double angle_rad) {
  return p_WC + Eigen::AngleAxisd(angle_rad, axis_W) * (p_W - p_WC);
}

/// From the drum to where the rope leaves it: the turns that were wound since the start, side by side along the axis. The turns at the
/// start are part of the drum's model.
void add_coil(const Coupling& rope, const Pose& X_WN, const Vec3& p_out_W, std::vector<Vec3>& shape) {
  const RopeNode& drum = rope.nodes[0];
  const double wound_m = rope.offset - rope.length_m;
  const double turns = std::clamp(wound_m / (2 * kPi * drum.radius_m), 0.0, kMostTurns);
  const Vec3 axis_W = X_WN.rotate(drum.axis_B);
  const Vec3 p_WC = X_WN * drum.p_BC;
  for (std::size_t i = 0; i < kCoilPoints; ++i) {
    const double back = turns * (1 - static_cast<double>(i) / kCoilPoints);
    // Between two turns is a gap of about a tenth of the rope's diameter.
    shape.push_back(turned(p_out_W, p_WC, axis_W, -drum.sense * 2 * kPi * back) +
                    -1.1 * rope.diameter_m * back * axis_W);
  }
}

void add_arc(const RopeNode& sheave, const Pose& X_WN, const RopePath& path, std::size_t node,
             std::vector<Vec3>& shape) {
  const Vec3 axis_W = X_WN.rotate(sheave.axis_B);
  const double wrap_rad = sheave.radius_m > 0 ? path.wrap_rad[node] : 0;
  for (std::size_t i = 0; i < kArcPoints; ++i) {
    const double angle = sheave.sense * wrap_rad * static_cast<double>(i) / (kArcPoints - 1);
    shape.push_back(turned(path.p_in_W[node], X_WN * sheave.p_BC, axis_W, angle));
  }
}

/// The points within a free part, without its ends. A parabola whose sag h makes a part of length l at a slope a longer by
/// 8 (h cos a)^2 / (3 l). A steep part swings little to the side, however slack.
void add_span(const Vec3& p_from_W, const Vec3& p_to_W, double slack_m, const Vec3& down_W, std::vector<Vec3>& shape) {
  const Vec3 way_W = p_to_W - p_from_W;
  const double length_m = way_W.norm();
  const double level = length_m > 1e-9 ? (way_W - way_W.dot(down_W) * down_W).norm() / length_m : 0;
  const double sag_m = std::sqrt(3.0 / 8.0 * length_m * std::max(0.0, slack_m)) / std::max(level, 0.3);
  for (std::size_t i = 1; i <= kSpanPoints; ++i) {
    const double t = static_cast<double>(i) / (kSpanPoints + 1);
    shape.push_back(p_from_W + t * way_W + 4 * t * (1 - t) * sag_m * down_W);
  }
}

std::size_t longest_span(const RopePath& path, std::size_t nodes) {
  std::size_t longest = 0;
  for (std::size_t i = 1; i + 1 < nodes; ++i) {
    const auto length = [&](std::size_t k) { return (path.p_in_W[k + 1] - path.p_out_W[k]).squaredNorm(); };
    if (length(i) > length(longest)) longest = i;
  }
  return longest;
}

/// Where the end of a rope hangs when it is let go: below the last sheave, as far as its last part reaches.
Vec3 loose_end(const Coupling& rope, const RopePath& path, const Vec3& down_W) {
  const std::size_t last = rope.node_count - 1;
  const double span_m = (path.p_in_W[last] - path.p_out_W[last - 1]).norm();
  const double rest_m = rope.length_m - (path.length_m - span_m);
  return path.p_out_W[last - 1] + std::clamp(rest_m, 0.0, span_m) * down_W;
}

}  // namespace

std::vector<Vec3> rope_shape(const Coupling& rope, const std::array<Pose, kMaxRopeNodes>& X_WN, const Quat& R_W1,
                             const Vec3& down_W) {
  std::vector<Vec3> shape;
  if (rope.node_count < 2) return shape;
  RopePath path = measure_rope(rope, X_WN, R_W1);
  const std::size_t last = rope.node_count - 1;
  if (!rope.enabled) path.p_in_W[last] = loose_end(rope, path, down_W);
  if (rope.drum) add_coil(rope, X_WN[0], path.p_out_W[0], shape);
  shape.push_back(path.p_out_W[0]);
  const std::size_t sagging = rope.enabled ? longest_span(path, rope.node_count) : rope.node_count;
  for (std::size_t i = 1; i <= last; ++i) {
    add_span(path.p_out_W[i - 1], path.p_in_W[i], i - 1 == sagging ? rope.slack_m : 0, down_W, shape);
    if (i < last) add_arc(rope.nodes[i], X_WN[i], path, i, shape);
  }
  shape.push_back(path.p_in_W[last]);
  return shape;
}

std::vector<Vec3> rope_shape(const Coupling& rope, std::span<const Pose> X_WB, const Vec3& down_W) {
  std::array<Pose, kMaxRopeNodes> X_WN;
  for (std::size_t i = 0; i < rope.node_count; ++i) {
    if (rope.nodes[i].body) X_WN[i] = X_WB[rope.nodes[i].body.index()];
  }
  return rope_shape(rope, X_WN, rope.body1 ? X_WB[rope.body1.index()].R : Quat::Identity(), down_W);
}

}  // namespace mechane::state
