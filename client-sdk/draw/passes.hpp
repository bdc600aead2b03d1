// The passes of a picture, in the order in which they are drawn. Each owns its programs; all run on the context's thread and
// leave the framebuffer bound that they drew to.
#pragma once

#include <array>
#include <optional>

#include "client-sdk/draw/gpu_assets.hpp"
#include "client-sdk/draw/render_target.hpp"
#include "client-sdk/draw/shader.hpp"
#include "client-sdk/draw/shadow_cascades.hpp"
#include "client-sdk/draw/sky_light.hpp"
#include "client-sdk/picture/camera.hpp"
#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/picture/stereo.hpp"

namespace mechane::draw {

/// What a level water mirrors, seen by one eye: opacity is 0 where there is none.
struct MirrorImage {
  const TextureName* picture = nullptr;
  float height_m = 0;  ///< y in W
};

/// What every pass over one eye's picture needs.
struct PassInput {
  const picture::RenderScene& scene;
  const GpuAssets& assets;
  const StreamedMesh& ropes;
  const std::vector<StreamedMesh>& soft_bodies;  ///< as the scene has them
  const picture::EyeView& view;
  const SkyLight& sky;
  const ShadowTarget& shadow;
  const ShadowSetup& shadow_setup;
  const HdrTarget& target;             ///< where they draw to
  Eigen::Vector4f clip_W{0, 0, 0, 1};  ///< a plane: with GL_CLIP_DISTANCE0, what is below it is not drawn
  std::optional<MirrorImage> mirror{};
};

/// Depth from the sun, once for both eyes, and a map again only when something has moved that throws a shadow there.
class ShadowPass {
 public:
  [[nodiscard]] static Expected<ShadowPass> create(std::uint32_t map_size);
  /// Returns where the maps lie.
  ShadowSetup draw(const picture::RenderScene& scene, const GpuAssets& assets, const StreamedMesh& ropes,
                   const std::vector<StreamedMesh>& soft_bodies);
  /// The meshes are others from now on.
  void forget() { drawn_ = {}; }
  /// How many maps were drawn.
  [[nodiscard]] std::uint64_t times_drawn() const { return times_drawn_; }
  [[nodiscard]] const ShadowTarget& maps() const { return maps_; }

 private:
  ShadowPass(Program program, ShadowTarget maps) : program_(std::move(program)), maps_(std::move(maps)) {}
  void begin_map(const ShadowSetup& setup, std::size_t cascade) const;

  Program program_;
  ShadowTarget maps_;
  std::array<std::vector<float>, kMostCascades> drawn_;  ///< all that a map depends on, as it was drawn
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
  void draw_plain(const PassInput& input) const;

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

/// What stands about the water that fills most of the picture, mirrored in it: the solid things and the sky once more, from under the water,
/// at half the size, and only where that water is. (A walk along the picture's own depth would cost less where there is much to draw, but a
/// visitor looks down on the water: what it mirrors is mostly above the picture's edge or turned away.)
class MirrorPass {
 public:
  [[nodiscard]] static Expected<MirrorPass> create();
  /// None where no level water is in sight. The image is good until the next is drawn. Errors: no memory for targets of this size.
  [[nodiscard]] Expected<std::optional<MirrorImage>> draw(const PassInput& input, const OpaquePass& opaque,
                                                          const SkyPass& sky);

 private:
  explicit MirrorPass(Program program) : program_(std::move(program)) {}
  void mark_water(const PassInput& input, float height_m) const;
  [[nodiscard]] Expected<const MirrorTarget*> fit(picture::PixelSize size);

  static constexpr std::size_t kSizes = 2;  ///< a picture's and a close-up's
  Program program_;
  std::vector<MirrorTarget> targets_;
};

/// Surfaces of water and falling water, blended over what is solid. Wants the target's depth resolved.
class WaterPass {
 public:
  [[nodiscard]] static Expected<WaterPass> create();
  void draw(const PassInput& input);

 private:
  WaterPass(Program surface, Program stream);
  void draw_surfaces(const PassInput& input) const;
  void draw_stream(const picture::WaterStream& stream);

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

/// Steam, smoke, fire, dust, drops: over all else. Wants the target's depth resolved.
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

/// A glow about what is too bright for the screen: fire, the sun on bronze.
class BloomPass {
 public:
  [[nodiscard]] static Expected<BloomPass> create();
  /// Errors: no memory for targets of this size.
  [[nodiscard]] Expected<void> draw(const HdrTarget& from, float exposure);
  /// A quarter of the size that was drawn last.
  [[nodiscard]] const TextureName& glow() const { return levels_.front().colour; }

 private:
  BloomPass(Program bright, Program blur, VertexArrayName none)
      : bright_(std::move(bright)), blur_(std::move(blur)), no_vertices_(std::move(none)) {}
  [[nodiscard]] Expected<void> fit(picture::PixelSize size);
  void blur(const FloatTarget& from, const FloatTarget& to) const;

  Program bright_;
  Program blur_;
  VertexArrayName no_vertices_;
  std::vector<FloatTarget> levels_;  ///< each half as wide as the one before
};

/// Where things meet, little of the sky arrives: found from the resolved depth of a picture in which all that is solid was drawn.
class AmbientOcclusionPass {
 public:
  [[nodiscard]] static Expected<AmbientOcclusionPass> create();
  /// Errors: no memory for targets of this size.
  [[nodiscard]] Expected<void> draw(const HdrTarget& from, const picture::EyeView& view);
  /// Share of the sky that is open, at half of the size that was drawn last.
  [[nodiscard]] const TextureName& openness() const { return even_->colour; }

 private:
  AmbientOcclusionPass(Program occlusion, Program blur, VertexArrayName none)
      : occlusion_(std::move(occlusion)), blur_(std::move(blur)), no_vertices_(std::move(none)) {}

  Program occlusion_;
  Program blur_;
  VertexArrayName no_vertices_;
  std::optional<FloatTarget> raw_;
  std::optional<FloatTarget> even_;
};

/// From linear light with several samples a pixel to what a screen shows, into the bound framebuffer's viewport.
class TonePass {
 public:
  struct Extras {
    const TextureName* glow = nullptr;  ///< null: neither glow nor ambient occlusion
    const TextureName* openness = nullptr;
    float glow_share = 0;
    float occlusion_share = 0;
  };
  [[nodiscard]] static Expected<TonePass> create();
  void draw(const HdrTarget& from, float exposure, const Extras& extras) const;

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
  void draw(const PictureTarget& left, const PictureTarget& right, picture::Stereo stereo, bool right_eye_first) const;

 private:
  CompositePass(Program program, VertexArrayName none) : program_(std::move(program)), no_vertices_(std::move(none)) {}
  Program program_;
  VertexArrayName no_vertices_;
};

/// Depth is tested and not written; colours come multiplied by their opacity, over what is there.
void begin_blending();
void end_blending();

/// Sets the uniforms of sky.glsl and lighting.glsl; texture units 4 and 6 hold the shadow maps, 7 the sky.
void set_lighting(const Program& program, const PassInput& input);

}  // namespace mechane::draw
