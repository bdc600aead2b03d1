#include "client-sdk/display/hand_model.hpp"

#include <algorithm>

#include "client-sdk/display/procedural_mesh.hpp"

namespace mechane::display {
namespace {

struct FingerSize {
  std::array<double, 3> length_m;
  std::array<double, 3> radius_m;
};

// A middle-sized hand, breadth 85 mm and length 189 mm: thumb, index, middle, ring, little.
constexpr std::array<FingerSize, client::kFingers> kFingerSizes{{{{0.046, 0.034, 0.028}, {0.0115, 0.0105, 0.0095}},
                                                                 {{0.045, 0.026, 0.020}, {0.0095, 0.0085, 0.0075}},
                                                                 {{0.050, 0.030, 0.021}, {0.0095, 0.0085, 0.0075}},
                                                                 {{0.046, 0.029, 0.021}, {0.0090, 0.0080, 0.0072}},
                                                                 {{0.037, 0.021, 0.019}, {0.0085, 0.0075, 0.0065}}}};
constexpr double kPalmHalfLength_m = 0.050;
constexpr double kPalmHalfThickness_m = 0.014;
constexpr double kPalmHalfBreadth_m = 0.043;
constexpr double kIndexJointAhead_m = 0.048;  ///< of the palm's middle
constexpr double kIndexJointAside_m = -0.031;
/// The tip of a one-point device touches with 8 mm; it is drawn a little larger, or nobody finds it in a room.
constexpr double kTipRadius_m = 0.012;

Eigen::Affine3f placed(const Pose& X, double scale) {
  Eigen::Affine3f out = Eigen::Affine3f::Identity();
  out.linear() = (scale * X.R.toRotationMatrix()).cast<float>();
  out.translation() = X.p.cast<float>();
  return out;
}

}  // namespace

double hand_scale(const client::HandPose& hand) {
  // The index finger's first phalanx sits half its length beyond the joint, wherever the joint has turned it.
  const Pose X_PS = hand.X_WS[0].inverse() * hand.X_WS[4];
  const Vec3 unscaled =
      Vec3(kIndexJointAhead_m, 0, kIndexJointAside_m) + X_PS.rotate(Vec3(0.5 * kFingerSizes[1].length_m[0], 0, 0));
  const double scale = X_PS.p.norm() / std::max(unscaled.norm(), 1e-3);
  return std::clamp(scale, 0.5, 1.5);
}

HandModel::HandModel(AssetLibrary& library) {
  MaterialData skin;
  skin.base_colour = Eigen::Vector4f(0.66F, 0.40F, 0.28F, 1);
  skin.roughness = 0.52F;
  skin_ = library.add_material(skin);
  MaterialData stale = skin;
  stale.base_colour = Eigen::Vector4f(0.42F, 0.40F, 0.38F, 1);
  stale_ = library.add_material(stale);
  MaterialData tip;
  tip.base_colour = Eigen::Vector4f(0.85F, 0.52F, 0.16F, 1);
  tip.emissive = Vec3f(0.16F, 0.09F, 0.02F);
  tip.roughness = 0.3F;
  tip_material_ = library.add_material(tip);
  tip_ = library.add_mesh(sphere_mesh(kTipRadius_m, 16, 24));
  segments_[0] = library.add_mesh(
      superquadric_mesh(Vec3(kPalmHalfLength_m, kPalmHalfThickness_m, kPalmHalfBreadth_m), 0.55, 0.6, 24, 32));
  for (std::size_t f = 0; f < client::kFingers; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      segments_[1 + 3 * f + k] = library.add_mesh(
          phalanx_mesh(kFingerSizes[f].length_m[k], kFingerSizes[f].radius_m[k], k == 2 ? 0.22 : 0.10));
    }
  }
}

void HandModel::draw(const client::HandPose& hand, RenderScene& out) const {
  if (hand.kind == client::HandKind::one_point) {
    out.instances.push_back({tip_, hand.stale ? stale_ : tip_material_, placed(hand.X_WS[0], 1), true});
    out.occluders.push_back({hand.X_WS[0].p.cast<float>(), static_cast<float>(kTipRadius_m)});
    return;
  }
  const double scale = hand_scale(hand);
  for (std::size_t i = 0; i < client::kHandSegments; ++i) {
    out.instances.push_back({segments_[i], hand.stale ? stale_ : skin_, placed(hand.X_WS[i], scale), true});
    const double radius = i == 0 ? 0.030 : 0.013;
    out.occluders.push_back({hand.X_WS[i].p.cast<float>(), static_cast<float>(scale * radius)});
  }
}

}  // namespace mechane::display
