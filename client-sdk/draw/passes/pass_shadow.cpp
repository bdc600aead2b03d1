#include <epoxy/gl.h>

#include "client-sdk/draw/passes/passes.hpp"

namespace mechane::draw {
namespace {

/// The meshes that cast shadows into this map, where their surfaces may be off by error_m.
std::vector<ShownPieces> throwers(const picture::RenderScene& scene, const GpuAssets& assets, const ShadowSetup& setup,
                                  std::size_t cascade, float error_m) {
  const Eigen::Matrix4f PV = setup.PV(cascade);
  std::vector<ShownPieces> out;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const picture::Instance& instance = scene.instances[i];
    if (!instance.casts_shadow || assets.is_clear(instance.material)) continue;
    const Eigen::Matrix4f PV_M = PV * instance.X_WM.matrix();
    const std::vector<MeshPiece>& pieces = assets.pieces(instance.mesh);
    ShownPieces thrower{0, i, {}};
    const GpuAssets::Level level = assets.level(instance.mesh, error_m / scale_of(instance.X_WM));
    for (std::uint32_t k = level.first; k < level.end; ++k) {
      const Eigen::AlignedBox3f& box_M = pieces[k].box_M;
      if (!is_outside(PV_M, box_M) && !is_shadow_within(setup, cascade, instance.X_WM, box_M))
        thrower.pieces.push_back(k);
    }
    if (!thrower.pieces.empty()) out.push_back(std::move(thrower));
  }
  return out;
}

/// Whether a mesh with these points casts a shadow into this map.
bool throws_into(const std::vector<Vec3f>& points_W, const ShadowSetup& setup, std::size_t cascade) {
  Eigen::AlignedBox3f box_W;
  for (const Vec3f& p : points_W)
    box_W.extend(p);
  if (box_W.isEmpty()) return false;
  return !is_outside(setup.PV(cascade), box_W) && !is_shadow_within(setup, cascade, Eigen::Affine3f::Identity(), box_W);
}

/// All numbers on which a map depends.
std::vector<float> shadows_of(const picture::RenderScene& scene, const std::vector<ShownPieces>& solid,
                              const ShadowSetup& setup, std::size_t cascade) {
  const Eigen::Matrix4f PV = setup.PV(cascade);
  std::vector<float> out(PV.data(), PV.data() + PV.size());
  for (const ShownPieces& thrower : solid) {
    const picture::Instance& instance = scene.instances[thrower.instance];
    out.push_back(static_cast<float>(instance.mesh));
    out.insert(out.end(), instance.X_WM.data(), instance.X_WM.data() + 16);
  }
  for (const picture::RenderRope& rope : scene.ropes) {
    if (!throws_into(rope.points_W, setup, cascade)) continue;
    out.push_back(rope.radius_m);
    out.push_back(static_cast<float>(rope.points_W.size()));
    for (const Vec3f& p : rope.points_W)
      out.insert(out.end(), p.begin(), p.end());
  }
  for (const picture::SoftBody& body : scene.soft_bodies) {
    const std::vector<Vec3f>& points_W = body.mesh_W.positions;
    if (!throws_into(points_W, setup, cascade)) continue;
    // Some of its vertices are enough to notice a motion.
    for (std::size_t i = 0; i < points_W.size(); i += 16)
      out.insert(out.end(), points_W[i].begin(), points_W[i].end());
  }
  return out;
}

}  // namespace

Expected<ShadowPass> ShadowPass::create(std::uint32_t map_size, float coarseness_texels) {
  Expected<Program> program = Program::link({"depth.vert"}, {"depth.frag"});
  if (!program) return tl::unexpected(program.error());
  Expected<ShadowTarget> map = ShadowTarget::create(map_size, kMostCascades);
  if (!map) return tl::unexpected(map.error());
  return ShadowPass(std::move(*program), std::move(*map), coarseness_texels);
}

ShadowSetup ShadowPass::draw(const picture::RenderScene& scene, const GpuAssets& assets, const StreamedMesh& ropes,
                             const std::vector<StreamedMesh>& soft_bodies) {
  ShadowSetup setup = shadow_setup(scene.focus_box_W, scene.shadow_box_W, scene.sun.to_sun_W, maps_.size);
  for (std::size_t cascade = 0; cascade < setup.cascades.size(); ++cascade) {
    const std::vector<ShownPieces> solid =
        throwers(scene, assets, setup, cascade, coarseness_texels_ * setup.cascades[cascade].texel_m(maps_.size));
    std::vector<float> wanted = shadows_of(scene, solid, setup, cascade);
    if (wanted == drawn_[cascade]) continue;
    drawn_[cascade] = std::move(wanted);
    ++times_drawn_;
    begin_map(setup, cascade);
    for (const InstanceRun& run : runs_of(scene.instances, solid))
      assets.draw(run, program_);
    program_.set("X_WM", Eigen::Matrix4f(Eigen::Matrix4f::Identity()));
    ropes.draw();
    for (std::size_t i = 0; i < scene.soft_bodies.size(); ++i) {
      if (throws_into(scene.soft_bodies[i].mesh_W.positions, setup, cascade)) soft_bodies[i].draw();
    }
    glDisable(GL_DEPTH_CLAMP);
  }
  return setup;
}

void ShadowPass::begin_map(const ShadowSetup& setup, std::size_t cascade) const {
  maps_.bind_layer(static_cast<std::uint32_t>(cascade));
  glViewport(0, 0, static_cast<GLsizei>(maps_.size), static_cast<GLsizei>(maps_.size));
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  // Both sides of thin boards cast shadows; so does what is nearer to the sun than the map's range.
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_CLAMP);
  glClear(GL_DEPTH_BUFFER_BIT);
  program_.use();
  program_.set("PV", setup.PV(cascade));
}

}  // namespace mechane::draw
