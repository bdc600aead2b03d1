#include "client-sdk/scene/hand_skin.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client-sdk/scene/surface_net.hpp"

namespace mechane::scene {
namespace {

constexpr float kSkinCell_m = 0.0028F;
constexpr double kRestDegree = kPi / 180;

/// Inigo Quilez' smooth minimum: two shapes within k of each other blend.
float smooth_min(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.0F) / k;
  return std::min(a, b) - h * h * k * 0.25F;
}

/// Distance to the line from a to b, and the nearest point's place along it, 0..1.
std::pair<float, float> from_line(const Vec3f& p, const Vec3f& a, const Vec3f& b) {
  const Vec3f ab = b - a;
  const float t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0F, 1.0F);
  return {(p - a - t * ab).norm(), t};
}

float from_ellipsoid(const Vec3f& p, const Vec3f& middle, const Vec3f& half) {
  const Vec3f q = p - middle;
  const float k0 = q.cwiseQuotient(half).norm();
  const float k1 = q.cwiseQuotient(half.cwiseProduct(half)).norm();
  return k1 > 1e-6F ? k0 * (k0 - 1) / k1 : -half.minCoeff();
}

/// A bone at rest: from joint to joint, with the radius of the flesh at its ends.
struct Bone {
  Vec3f a, b;
  float radius_a, radius_b;
};

/// The flat hand as rounded shapes, in H.
class RestingHand {
 public:
  RestingHand() {
    const SegmentPoses X_HS = HandSkin::rest_poses();
    for (std::size_t f = 0; f < client::kFingers; ++f) {
      const hand::FingerSize& size = finger_sizes()[f];
      for (std::size_t k = 0; k < 3; ++k) {
        const Pose& X = X_HS[hand::first_segment(f) + k];
        const double half = 0.5 * size.length_m[k];
        // The last one ends in a ball that reaches as far as the server's finger.
        const double end = k == 2 ? half - 0.55 * size.radius_m[k] : half;
        const double next = k == 2 ? 0.88 * size.radius_m[k] : size.radius_m[k + 1];
        bones_[3 * f + k] = {(X * Vec3(-half, 0, 0)).cast<float>(), (X * Vec3(end, 0, 0)).cast<float>(),
                             static_cast<float>(size.radius_m[k]), static_cast<float>(next)};
      }
    }
  }

  [[nodiscard]] const Bone& bone(std::size_t segment) const { return bones_[segment - 1]; }

  [[nodiscard]] float finger(const Vec3f& p, std::size_t f) const {
    float d = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Bone& bone = bones_[3 * f + k];
      const auto [away, t] = from_line(p, bone.a, bone.b);
      d = smooth_min(d, away - (bone.radius_a + t * (bone.radius_b - bone.radius_a)), 0.003F);
    }
    return d;
  }

  /// Palm, ball of the thumb, heel, wrist and the beginning of the arm.
  [[nodiscard]] static float palm(const Vec3f& p) {
    float d = 1;
    // The metacarpal bones, one towards each finger.
    for (std::size_t f = 1; f < client::kFingers; ++f) {
      const Vec3f to = finger_sizes()[f].X_HF.p.cast<float>();
      const Vec3f from(0.008F, 0.001F, 0.45F * to.z());
      const auto [away, t] = from_line(p, from, to);
      d = smooth_min(d, away - (0.0150F - 0.0042F * t), 0.016F);
    }
    d = smooth_min(d, from_ellipsoid(p, Vec3f(0.040F, -0.009F, -0.024F), Vec3f(0.036F, 0.013F, 0.017F)), 0.014F);
    d = smooth_min(d, from_ellipsoid(p, Vec3f(0.038F, -0.008F, 0.022F), Vec3f(0.036F, 0.012F, 0.014F)), 0.014F);
    // Wider than thick: the distance is measured in a flattened space.
    const Vec3f arm = p.cwiseProduct(Vec3f(1, 1.35F, 1));
    const auto [away, t] = from_line(arm, Vec3f(-0.085F, 0, 0), Vec3f(0.012F, 0, 0));
    return smooth_min(d, (away - (0.0300F - 0.0040F * t)) * 0.85F, 0.022F);
  }

  [[nodiscard]] float distance(const Vec3f& p) const {
    const float middle = palm(p);
    float d = middle;
    // Each finger blends into the palm, but not into its neighbour.
    for (std::size_t f = 0; f < client::kFingers; ++f)
      d = std::min(d, smooth_min(middle, finger(p, f), f == 0 ? 0.020F : 0.010F));
    return d;
  }

 private:
  std::array<Bone, 3 * client::kFingers> bones_;
};

}  // namespace

