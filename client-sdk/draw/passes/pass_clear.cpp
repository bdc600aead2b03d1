#include <algorithm>
#include <tuple>

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/passes.hpp"

namespace mechane::draw {
namespace {

struct ClearTriangle {
  float distance_m = 0;
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
};

/// All transparent triangles, the farthest first.
std::vector<ClearTriangle> from_back_to_front(const PassInput& input) {
  std::vector<ClearTriangle> out;
  for (std::uint32_t i = 0; i < input.scene.instances.size(); ++i) {
    const picture::Instance& instance = input.scene.instances[i];
    if (!input.assets.is_clear(instance.material)) continue;
    const std::vector<Vec3f>& middles_M = input.assets.triangle_middles(instance.mesh);
    for (std::uint32_t k = 0; k < middles_M.size(); ++k)
      out.push_back({(instance.X_WM * middles_M[k] - input.view.p_WE).norm(), i, k});
  }
  std::ranges::sort(out, [](const ClearTriangle& a, const ClearTriangle& b) {
    return std::tie(b.distance_m, a.instance, a.triangle) < std::tie(a.distance_m, b.instance, b.triangle);
  });
  return out;
}

}  // namespace

Expected<ClearPass> ClearPass::create(Shading shading) {
  Expected<Program> program =
      Program::link(shading, {"mesh.vert"}, {"sky.glsl", "lighting.glsl", "material.glsl", "clear.frag"});
  if (!program) return tl::unexpected(program.error());
  return ClearPass(std::move(*program));
}

void ClearPass::draw(const PassInput& input) const {
  const std::vector<ClearTriangle> triangles = from_back_to_front(input);
  if (triangles.empty()) return;
  begin_blending();
  program_.use();
  set_lighting(program_, input);
  set_material_units(program_);
  std::vector<std::uint32_t> run;
  for (std::size_t first = 0; first < triangles.size();) {
    const std::uint32_t of = triangles[first].instance;
    run.clear();
    for (; first < triangles.size() && triangles[first].instance == of; ++first)
      run.push_back(triangles[first].triangle);
    const picture::Instance& instance = input.scene.instances[of];
    set_model(program_, instance.X_WM);
    input.assets.use_material(instance.material, program_);
    input.assets.draw_triangles(instance.mesh, run);
  }
  end_blending();
}

}  // namespace mechane::draw
