#include "server/hand/held_path.hpp"

#include <algorithm>

namespace mechane::hand {
namespace {

/// How far a point is from the path, and the path's direction where it is nearest.
struct Nearest {
  Vec3 off_W;
  Vec3 along_W;      // unit
  double share = 1;  // of the force along it
};

Nearest nearest(const HeldPath& path, const Vec3& p_WG) {
  const Vec3 from_W = p_WG - path.p_W;
  const Vec3 along_axis = from_W.dot(path.axis_W) * path.axis_W;
  const Vec3 flat = from_W - along_axis;
  if (path.kind == HeldPath::Kind::line) return {flat, path.axis_W};
  // Near the axis a small step leads to the circle's other side: what depends on the side fades out there.
  const double distance = flat.norm();
  const double share = std::min(1.0, distance / (0.5 * path.radius_m));
  const Vec3 out = distance > 0 ? Vec3(flat / distance) : path.axis_W.unitOrthogonal();
  return {along_axis + share * (distance - path.radius_m) * out, path.axis_W.cross(out), share};
}

}  // namespace

Vec3 held_path_force(const HeldPath& path, const Pose& X_WH, const Twist& V_WH, Duration age,
                     double along_share) noexcept {
  if (path.kind == HeldPath::Kind::none || path.kind == HeldPath::Kind::free) return Vec3::Zero();
  const Vec3 p_HG_W = X_WH.rotate(path.p_HG);
  const Nearest at = nearest(path, X_WH.p + p_HG_W);
  const Vec3 v_W = V_WH.at(p_HG_W);
  const Vec3 v_across_W = v_W - v_W.dot(at.along_W) * at.along_W;
  Vec3 across_n = -path.stiffness_n_per_m * at.off_W - path.damping_ns_per_m * v_across_W;
  const double size_n = across_n.norm();
  if (size_n > path.limit_n) across_n *= path.limit_n / size_n;
  return share_left(age, path.validity) * (across_n + along_share * at.share * path.along_n * at.along_W);
}

Wrench held_weight(const HeldPath& path, const Pose& X_WH, Duration age) noexcept {
  if (path.kind != HeldPath::Kind::free) return {};
  const Vec3 f_W = share_left(age, path.validity) * path.along_n * path.axis_W;
  return {f_W, X_WH.rotate(path.p_HG).cross(f_W)};
}

}  // namespace mechane::hand