SegmentPoses HandSkin::rest_poses() {
  HandBend bend{};
  const std::array<double, client::kFingers> aside{14, 9, 2, -5, -13};
  for (std::size_t f = 0; f < client::kFingers; ++f)
    bend[f].aside = aside[f] * kRestDegree;
  return place_hand(bend);
}

const HandSkin& HandSkin::shared() {
  static const HandSkin kShared;
  return kShared;
}

HandSkin::HandSkin() {
  const RestingHand hand;
  const Eigen::AlignedBox3f box(Vec3f(-0.125F, -0.07F, -0.145F), Vec3f(0.235F, 0.045F, 0.085F));
  rest_ = surface_net([&](const Vec3f& p) { return hand.distance(p); }, box, kSkinCell_m);
  holds_.reserve(rest_.positions.size());
  for (const Vec3f& p : rest_.positions) {
    std::size_t of = 1;
    for (std::size_t f = 0; f < client::kFingers; ++f) {
      if (hand.finger(p, f) < hand.finger(p, of)) of = f;
    }
    // Nearer bones have more weight; within a finger's breadth of a joint two bones share the skin.
    std::vector<std::pair<float, std::size_t>> pulls;
    const auto pull = [&](float away_m, std::size_t segment) {
      pulls.emplace_back(std::pow(std::max(away_m, 1e-4F), -6.0F), segment);
    };
    pull(std::max(RestingHand::palm(p), 0.0F) + 0.009F, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t segment = hand::first_segment(of) + k;
      const Bone& bone = hand.bone(segment);
      pull(from_line(p, bone.a, bone.b).first, segment);
    }
    std::ranges::sort(pulls, std::greater<>());
    Hold hold;
    float sum = 0;
    for (std::size_t i = 0; i < kBones; ++i)
      sum += pulls[i].first;
    for (std::size_t i = 0; i < kBones; ++i) {
      hold.segment[i] = static_cast<std::uint8_t>(pulls[i].second);
      hold.weight[i] = pulls[i].first / sum;
    }
    holds_.push_back(hold);
  }
}

picture::MeshData HandSkin::follow(const SegmentPoses& X_WS, const hand::HandBuild& build) const {
  const SegmentPoses X_HS = rest_poses();
  const bool left = build.side == client::HandSide::left;
  const Vec3 mirror(1, 1, left ? -1 : 1);
  std::array<Eigen::Affine3f, client::kHandSegments> X_WH;
  for (std::size_t i = 0; i < client::kHandSegments; ++i) {
    Eigen::Affine3d X = Eigen::Affine3d::Identity();
    X.linear() = build.length_scale(i) * X_WS[i].R.toRotationMatrix() * mirror.asDiagonal();
    X.translation() = X_WS[i].p;
    const Pose X_SH = X_HS[i].inverse();
    Eigen::Affine3d back = Eigen::Affine3d::Identity();
    back.linear() = X_SH.R.toRotationMatrix();
    back.translation() = X_SH.p;
    X_WH[i] = (X * back).cast<float>();
  }
  picture::MeshData out = rest_;
  for (std::size_t v = 0; v < out.positions.size(); ++v) {
    Eigen::Matrix<float, 3, 4> sum = Eigen::Matrix<float, 3, 4>::Zero();
    for (std::size_t i = 0; i < kBones; ++i)
      sum += holds_[v].weight[i] * X_WH[holds_[v].segment[i]].affine();
    out.positions[v] = sum * rest_.positions[v].homogeneous();
    out.normals[v] = (sum.leftCols<3>() * rest_.normals[v]).normalized();
  }
  if (left)  // a mirror turns the triangles around
    for (std::size_t i = 0; i < out.indices.size(); i += 3)
      std::swap(out.indices[i], out.indices[i + 1]);
  return out;
}

}  // namespace mechane::scene
