#include "server/state/coupling.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::state {
namespace {

constexpr int kMostRounds = 24;  // tangents of two sheaves depend on each other; each round is some 100 times closer
constexpr double kTangentAccuracy = 1e-12;  // m

struct Sheave {
  Vec3 p_WC;
  Vec3 axis_W;
  double radius_m;
  double sense;
};

/// Where the tangent from P touches the sheave. `towards` is +1 where the rope comes from P, -1 where it goes to P.
Vec3 tangent_point(const Sheave& sheave, const Vec3& p_WP, double towards) {
  if (sheave.radius_m <= 0) return sheave.p_WC;
  Vec3 d = p_WP - sheave.p_WC;
  d -= sheave.axis_W * sheave.axis_W.dot(d);
  const double distance = d.norm();
  if (distance < 1e-12) return sheave.p_WC;
  d /= distance;
  const double cosine = std::min(1.0, sheave.radius_m / distance);
  const double sine = towards * sheave.sense * std::sqrt(1 - cosine * cosine);
  return sheave.p_WC + sheave.radius_m * (cosine * d + sine * sheave.axis_W.cross(d));
}

/// Right-handed about the axis, -pi to pi.
double signed_angle(const Vec3& from, const Vec3& to, const Vec3& axis) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to));
}

/// How far the rope goes round, -pi/2 to 3 pi/2: one that has just come off the sheave has a small negative angle, not a whole turn.
double wrap_of(const Sheave& sheave, const Vec3& p_in, const Vec3& p_out) {
  const double angle = sheave.sense * signed_angle(p_in - sheave.p_WC, p_out - sheave.p_WC, sheave.axis_W);
  return angle < -0.5 * kPi ? angle + 2 * kPi : angle;
}

double turn_at_point(const Vec3& p_before, const Vec3& p, const Vec3& p_after) {
  const Vec3 in = p - p_before, out = p_after - p;
  return std::atan2(in.cross(out).norm(), in.dot(out));
}

}  // namespace

double intermittent_position(const Coupling& gear, double q1) noexcept {
  const double x = q1 - gear.phase + 0.5 * gear.window;
  const double turn = std::floor(x / (2 * kPi));
  return gear.step * (turn + std::clamp((x - 2 * kPi * turn) / gear.window, 0.0, 1.0));
}

RopePath measure_rope(const Coupling& rope, const std::array<Pose, kMaxRopeNodes>& X_WN, const Quat& R_W1) noexcept {
  RopePath path;
  const std::size_t count = rope.node_count;
  std::array<Sheave, kMaxRopeNodes> sheaves;
  for (std::size_t i = 0; i < count; ++i) {
    const RopeNode& node = rope.nodes[i];
    const bool fastened = i + 1 == count || (i == 0 && !rope.drum);
    sheaves[i] = {X_WN[i] * node.p_BC, X_WN[i].rotate(node.axis_B), fastened ? 0.0 : node.radius_m, node.sense};
    path.p_in_W[i] = path.p_out_W[i] = sheaves[i].p_WC;
  }
  for (int round = 0; round < kMostRounds; ++round) {
    double moved = 0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const Vec3 out = tangent_point(sheaves[i], path.p_in_W[i + 1], -1);
      const Vec3 in = tangent_point(sheaves[i + 1], out, +1);
      moved = std::max({moved, (out - path.p_out_W[i]).norm(), (in - path.p_in_W[i + 1]).norm()});
      path.p_out_W[i] = out;
      path.p_in_W[i + 1] = in;
    }
    if (moved < kTangentAccuracy) break;
  }
  if (count == 0) return path;
  path.p_in_W[0] = path.p_out_W[0];
  path.p_out_W[count - 1] = path.p_in_W[count - 1];
  for (std::size_t i = 0; i + 1 < count; ++i) {
    path.length_m += (path.p_in_W[i + 1] - path.p_out_W[i]).norm();
    if (i == 0) continue;
    path.wrap_rad[i] = sheaves[i].radius_m > 0 ? wrap_of(sheaves[i], path.p_in_W[i], path.p_out_W[i])
                                               : turn_at_point(path.p_out_W[i - 1], path.p_in_W[i], path.p_in_W[i + 1]);
    path.length_m += sheaves[i].radius_m * path.wrap_rad[i];
  }
  if (rope.drum) {
    path.drum_angle_rad = signed_angle(R_W1 * rope.drum_start_1, path.p_out_W[0] - sheaves[0].p_WC, sheaves[0].axis_W);
  }
  return path;
}

}  // namespace mechane::state
