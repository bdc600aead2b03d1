#include <algorithm>

#include <epoxy/gl.h>

#include "client-sdk/display/particles.hpp"
#include "client-sdk/display/passes.hpp"

namespace mechane::display {
namespace {

constexpr int kShadowUnit = 4;
/// The sun's disc is half a degree wide: 10 mm of soft edge for a caster a metre away, and a little more for the eye's pleasure.
constexpr float kShadowEdge_m = 0.014F;

/// A sphere outside of which the occluders darken nothing that an eye would see.
Eigen::Vector4f bound_of(const std::vector<Occluder>& occluders) {
  Vec3f middle = Vec3f::Zero();
  float largest = 0;
  for (const Occluder& o : occluders) {
    middle += o.p_WO / static_cast<float>(occluders.size());
    largest = std::max(largest, o.radius_m);
  }
  float reach = 0;
  for (const Occluder& o : occluders)
    reach = std::max(reach, (o.p_WO - middle).norm());
  return {middle.x(), middle.y(), middle.z(), reach + 7 * largest};
}

}  // namespace

float shadow_texel_m(const Eigen::Matrix4f& PV_light, std::uint32_t map_size) {
  const float across = 2.0F / PV_light.block<1, 3>(0, 0).norm();
  const float up = 2.0F / PV_light.block<1, 3>(1, 0).norm();
  return std::max(across, up) / static_cast<float>(map_size);
}

void set_lighting(const Program& program, const PassInput& input) {
  const RenderScene& scene = input.scene;
  program.set("to_sun", Vec3f(scene.sun.to_sun_W.normalized()));
  program.set("sun_irradiance", scene.sun.irradiance);
  program.set("eye_W", input.view.p_WE);
  program.set("sh", input.sky);
  program.set("sky_on", scene.sky ? 1.0F : 0.0F);
  program.set("PV_light", input.PV_light);
  const float texel_m = shadow_texel_m(input.PV_light, input.shadow.size);
  program.set("shadow_texel_m", texel_m);
  program.set("shadow_blur_texels", std::clamp(kShadowEdge_m / texel_m, 1.2F, 8.0F));
  std::vector<Eigen::Vector4f> occluders;
  for (const Occluder& o : scene.occluders) {
    if (occluders.size() < kMaxOccluders) occluders.emplace_back(o.p_WO.x(), o.p_WO.y(), o.p_WO.z(), o.radius_m);
  }
  program.set("occluder_count", static_cast<int>(occluders.size()));
  program.set("occluders", occluders);
  if (!occluders.empty()) program.set("occluder_bound", bound_of(scene.occluders));
  const std::vector<Eigen::Vector4f> fires = fire_lights(scene);
  program.set("fire_count", static_cast<int>(fires.size()));
  program.set("fires", fires);
  program.set("shadow_map", kShadowUnit);
  glActiveTexture(GL_TEXTURE0 + kShadowUnit);
  glBindTexture(GL_TEXTURE_2D, input.shadow.depth.get());
  const Eigen::Matrix4f PV = input.view.P * input.view.V_CW;
  program.set("PV", PV);
}

}  // namespace mechane::display
