// Draws views in the qualities `low` and `cached`: light becomes screen colours at once, one sample a pixel, and what
// stands still is lit, and throws its shadow, apart from what moves. On the context's thread, as all here.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "client-sdk/draw/passes/passes.hpp"
#include "client-sdk/draw/screen_region.hpp"
#include "client-sdk/draw/stillness.hpp"

namespace mechane::draw {

/// What one picture's views are drawn of. Must outlive the picture.
struct LowScene {
  const picture::RenderScene& scene;
  const GpuAssets& assets;
  const StreamedMesh& ropes;
  const std::vector<StreamedMesh>& soft_bodies;  ///< in the scene's order
  const SkyLight& sky;
  float exposure = 1;
};

class LowRenderer {
 public:
  /// A picture's views: two eyes, and a close-up.
  static constexpr std::size_t kViews = 3;
  /// After this many pictures in one pose a thing counts as still,
  static constexpr std::uint32_t kStill = 3;
  /// and after this many it is added to the kept pictures.
  static constexpr std::uint32_t kSettled = 90;
  /// A kept picture is made in so many pictures, a slice in each.
  static constexpr std::uint32_t kSlices = 8;

  /// Errors: the driver rejects a shader or a target.
  [[nodiscard]] static Expected<LowRenderer> create();

  /// Parts what moves from what stands still, and draws the shadow maps of both. Once a picture, before its views.
  void begin(const LowScene& low);
  /// Draws one of the picture's views, as seen by `view`. `keeps`: in the quality `cached`. While such a view changes,
  /// and until what stands still is kept, it is drawn at half its size. Errors: no memory for targets of this size.
  [[nodiscard]] Expected<void> draw_view(const LowScene& low, std::size_t index, const picture::EyeView& view,
                                         picture::PixelSize size, bool keeps);
  /// The same; but a view that is as it was in the last picture keeps that picture's image every other time.
  [[nodiscard]] Expected<void> draw_at_half_rate(const LowScene& low, std::size_t index, const picture::EyeView& view,
                                                 picture::PixelSize size, bool keeps);
  /// Puts that view into a picture, with smooth edges.
  void show(std::size_t index, const PictureArea& into) const;
  /// The meshes have been replaced.
  void forget();
  /// How often a kept picture was drawn, in whole and in part.
  [[nodiscard]] std::uint64_t times_kept() const { return times_kept_; }
  [[nodiscard]] std::uint64_t times_mended() const { return times_mended_; }

 private:
  struct Passes {
    ShadowPass still_shadow;
    ShadowPass mover_shadow;
    OpaquePass opaque;
    SkyPass sky;
    WaterPass water;
    ClearPass clear;
    ParticlePass particle;
    Program relight;
    Program smooth;
    VertexArrayName no_vertices;
  };
  struct View {
    std::optional<ScreenTarget> kept;
    std::optional<PictureTarget> smooth;  ///< `kept` with smooth edges
    std::optional<ScreenTarget> drawn;
    std::optional<ScreenTarget> half;
    const ScreenTarget* shown = nullptr;      ///< of the two
    std::uint64_t drawn_in = 0;               ///< the picture; 0: none
    std::vector<float> seen;                  ///< all numbers on which the last picture's still part depends
    std::vector<ScreenRegion> changed;        ///< pixels of `drawn` that may differ from `kept`
    std::uint32_t slices = 0;                 ///< of `kept`, from the left, that are as `seen` has it, but for `spoilt`
    std::vector<Eigen::AlignedBox3f> spoilt;  ///< where kept things have come or gone since

    [[nodiscard]] bool begun() const { return slices > 0; }
    [[nodiscard]] bool whole() const { return slices == kSlices; }
  };
  explicit LowRenderer(Passes passes) : passes_(std::move(passes)) {}
  void spoil(const Eigen::AlignedBox3f& box_W);
  void let_go(const GpuAssets& assets);
  void keep_what_rests(const LowScene& low);
  void keep_even_fires(const picture::RenderScene& scene, std::uint32_t enough);
  void part(const LowScene& low);
  void draw_shadows(const LowScene& low);
  [[nodiscard]] PassInput input_of(const LowScene& low, const picture::RenderScene& scene, const picture::EyeView& view,
                                   const ScreenTarget& target, bool movers) const;
  void draw_still(const LowScene& low, const picture::EyeView& view, const ScreenTarget& target,
                  const ScreenRegion& region, bool with_movers_shadows);
  void draw_moving(const LowScene& low, const picture::EyeView& view, const ScreenTarget& target);
  void draw_kept(const LowScene& low, const View& of, const picture::EyeView& view, const ScreenRegion& region);
  void mend(const LowScene& low, View& of, const picture::EyeView& view);
  [[nodiscard]] std::vector<ScreenRegion> shaded_regions(const picture::RenderScene& scene,
                                                         const picture::EyeView& view, picture::PixelSize size) const;
  [[nodiscard]] std::vector<ScreenRegion> changed_regions(const picture::RenderScene& scene,
                                                          const picture::EyeView& view, picture::PixelSize size) const;
  void relight(const LowScene& low, const View& of, const picture::EyeView& view) const;
  void smooth(const TextureName& picture) const;

  Passes passes_;
  StreamedMesh no_ropes_ = StreamedMesh::create();
  Stillness<InstanceKey> stillness_;
  Stillness<FireKey> evenness_;
  std::uint64_t picture_ = 1;   ///< their number
  std::uint32_t pictures_ = 0;  ///< since the meshes were replaced, up to kStill
  std::set<InstanceKey> kept_;  ///< what stands still: in the shadow maps and in the kept pictures
  std::set<FireKey> fires_;     ///< that burn evenly: only these give light there
  picture::RenderScene still_;
  picture::RenderScene moving_;
  std::vector<Eigen::AlignedBox3f> casters_W_;  ///< boxes of what moves and casts a shadow
  std::vector<Eigen::AlignedBox3f> others_W_;   ///< of all else that is drawn in each picture
  ShadowSetup still_setup_;
  ShadowSetup mover_setup_;
  std::array<View, kViews> views_;
  std::uint64_t times_kept_ = 0;
  std::uint64_t times_mended_ = 0;
};

}  // namespace mechane::draw
