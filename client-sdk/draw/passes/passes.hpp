// The passes of a picture, in drawing order. Each owns its programs; all run on the context's thread and leave their
// framebuffer bound.
#pragma once

#include <array>
#include <optional>

#include "client-sdk/draw/gpu_assets.hpp"
#include "client-sdk/draw/passes/shadow_cascades.hpp"
#include "client-sdk/draw/passes/sky_light.hpp"
#include "client-sdk/draw/render_target.hpp"
#include "client-sdk/draw/shader.hpp"
#include "client-sdk/picture/camera.hpp"
#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/picture/stereo.hpp"

namespace mechane::draw {

/// What a level water surface mirrors, as seen by one eye; opacity is 0 where it mirrors nothing.
struct MirrorImage {
  const TextureName* picture = nullptr;
  float height_m = 0;  ///< y in W
};

/// What the qualities `low` and `cached` add to a pass's input.
struct LowLight {
  float exposure = 1;
  const ShadowTarget* mover_shadow = nullptr;  ///< null: nothing moves, or its shadows are added later
  const ShadowSetup* mover_setup = nullptr;    ///< of that one map
  bool of_movers = false;                      ///< what is drawn is in that map itself
};

/// What every pass of one eye's picture needs.
struct PassInput {
  const picture::RenderScene& scene;
  const GpuAssets& assets;
  const StreamedMesh& ropes;
  const std::vector<StreamedMesh>& soft_bodies;  ///< in the scene's order
  const picture::EyeView& view;
  const SkyLight& sky;
  const ShadowTarget& shadow;
  const ShadowSetup& shadow_setup;
  picture::PixelSize size;             ///< of the target where the passes draw
  const TextureName& depth_of_solid;   ///< of all that is solid there, once it is drawn
  Eigen::Vector4f clip_W{0, 0, 0, 1};  ///< a plane: with GL_CLIP_DISTANCE0, nothing below it is drawn
  std::optional<MirrorImage> mirror{};
  std::optional<LowLight> low{};                       ///< for programs with Shading::screen
  Eigen::Matrix4f crop = Eigen::Matrix4f::Identity();  ///< from clip space to that of the part which is drawn
  float coarseness_px = 0;                             ///< how far solid surfaces may be off, pixels
};

/// Shadow maps from the sun, shared by both eyes; a map is drawn again only when something has moved that casts a
/// shadow there.
class ShadowPass {
 public:
  /// `coarseness_texels`: how far surfaces may be off there.
  [[nodiscard]] static Expected<ShadowPass> create(std::uint32_t map_size, float coarseness_texels = 0);
  /// Returns the places of the maps.
  ShadowSetup draw(const picture::RenderScene& scene, const GpuAssets& assets, const StreamedMesh& ropes,
                   const std::vector<StreamedMesh>& soft_bodies);
  /// The meshes have been replaced: all maps must be drawn again.
  void forget() { drawn_ = {}; }
  /// How many maps have been drawn.
  [[nodiscard]] std::uint64_t times_drawn() const { return times_drawn_; }
  [[nodiscard]] const ShadowTarget& maps() const { return maps_; }

 private:
  ShadowPass(Program program, ShadowTarget maps, float coarseness_texels)
      : program_(std::move(program)), maps_(std::move(maps)), coarseness_texels_(coarseness_texels) {}
  void begin_map(const ShadowSetup& setup, std::size_t cascade) const;

  Program program_;
  ShadowTarget maps_;
  float coarseness_texels_;
  std::array<std::vector<float>, kMostCascades> drawn_;  ///< the numbers with which each map was drawn
  std::uint64_t times_drawn_ = 0;
};

/// Everything solid, ropes, and the plain of earth. (A depth pass before it was tried: it costs more than it saves,
/// also with meshes of small triangles on a software renderer.)
class OpaquePass {
 public:
  [[nodiscard]] static Expected<OpaquePass> create(Shading shading);
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
  [[nodiscard]] static Expected<SkyPass> create(Shading shading);
  void draw(const PassInput& input) const;

 private:
  SkyPass(Program program, VertexArrayName none) : program_(std::move(program)), no_vertices_(std::move(none)) {}
  Program program_;
  VertexArrayName no_vertices_;
};

/// The mirror image in the water that fills most of the picture: draws the solid things and the sky once more, from
/// below the water, at half the size, and only where that water is. (Screen-space reflections would cost less in large
/// scenes, but visitors look down on the water, so what it mirrors is mostly outside the picture or seen from behind.)
class MirrorPass {
 public:
  [[nodiscard]] static Expected<MirrorPass> create();
  /// None where no level water is visible. The image is valid until the next one is drawn. Errors: no memory for
  /// targets of this size.
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

/// Surfaces of water and falling water, blended over what is solid. Needs the target's resolved depth.
class WaterPass {
 public:
  [[nodiscard]] static Expected<WaterPass> create(Shading shading);
  void draw(const PassInput& input);

 private:
  WaterPass(Program surface, Program stream);
  void draw_surfaces(const PassInput& input) const;
  void draw_stream(const picture::WaterStream& stream);

  Program surface_;
  Program stream_;
  StreamedMesh tube_;
};

/// Transparent meshes such as glass: triangle by triangle from the farthest to the nearest, over everything solid and
/// water.
class ClearPass {
 public:
  [[nodiscard]] static Expected<ClearPass> create(Shading shading);
  void draw(const PassInput& input) const;

 private:
  explicit ClearPass(Program program) : program_(std::move(program)) {}
  Program program_;
};

/// Steam, smoke, fire, dust, drops: over everything else. Needs the target's resolved depth.
class ParticlePass {
 public:
  [[nodiscard]] static Expected<ParticlePass> create(Shading shading);
  void draw(const PassInput& input) const;

 private:
  explicit ParticlePass(Program program)
      : program_(std::move(program)), vertex_array_(make_vertex_array()), buffer_(make_buffer()) {}
  Program program_;
  VertexArrayName vertex_array_;
  BufferName buffer_;
};

/// A glow around what is too bright for the screen: fire, the sun on bronze.
class BloomPass {
 public:
  [[nodiscard]] static Expected<BloomPass> create();
  /// Errors: no memory for targets of this size.
  [[nodiscard]] Expected<void> draw(const HdrTarget& from, float exposure);
  /// The glow, at a quarter of the last picture's size.
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

/// Ambient occlusion: darkens places where things meet, from the resolved depth of a picture with everything solid.
class AmbientOcclusionPass {
 public:
  [[nodiscard]] static Expected<AmbientOcclusionPass> create();
  /// Errors: no memory for targets of this size.
  [[nodiscard]] Expected<void> draw(const HdrTarget& from, const picture::EyeView& view);
  /// The visible share of the sky, at half of the last picture's size.
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

/// From linear light with several samples a pixel to screen colours, into the bound framebuffer's viewport.
class TonePass {
 public:
  struct Extras {
    const TextureName* glow = nullptr;      ///< null: none
    const TextureName* openness = nullptr;  ///< null: no ambient occlusion
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

/// Combines the eyes' finished pictures, as anaglyph or row by row, into the bound framebuffer; all three have the same
/// size.
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

/// Depth is tested but not written; premultiplied colours are blended over the picture.
void begin_blending();
void end_blending();

/// Sets the uniforms of sky.glsl and lighting.glsl; texture units 4 and 6 hold the shadow maps, 7 the sky.
void set_lighting(const Program& program, const PassInput& input);
/// Sets the uniforms of low.glsl and tone.glsl; texture unit 9 holds the movers' shadow map.
void set_low_light(const Program& program, const LowLight& low);

}  // namespace mechane::draw
