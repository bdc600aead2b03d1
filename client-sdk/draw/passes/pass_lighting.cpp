#include <algorithm>

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/particles.hpp"
#include "client-sdk/draw/passes/passes.hpp"

namespace mechane::draw {
namespace {

constexpr int kShadowUnit = 4;
constexpr int kSkyUnit = 7;
constexpr int kShadowDepthUnit = 6;
constexpr int kMoverShadowUnit = 9;
/// A sphere beyond which the occluders have no visible effect.
Eigen::Vector4f bound_of(const std::vector<picture::Occluder>& occluders) {
  Vec3f middle = Vec3f::Zero();
  float largest = 0;
  for (const picture::Occluder& o : occluders) {
    middle += o.p_WO / static_cast<float>(occluders.size());
    largest = std::max(largest, o.radius_m);
  }
  float reach = 0;
  for (const picture::Occluder& o : occluders)
    reach = std::max(reach, (o.p_WO - middle).norm());
  return {middle.x(), middle.y(), middle.z(), reach + 7 * largest};
}

void set_shadows(const Program& program, const PassInput& input) {
  const ShadowSetup& setup = input.shadow_setup;
  program.set("X_LW", setup.X_LW);
  program.set("shadow_range", Eigen::Vector2f(setup.nearest_m, setup.depth_m));
  std::vector<Eigen::Vector4f> cascades;
  for (const ShadowCascade& c : setup.cascades)
    cascades.emplace_back(c.middle_L.x(), c.middle_L.y(), c.half_m, c.texel_m(input.shadow.size));
  program.set("cascade_count", static_cast<int>(cascades.size()));
  program.set("cascades", cascades);
  program.set("shadow_maps", kShadowUnit);
  program.set("shadow_depths", kShadowDepthUnit);
  for (const int unit : {kShadowUnit, kShadowDepthUnit}) {
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    glBindTexture(GL_TEXTURE_2D_ARRAY, input.shadow.depth.get());
  }
  glBindSampler(kShadowDepthUnit, input.shadow.plain_depth.get());
}

void set_occluders(const Program& program, const picture::RenderScene& scene) {
  std::vector<Eigen::Vector4f> occluders;
  for (const picture::Occluder& o : scene.occluders) {
    if (occluders.size() < picture::kMaxOccluders)
      occluders.emplace_back(o.p_WO.x(), o.p_WO.y(), o.p_WO.z(), o.radius_m);
  }
  program.set("occluder_count", static_cast<int>(occluders.size()));
  program.set("occluders", occluders);
  if (!occluders.empty()) program.set("occluder_bound", bound_of(scene.occluders));
}

}  // namespace

void set_low_light(const Program& program, const LowLight& low) {
  program.set("exposure", low.exposure);
  program.set("movers_shade", low.mover_shadow != nullptr ? 1 : 0);
  program.set("mover_map", kMoverShadowUnit);
  program.set("mover_lift_m", 0.0F);  // a program keeps its last value
  if (low.mover_shadow == nullptr) return;
  program.set("mover_PV", low.mover_setup->PV(0));
  const float texel_m = low.mover_setup->cascades.front().texel_m(low.mover_shadow->size);
  program.set("mover_lift_m", low.of_movers ? 2.5F * texel_m : 0.0F);
  glActiveTexture(GL_TEXTURE0 + kMoverShadowUnit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, low.mover_shadow->depth.get());
}

void set_lighting(const Program& program, const PassInput& input) {
  const picture::RenderScene& scene = input.scene;
  program.set("to_sun", Vec3f(scene.sun.to_sun_W.normalized()));
  program.set("sun_irradiance", scene.sun.irradiance);
  program.set("eye_W", input.view.p_WE);
  program.set("sh", input.sky.harmonics);
  program.set("sky_on", scene.sky ? 1.0F : 0.0F);
  program.set("sky_cube", kSkyUnit);
  glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + kSkyUnit));
  glBindTexture(GL_TEXTURE_CUBE_MAP, input.sky.cube.get());
  set_shadows(program, input);
  if (input.low) {
    set_low_light(program, *input.low);
    program.set("occluder_count", 0);
  } else {
    set_occluders(program, scene);
  }
  const std::vector<Eigen::Vector4f> fires = fire_lights(scene, input.low ? FireLight::steady : FireLight::flickering);
  program.set("fire_count", static_cast<int>(fires.size()));
  program.set("fires", fires);
  const Eigen::Matrix4f PV = input.view.P * input.view.V_CW;
  program.set("PV", PV);
  program.set("clip_W", input.clip_W);
}

}  // namespace mechane::draw
