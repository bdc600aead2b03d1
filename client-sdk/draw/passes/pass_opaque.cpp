#include <algorithm>
#include <cmath>
#include <tuple>

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/passes.hpp"
#include "client-sdk/picture/procedural_mesh.hpp"

namespace mechane::draw {

namespace {

struct SolidPiece {
  float steps_away = 0;
  std::uint32_t instance = 0;
  std::uint32_t piece = 0;
};

GpuAssets::Level level_of(const picture::Instance& instance, const PassInput& input) {
  if (input.coarseness_px <= 0) return input.assets.level(instance.mesh);
  const float away_m = distance_m(instance.X_WM, input.assets.box(instance.mesh), input.view.p_WE);
  const float error_m = input.coarseness_px * pixel_m(input.view, input.size, away_m);
  return input.assets.level(instance.mesh, error_m / scale_of(instance.X_WM));
}

/// The visible pieces of solid meshes (land, or all others), the nearest first, so that hidden fragments are not lit.
/// The order is by logarithmic steps of distance, two per doubling, so that pieces of one thing stay together and the
/// order changes little while something moves.
std::vector<SolidPiece> from_front_to_back(const PassInput& input, bool land) {
  const Eigen::Matrix4f PV = input.crop * input.view.P * input.view.V_CW;
  std::vector<SolidPiece> out;
  for (std::uint32_t i = 0; i < input.scene.instances.size(); ++i) {
    const picture::Instance& instance = input.scene.instances[i];
    if (input.assets.is_clear(instance.material) || input.assets.is_land(instance.material) != land) continue;
    const Eigen::Matrix4f PV_MC = PV * instance.X_WM.matrix();
    const std::vector<MeshPiece>& pieces = input.assets.pieces(instance.mesh);
    const GpuAssets::Level level = level_of(instance, input);
    for (std::uint32_t k = level.first; k < level.end; ++k) {
      if (is_outside(PV_MC, pieces[k].box_M)) continue;
      const float away_m = distance_m(instance.X_WM, pieces[k].box_M, input.view.p_WE);
      out.push_back({std::floor(2 * std::log2(std::max(away_m, 0.1F))), i, k});
    }
  }
  std::ranges::sort(out, [](const SolidPiece& a, const SolidPiece& b) {
    return std::tie(a.steps_away, a.instance, a.piece) < std::tie(b.steps_away, b.instance, b.piece);
  });
  return out;
}

void begin_materials(const Program& program, const PassInput& input) {
  program.use();
  set_lighting(program, input);
  set_material_units(program);
}

void draw_solid(const std::vector<SolidPiece>& solid, const Program& program, const PassInput& input) {
  std::vector<ShownPieces> shown;
  for (const SolidPiece& one : solid) {
    if (shown.empty() || shown.back().instance != one.instance) shown.push_back({one.steps_away, one.instance, {}});
    shown.back().pieces.push_back(one.piece);
  }
  for (const InstanceRun& run : runs_of(input.scene.instances, shown)) {
    input.assets.use_material(run.material, program);
    input.assets.draw(run, program);
  }
}

}  // namespace

Expected<OpaquePass> OpaquePass::create(Shading shading) {
  Expected<Program> surface =
      Program::link(shading, {"mesh.vert"}, {"sky.glsl", "lighting.glsl", "material.glsl", "surface.frag"});
  if (!surface) return tl::unexpected(surface.error());
  Expected<Program> rope =
      Program::link(shading, {"mesh.vert"}, {"sky.glsl", "lighting.glsl", "noise.glsl", "rope.frag"});
  if (!rope) return tl::unexpected(rope.error());
  Expected<Program> ground =
      Program::link(shading, {"mesh.vert"}, {"sky.glsl", "lighting.glsl", "noise.glsl", "land.glsl", "ground.frag"});
  if (!ground) return tl::unexpected(ground.error());
  GpuAssets plain;
  picture::SceneAssets assets;
  assets.meshes.push_back(picture::disc_mesh(380, 64));
  // For exhibits without land of their own: level ground of even texture.
  assets.images.push_back({1, 1, {128, 128, 128, 255}, true});
  assets.images.push_back({1, 1, {128, 128, 255, 255}, false});
  picture::MaterialData even;
  even.land = true;
  even.base_colour_image = 0;
  even.normal_image = 1;
  assets.materials.push_back(even);
  plain.upload(assets);
  return OpaquePass(std::move(*surface), std::move(*rope), std::move(*ground), std::move(plain));
}

void OpaquePass::draw(const PassInput& input) const {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  begin_materials(surface_, input);
  draw_solid(from_front_to_back(input, false), surface_, input);
  for (std::size_t i = 0; i < input.scene.soft_bodies.size(); ++i) {
    set_model(surface_, Eigen::Affine3f::Identity());
    input.assets.use_material(input.scene.soft_bodies[i].material, surface_);
    input.soft_bodies[i].draw();
  }
  if (!input.ropes.empty()) {
    glEnable(GL_CULL_FACE);
    rope_.use();
    set_lighting(rope_, input);
    set_model(rope_, Eigen::Affine3f::Identity());
    input.ropes.draw();
  }
  glDisable(GL_CULL_FACE);
  begin_materials(ground_, input);
  constexpr float kNone_m = -1e6F;
  ground_.set("plain_height_m", input.scene.ground_height_m.value_or(kNone_m));
  draw_solid(from_front_to_back(input, true), ground_, input);
  glDisable(GL_CULL_FACE);
  if (input.scene.ground_height_m) draw_plain(input);
}

void OpaquePass::draw_plain(const PassInput& input) const {
  Eigen::Affine3f X_WM = Eigen::Affine3f::Identity();
  X_WM.translation() = Vec3f(input.view.p_WE.x(), *input.scene.ground_height_m, input.view.p_WE.z());
  set_model(ground_, X_WM);
  const std::optional<std::uint32_t> land = input.scene.land_material;
  if (land && input.assets.is_land(*land)) {
    input.assets.use_material(*land, ground_);
  } else {
    plain_.use_material(0, ground_);
  }
  glDisable(GL_CULL_FACE);
  plain_.draw(0);
}

}  // namespace mechane::draw
