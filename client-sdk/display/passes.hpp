// The passes of a picture, in the order in which they are drawn. Each owns its programs; all run on the context's thread and
// leave the framebuffer bound that they drew to.
#pragma once

#include "client-sdk/display/camera.hpp"
#include "client-sdk/display/gpu_assets.hpp"
#include "client-sdk/display/render_scene.hpp"
#include "client-sdk/display/render_target.hpp"
#include "client-sdk/display/shader.hpp"
#include "client-sdk/display/sky_light.hpp"
#include "client-sdk/display/stereo.hpp"

namespace mechane::display {

/// What every pass over one eye's picture needs.
struct PassInput {
  const RenderScene& scene;
  const GpuAssets& assets;
  const StreamedMesh& ropes;
  const EyeView& view;
  const SkyHarmonics& sky;
  const ShadowTarget& shadow;
  Eigen::Matrix4f PV_light;
  const HdrTarget& target;  ///< where they draw to
};

/// Depth from the sun, once for both eyes, and again only when something that throws a shadow has moved.
class ShadowPass {
 public:
  [[nodiscard]] static Expected<ShadowPass> create(std::uint32_t map_size);
  /// Returns world to clip space of the sun.
  Eigen::Matrix4f draw(const RenderScene& scene, const GpuAssets& assets, const StreamedMesh& ropes);
  /// The meshes are others from now on.
  void forget() { drawn_.clear(); }
  /// How often the map was drawn anew.
  [[nodiscard]] std::uint64_t times_drawn() const { return times_drawn_; }
  [[nodiscard]] const ShadowTarget& map() const { return map_; }

 private:
  ShadowPass(Program program, ShadowTarget map) : program_(std::move(program)), map_(std::move(map)) {}
  Program program_;
  ShadowTarget map_;
  std::vector<float> drawn_;  ///< all that the map depends on, as it was drawn
  std::uint64_t times_drawn_ = 0;
};

/// Everything solid, ropes, and the plain of earth. (A depth pass before it was tried: it costs more than it saves, here and with meshes of small
/// triangles on a software renderer.)
class OpaquePass {
 public:
  [[nodiscard]] static Expected<OpaquePass> create();
  void draw(const PassInput& input) const;

 private:
  OpaquePass(Program surface, Program rope, Program ground, GpuAssets plain)
      : surface_(std::move(surface)), rope_(std::move(rope)), ground_(std::move(ground)), plain_(std::move(plain)) {}
  Program surface_;
  Program rope_;
  Program ground_;
  GpuAssets plain_;
};

/// The sky, where nothing solid was drawn.
class SkyPass {
 public:
  [[nodiscard]] static Expected<SkyPass> create();
  void draw(const PassInput& input) const;

 private:
  SkyPass(Program program, VertexArrayName none) : program_(std::move(program)), no_vertices_(std::move(none)) {}
  Program program_;
  VertexArrayName no_vertices_;
};

/// Surfaces of water and falling water, blended over what is solid.
class WaterPass {
 public:
  [[nodiscard]] static Expected<WaterPass> create();
  void draw(const PassInput& input);

 private:
  WaterPass(Program surface, Program stream);
  void draw_stream(const WaterStream& stream);

  Program surface_;
  Program stream_;
  StreamedMesh tube_;
};

/// What is seen through: glass and the like, triangle by triangle from the farthest to the nearest, over all that is solid and over water.
class ClearPass {
 public:
  [[nodiscard]] static Expected<ClearPass> create();
  void draw(const PassInput& input) const;

 private:
  explicit ClearPass(Program program) : program_(std::move(program)) {}
  Program program_;
};

/// Steam, smoke, fire, dust, drops: over all else.
class ParticlePass {
 public:
  [[nodiscard]] static Expected<ParticlePass> create();
  void draw(const PassInput& input) const;

 private:
  explicit ParticlePass(Program program)
      : program_(std::move(program)), vertex_array_(make_vertex_array()), buffer_(make_buffer()) {}
  Program program_;
  VertexArrayName vertex_array_;
  BufferName buffer_;
};

/// From linear light with several samples a pixel to what a screen shows, into the bound framebuffer's viewport.
class TonePass {
 public:
  [[nodiscard]] static Expected<TonePass> create();
  void draw(const HdrTarget& from, float exposure) const;

 private:
  TonePass(Program program, VertexArrayName none) : program_(std::move(program)), no_vertices_(std::move(none)) {}
  Program program_;
  VertexArrayName no_vertices_;
};

/// The eyes' finished pictures into one: anaglyph or row by row. Into the bound framebuffer, all three of one size.
class CompositePass {
 public:
  [[nodiscard]] static Expected<CompositePass> create();
  /// `right_eye_first`: the uppermost row is the right eye's.
  void draw(const PictureTarget& left, const PictureTarget& right, Stereo stereo, bool right_eye_first) const;

 private:
  CompositePass(Program program, VertexArrayName none) : program_(std::move(program)), no_vertices_(std::move(none)) {}
  Program program_;
  VertexArrayName no_vertices_;
};

/// Depth is tested and not written; colours come multiplied by their opacity, over what is there.
void begin_blending();
void end_blending();

/// Sets the uniforms of sky.glsl and lighting.glsl; texture unit 4 holds the shadow map.
void set_lighting(const Program& program, const PassInput& input);

/// Width of a shadow map's texel in the world, metres.
[[nodiscard]] float shadow_texel_m(const Eigen::Matrix4f& PV_light, std::uint32_t map_size);

}  // namespace mechane::display
