#include "server/hand/local_contact_model.hpp"

#include <algorithm>
#include <cmath>

#include "server/hand/friction_spring.hpp"

namespace mechane::hand {
namespace {

constexpr double kFlat_per_m = 1e-3;  // a radius of a kilometre is a plane to a hand

bool usable(const LocalContact& c) {
  const bool vectors = c.p_W.allFinite() && c.n_W.allFinite() && c.v_W.allFinite();
  const bool scalars = std::isfinite(c.depth_m) && std::isfinite(c.curvature_per_m) &&
                       std::isfinite(c.stiffness_n_per_m) && std::isfinite(c.damping_ns_per_m) &&
                       std::isfinite(c.static_friction) && std::isfinite(c.dynamic_friction) &&
                       std::isfinite(c.viscosity_ns_per_m) && std::isfinite(c.grooves.phase_rad);
  const bool signs =
      c.stiffness_n_per_m >= 0 && c.damping_ns_per_m >= 0 && c.static_friction >= 0 && c.dynamic_friction >= 0;
  return vectors && scalars && signs && std::abs(c.n_W.squaredNorm() - 1.0) < 1e-3;
}

Resistance resistance_of(const LocalContact& c) {
  return {c.stiffness_n_per_m, c.damping_ns_per_m, c.viscosity_ns_per_m, LocalContactModel::kDampingOnset_m};
}

double phase_at(const LocalContact& c, const Vec3& p_W) {
  return c.grooves.phase_rad + c.grooves.wave_W.dot(p_W);
}

}  // namespace

Overlap overlap_of(const LocalContact& c, const Vec3& p_WS, const Vec3& p_WH) noexcept {
  if (std::abs(c.curvature_per_m) < kFlat_per_m) return {(p_WS - p_WH).dot(c.n_W), c.n_W};
  const double radius = 1.0 / std::abs(c.curvature_per_m);
  const Vec3 p_WC = p_WS - c.n_W / c.curvature_per_m;  // the sphere's centre
  const Vec3 p_CH = p_WH - p_WC;
  const double distance = p_CH.norm();
  if (distance < 1e-9) return {c.curvature_per_m > 0 ? radius : -radius, c.n_W};
  const double side = c.curvature_per_m > 0 ? 1.0 : -1.0;
  return {side * (radius - distance), (side / distance) * p_CH};
}

const LocalContactModel::Touch* LocalContactModel::same_surface(const LocalContact& contact) const noexcept {
  constexpr double kSameNormal = 0.95;  // cosine: 18 degrees
  constexpr double kSamePlane_m = 2e-3;
  const Touch* best = nullptr;
  double best_cosine = kSameNormal;
  for (const Touch& touch : std::span(touches_).first(count_)) {
    const double cosine = touch.contact.n_W.dot(contact.n_W);
    const double apart_m = (contact.p_W - touch.contact.p_W - touch.travelled_W).dot(contact.n_W);
    if (cosine <= best_cosine || std::abs(apart_m) > kSamePlane_m) continue;
    best = &touch;
    best_cosine = cosine;
  }
  return best;
}

std::size_t LocalContactModel::set(std::span<const LocalContact> contacts, const Vec3& p_WH0) noexcept {
  std::array<Touch, kMaxLocalContacts> fresh{};
  std::size_t count = 0;
  double viscosity_left = kMaxViscosity_ns_per_m;
  for (const LocalContact& contact : p_WH0.allFinite() ? contacts : std::span<const LocalContact>()) {
    if (count == fresh.size()) break;
    if (!usable(contact)) continue;
    Touch& touch = fresh[count++];
    touch.contact = contact;
    touch.contact.n_W.normalize();
    touch.contact.p_W = p_WH0 + contact.depth_m * touch.contact.n_W;
    Grooves& grooves = touch.contact.grooves;
    if (!are_renderable(grooves.depth_m, grooves.wave_W.norm())) grooves = {};
    grooves.phase_rad -= grooves.wave_W.dot(p_WH0);
    touch.contact.viscosity_ns_per_m = std::clamp(contact.viscosity_ns_per_m, 0.0, viscosity_left);
    viscosity_left -= touch.contact.viscosity_ns_per_m;
    const Touch* const before = same_surface(touch.contact);
    touch.p_WA = before == nullptr ? p_WH0 : Vec3(before->p_WA + before->travelled_W);
    touch.slides = before != nullptr && before->slides;
  }
  touches_ = fresh;
  count_ = count;
  return count_;
}

Vec3 LocalContactModel::render(const Vec3& p_WH, const Vec3& v_WH, Duration age) noexcept {
  Vec3 force = Vec3::Zero();
  for (Touch& touch : std::span(touches_).first(count_)) {
    const LocalContact& c = touch.contact;
    const double share = share_left(age, c.validity);
    if (share <= 0) continue;
    // The surface moves on while the contact is valid; afterwards it rests, and its speed fades with the contact.
    touch.travelled_W = to_seconds(std::clamp(age, Duration{0}, std::max(c.validity, Duration{0}))) * c.v_W;
    const Overlap overlap = overlap_of(c, c.p_W + touch.travelled_W, p_WH);
    Vec3 stretch = Vec3::Zero();
    const GroovedTouch on_grooves = grooved(overlap.depth_m, c.grooves, phase_at(c, p_WH - touch.travelled_W));
    if (on_grooves.depth_m > 0) {
      stretch = along_surface(p_WH - touch.p_WA - touch.travelled_W, overlap.n_W);
      const Vec3 v_rel_W = v_WH - share * c.v_W;
      const SurfaceForce surface = surface_force(on_grooves, overlap.n_W, v_rel_W, resistance_of(c));
      const double cone_n =
          friction_cone_n(touch.slides, c.stiffness_n_per_m * stretch.norm(), c.static_friction * surface.normal_n,
                          c.dynamic_friction * surface.normal_n);
      const Vec3 damping_n = c.damping_ns_per_m * along_surface(v_rel_W, overlap.n_W);
      force += share * (surface.f_W + spring_friction(stretch, c.stiffness_n_per_m, damping_n, cone_n));
    }
    touch.p_WA = p_WH - touch.travelled_W - stretch;
  }
  return force;
}

}  // namespace mechane::hand
