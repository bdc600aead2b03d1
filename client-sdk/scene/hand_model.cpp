#include "client-sdk/scene/hand_model.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "client-sdk/picture/procedural_mesh.hpp"

namespace mechane::scene {
namespace {

/// The pose of a one-point hand in the camera's frame: it comes from the lower right and points forwards and inwards.
const Vec3 kReach_C = Vec3(-0.62, 0.42, -0.66).normalized();
const Vec3 kBack_C = Vec3(0.40, 0.85, 0.32);

Eigen::Affine3f placed(const Pose& X, double scale) {
  Eigen::Affine3f out = Eigen::Affine3f::Identity();
  out.linear() = (scale * X.R.toRotationMatrix()).cast<float>();
  out.translation() = X.p.cast<float>();
  return out;
}

struct Look {
  Eigen::Vector4f colour;
  float roughness;
};

/// By HandLook.
const std::array<Look, 4> kLooks{{{{0.76F, 0.49F, 0.37F, 1}, 0.50F},
                                  {{0.58F, 0.33F, 0.22F, 1}, 0.50F},
                                  {{0.155F, 0.075F, 0.045F, 1}, 0.45F},
                                  {{0.70F, 0.69F, 0.66F, 1}, 0.90F}}};

struct SleeveRing {
  double x, half_y, half_z;
};

// Linen around the wrist, in the palm's frame: a wide closed tube with a hem, and its continuation up the arm, where it
// fades.
constexpr double kWrist = -hand::kPalmHalfLength_m;
constexpr std::array<SleeveRing, 7> kSleeve{{{kWrist - 0.034, 0.0235, 0.0295},
                                             {kWrist - 0.030, 0.0285, 0.0350},
                                             {kWrist - 0.027, 0.0300, 0.0370},
                                             {kWrist - 0.036, 0.0305, 0.0375},
                                             {kWrist - 0.040, 0.0285, 0.0355},
                                             {kWrist - 0.080, 0.0313, 0.0381},
                                             {kWrist - 0.084, 0.0001, 0.0001}}};
constexpr std::array<SleeveRing, 4> kFadingSleeve{{{kWrist - 0.080, 0.0313, 0.0381},
                                                   {kWrist - 0.110, 0.0330, 0.0400},
                                                   {kWrist - 0.160, 0.0337, 0.0406},
                                                   {kWrist - 0.230, 0.0345, 0.0415}}};

/// A tube through rings; v of its image goes from the first to the last.
picture::MeshData sleeve_mesh(std::span<const SleeveRing> rings) {
  constexpr int kSectors = 28;
  picture::MeshData mesh;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const SleeveRing& before = rings[i == 0 ? 0 : i - 1];
    const SleeveRing& after = rings[std::min(i + 1, rings.size() - 1)];
    const SleeveRing& ring = rings[i];
    const double v = (ring.x - rings.front().x) / (rings.back().x - rings.front().x);
    for (int sector = 0; sector <= kSectors; ++sector) {
      const double a = 2 * kPi * sector / kSectors;
      // Folds run along the arm.
      const double fold = 1 + 0.025 * std::sin(7 * a);
      mesh.positions.push_back(
          Vec3(ring.x, fold * ring.half_y * std::sin(a), fold * ring.half_z * std::cos(a)).cast<float>());
      const Vec3 along(after.x - before.x, (after.half_y - before.half_y) * std::sin(a),
                       (after.half_z - before.half_z) * std::cos(a));
      const Vec3 around(0, ring.half_y * std::cos(a), -ring.half_z * std::sin(a));
      mesh.normals.push_back(Vec3(around.cross(along).normalized()).cast<float>());
      mesh.uv.emplace_back(static_cast<float>(sector) / kSectors, static_cast<float>(v));
    }
  }
  const auto at = [](std::size_t ring, int sector) {
    return static_cast<std::uint32_t>(ring * (kSectors + 1) + static_cast<std::size_t>(sector));
  };
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    for (int s = 0; s < kSectors; ++s) {
      mesh.indices.insert(mesh.indices.end(),
                          {at(i, s), at(i, s + 1), at(i + 1, s + 1), at(i, s), at(i + 1, s + 1), at(i + 1, s)});
    }
  }
  return mesh;
}

/// White with decreasing opacity.
picture::ImageData fading_image() {
  constexpr std::uint32_t kRows = 64;
  picture::ImageData image{1, kRows, {}, true};
  for (std::uint32_t row = 0; row < kRows; ++row) {
    // The first rows are opaque and the last ones empty, because the texture wraps around from its end to its
    // beginning.
    const double gone = std::clamp((row - 2.0) / (kRows - 8.0), 0.0, 1.0);
    const double left = 1 - gone * gone * (3 - 2 * gone);
    image.rgba.insert(image.rgba.end(), {255, 255, 255, static_cast<std::uint8_t>(std::lround(255 * left))});
  }
  return image;
}

