#include "server/hand/local_contact_model.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::hand {
namespace {

constexpr double kFlat_per_m = 1e-3;  // a radius of a kilometre is a plane to a hand

bool usable(const LocalContact& c) {
  const bool vectors = c.p_W.allFinite() && c.n_W.allFinite() && c.v_W.allFinite();
  const bool scalars = std::isfinite(c.depth_m) && std::isfinite(c.curvature_per_m) &&
                       std::isfinite(c.stiffness_n_per_m) && std::isfinite(c.damping_ns_per_m) &&
                       std::isfinite(c.friction);
  const bool signs = c.stiffness_n_per_m >= 0 && c.damping_ns_per_m >= 0 && c.friction >= 0;
  return vectors && scalars && signs && std::abs(c.n_W.squaredNorm() - 1.0) < 1e-3;
}

struct Overlap {
  double depth_m;
  Vec3 n_W;
};

// How far H is behind the plane or sphere, and the way out.
Overlap overlap_of(const LocalContact& c, const Vec3& p_WS, const Vec3& p_WH) {
  if (std::abs(c.curvature_per_m) < kFlat_per_m) return {(p_WS - p_WH).dot(c.n_W), c.n_W};
  const double radius = 1.0 / std::abs(c.curvature_per_m);
  const Vec3 p_WC = p_WS - c.n_W / c.curvature_per_m;  // the sphere's centre
  const Vec3 p_CH = p_WH - p_WC;
  const double distance = p_CH.norm();
  if (distance < 1e-9) return {c.curvature_per_m > 0 ? radius : -radius, c.n_W};
  const double side = c.curvature_per_m > 0 ? 1.0 : -1.0;
  return {side * (radius - distance), (side / distance) * p_CH};
}

// 1 while the contact is valid, then linearly to exactly 0.
double share_left(Duration age, Duration validity) {
  if (age <= validity) return 1.0;
  return std::max(0.0, 1.0 - to_seconds(age - validity) / to_seconds(LocalContactModel::kFadeTime));
}

// Normal force, damping of what pushes in, and friction within its cone; continuous where depth goes through 0.
Vec3 force_of(const LocalContact& c, const Overlap& o, const Vec3& v_rel_W) {
  const double v_n = v_rel_W.dot(o.n_W);
  double normal = c.stiffness_n_per_m * o.depth_m;
  if (v_n < 0) normal -= c.damping_ns_per_m * v_n * std::min(1.0, o.depth_m / LocalContactModel::kDampingOnset_m);
  const Vec3 v_t = v_rel_W - v_n * o.n_W;
  const double speed = std::max(v_t.norm(), LocalContactModel::kStickSpeed_m_per_s);
  return normal * o.n_W - (c.friction * normal / speed) * v_t;
}

}  // namespace

std::size_t LocalContactModel::set(std::span<const LocalContact> contacts, const Vec3& p_WH0) noexcept {
  count_ = 0;
  if (!p_WH0.allFinite()) return 0;
  for (const LocalContact& contact : contacts) {
    if (count_ == kMaxLocalContacts) break;
    if (!usable(contact)) continue;
    LocalContact& c = contacts_[count_++];
    c = contact;
    c.n_W.normalize();
    c.p_W = p_WH0 + c.depth_m * c.n_W;
  }
  return count_;
}

Vec3 LocalContactModel::render(const Vec3& p_WH, const Vec3& v_WH, Duration age) const noexcept {
  Vec3 force = Vec3::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    const LocalContact& c = contacts_[i];
    const double share = share_left(age, c.validity);
    if (share <= 0) continue;
    // The surface moves on while the contact is valid; afterwards it rests, and its speed fades with the contact.
    const Vec3 p_WS = c.p_W + to_seconds(std::clamp(age, Duration{0}, std::max(c.validity, Duration{0}))) * c.v_W;
    const Overlap overlap = overlap_of(c, p_WS, p_WH);
    if (overlap.depth_m <= 0) continue;
    force += share * force_of(c, overlap, v_WH - share * c.v_W);
  }
  return force;
}

}  // namespace mechane::hand
