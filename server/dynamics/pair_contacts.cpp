#include "server/dynamics/pair_contacts.hpp"

#include <algorithm>

namespace mechane::dynamics {
namespace {

using collision::Object;
using collision::PointContact;

constexpr std::size_t kMostFound = 4096;
constexpr double kSameDepth_m =
    1e-4;  // depths this close count as equal, so that the choice of the deepest does not flicker
constexpr double kSamePlace_m = 1e-4;    // points closer than this span no area
constexpr double kAgrees = 0.9;          // cosine: a normal this close to the mean of all is not checked again
constexpr double kProbe_m = 2e-3;        // how far behind its surface a body is looked for, and
constexpr double kLeastBehind_m = 6e-4;  // how deep it must be there; less means that the step went along the surface

/// Whether there is solid a little behind a part's surface point p_WS, against the direction `out_W`. The sample's own part is asked:
/// its map holds the surface that the sample was taken from.
bool is_solid_behind(const Object& object, const Pose& X_WO, std::uint16_t part, const Vec3& p_WS, const Vec3& out_W) {
  const collision::Part& of = object.parts[part];
  const Vec3 p_Q = (X_WO * of.X_OQ).inverse() * (p_WS - kProbe_m * out_W);
  const collision::MapHit hit = of.map.evaluate(p_Q.cast<float>());
  return hit.hit && static_cast<double>(hit.depth_m) >= kLeastBehind_m;
}

/// The choice among the contacts of one pair. A contact that turns out to be false gets depth 0.
class Choice {
 public:
  Choice(const Object& a, const Pose& X_WA, const Object& b, const Pose& X_WB, std::span<PointContact> found)
      : a_(a), X_WA_(X_WA), b_(b), X_WB_(X_WB), found_(found) {
    for (const PointContact& c : found_) {
      mean_n_W_ += c.n_BA_W;
      center_W_ += c.p_WC / static_cast<double>(found_.size());
    }
    mean_n_W_.normalize();  // a zero stays zero: then every contact is checked again
  }

  std::size_t run(std::array<PointContact, kManifoldPoints>& best) {
    const PointContact* p0 = deepest();
    if (p0 == nullptr) return 0;
    best[0] = *p0;
    const Vec3 at = p0->p_WC;
    const PointContact* p1 = pick([&](const Vec3& p) { return (p - at).squaredNorm(); });
    if (p1 == nullptr) return 1;
    best[1] = *p1;
    const Vec3 line = (p1->p_WC - at).normalized();
    const PointContact* p2 = pick([&](const Vec3& p) { return (p - at).cross(line).squaredNorm(); });
    if (p2 == nullptr) return 2;
    best[2] = *p2;
    const std::array<Vec3, 3> corners{at, p1->p_WC, p2->p_WC};
    const PointContact* p3 = pick([&](const Vec3& p) { return outside(corners, p); });
    if (p3 == nullptr) return 3;
    best[3] = *p3;
    return 4;
  }

 private:
  /// How far p lies beyond the sides of a triangle, m^2 as a distance squared; 0 within.
  static double outside(const std::array<Vec3, 3>& corners, const Vec3& p) {
    const Vec3 n = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 side = (corners[(i + 1) % 3] - corners[i]).normalized();
      most = std::max(most, n.cross(side).dot(corners[i] - p));
    }
    return most * most;
  }

  /// The outermost of the contacts that are about as deep as the deepest: it is the same one in the next tick.
  const PointContact* deepest() {
    while (true) {
      double depth_m = 0;
      for (const PointContact& c : found_)
        depth_m = std::max(depth_m, c.depth_m);
      if (depth_m <= 0) return nullptr;
      PointContact* best = nullptr;
      double most = -1;
      for (PointContact& c : found_) {
        const double score = (c.p_WC - center_W_).squaredNorm();
        if (c.depth_m <= 0 || c.depth_m < depth_m - kSameDepth_m || score <= most) continue;
        most = score;
        best = &c;
      }
      if (holds(*best)) return best;
      best->depth_m = 0;
    }
  }

  /// The contact with the highest score, a distance squared.
  template <class Score>
  const PointContact* pick(const Score& score) {
    while (true) {
      PointContact* best = nullptr;
      double most = kSamePlace_m * kSamePlace_m;
      for (PointContact& c : found_) {
        if (c.depth_m <= 0) continue;
        const double now = score(c.p_WC);
        if (now <= most) continue;
        most = now;
        best = &c;
      }
      if (best == nullptr || holds(*best)) return best;
      best->depth_m = 0;
    }
  }

  /// Both bodies must lie behind their surfaces: B against the normal, A along it.
  [[nodiscard]] bool holds(const PointContact& c) const {
    if (c.n_BA_W.dot(mean_n_W_) > kAgrees) return true;
    return is_solid_behind(b_, X_WB_, c.part_b, c.p_WC, c.n_BA_W) &&
           is_solid_behind(a_, X_WA_, c.part_a, c.p_WC - c.depth_m * c.n_BA_W, -c.n_BA_W);
  }

  const Object& a_;
  const Pose& X_WA_;
  const Object& b_;
  const Pose& X_WB_;
  std::span<PointContact> found_;
  Vec3 mean_n_W_ = Vec3::Zero();
  Vec3 center_W_ = Vec3::Zero();
};

}  // namespace

PairContacts::PairContacts() : found_(kMostFound) {}

std::span<const PointContact> PairContacts::find(const Object& a, const Pose& X_WA, const Object& b,
                                                 const Pose& X_WB) noexcept {
  collision::ContactBuffer buffer(found_);
  collision::find_contacts(a, X_WA, b, X_WB, buffer);
  const std::size_t count = buffer.contacts().size();
  if (count == 0) return {};
  const PointContact deepest =
      *std::max_element(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(count),
                        [](const PointContact& l, const PointContact& r) { return l.depth_m < r.depth_m; });
  std::size_t chosen = Choice(a, X_WA, b, X_WB, std::span(found_).first(count)).run(best_);
  if (chosen == 0) best_[chosen++] = deepest;  // bodies that overlap are never left without a contact
  return std::span(best_).first(chosen);
}

}  // namespace mechane::dynamics