/// The fading part is of the same cloth.
picture::MaterialData fading(picture::MaterialData cloth, std::uint32_t image) {
  cloth.base_colour_image = image;
  cloth.clear = true;
  cloth.double_sided = false;  // its inside is never visible
  cloth.alpha_cutoff = 0.01F;
  return cloth;
}

}  // namespace

SegmentPoses hand_at_tip(const Vec3& p_WT, bool holding, const picture::Camera& camera) {
  const SegmentPoses X_HS = place_hand(holding ? pinching_hand() : pointing_hand());
  const Vec3 tip_H = holding ? Vec3(0.5 * (finger_tip(X_HS, 0) + finger_tip(X_HS, 1))) : finger_tip(X_HS, 1);
  const Eigen::Matrix3d R_WC =
      picture::eye_view(camera, picture::Eye::middle, 1).V_CW.topLeftCorner<3, 3>().transpose().cast<double>();
  const Vec3 x = R_WC * kReach_C;
  const Vec3 back = R_WC * kBack_C;
  Mat3 R_WH;
  R_WH.col(0) = x;
  R_WH.col(1) = (back - back.dot(x) * x).normalized();
  R_WH.col(2) = R_WH.col(0).cross(R_WH.col(1));
  const Quat R(R_WH);
  const Pose X_WH{p_WT - R * tip_H, R};
  SegmentPoses X_WS;
  std::ranges::transform(X_HS, X_WS.begin(), [&](const Pose& X) { return X_WH * X; });
  return X_WS;
}

const std::vector<std::pair<std::string_view, HandLook>>& hand_look_names() {
  static const std::vector<std::pair<std::string_view, HandLook>> kNames{
      {"light", HandLook::light}, {"medium", HandLook::medium}, {"dark", HandLook::dark}, {"glove", HandLook::glove}};
  return kNames;
}

std::optional<HandLook> hand_look_of(std::string_view name) {
  for (const auto& [known, look] : hand_look_names())
    if (known == name) return look;
  return std::nullopt;
}

HandModel::HandModel(AssetLibrary& library) {
  for (std::size_t look = 0; look < kLooks.size(); ++look) {
    picture::MaterialData material;
    material.base_colour = kLooks[look].colour;
    material.roughness = kLooks[look].roughness;
    materials_[look] = library.add_material(material);
  }
  picture::MaterialData stale;
  stale.roughness = kLooks[static_cast<std::size_t>(HandLook::medium)].roughness;
  stale.base_colour = Eigen::Vector4f(0.42F, 0.40F, 0.38F, 1);
  stale_material_ = library.add_material(stale);
  picture::MaterialData linen;
  linen.base_colour = Eigen::Vector4f(0.36F, 0.30F, 0.22F, 1);
  linen.roughness = 0.95F;
  linen.double_sided = true;
  stale.roughness = linen.roughness;
  stale.double_sided = true;
  const std::uint32_t image = library.add_image(fading_image());
  sleeve_ = {library.add_mesh(sleeve_mesh(kSleeve)), library.add_material(linen), library.add_material(stale)};
  fading_sleeve_ = {library.add_mesh(sleeve_mesh(kFadingSleeve)), library.add_material(fading(linen, image)),
                    library.add_material(fading(stale, image))};
}

void HandModel::draw(const client::HandPose& hand, const picture::Camera& camera, picture::RenderScene& out) const {
  const bool glove = hand.kind == client::HandKind::glove;
  const SegmentPoses X_WS = glove ? hand.X_WS : hand_at_tip(hand.X_WS[0].p, hand.holding, camera);
  const hand::HandBuild build = glove ? build_of(X_WS) : hand::HandBuild{};
  out.soft_bodies.push_back({HandSkin::shared().follow(X_WS, build),
                             hand.stale ? stale_material_ : materials_[static_cast<std::size_t>(look_)]});
  for (const Sleeve* sleeve : {&sleeve_, &fading_sleeve_})
    out.instances.push_back(
        {sleeve->mesh, hand.stale ? sleeve->stale : sleeve->fresh, placed(X_WS[0], build.hand_scale), true});
  for (std::size_t i = 0; i < client::kHandSegments; ++i) {
    const double radius = i == 0 ? 0.030 : 0.010;
    out.occluders.push_back({X_WS[i].p.cast<float>(), static_cast<float>(build.length_scale(i) * radius)});
  }
}

}  // namespace mechane::scene
