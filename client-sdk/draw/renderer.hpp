// Draws a RenderScene: one eye or two, pass after pass. Made, used and destroyed on the thread of a current OpenGL
// context.
#pragma once

#include <array>
#include <chrono>
#include <ctime>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "client-sdk/draw/low_renderer.hpp"
#include "client-sdk/draw/passes/passes.hpp"
#include "client-sdk/draw/quality.hpp"
#include "client-sdk/draw/text/overlay_pass.hpp"
#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/picture/stereo.hpp"

namespace mechane::draw {

struct RendererSettings {
  Quality quality = Quality::high;       ///< at the start
  int samples = 4;                       ///< a pixel, 1..8, in the quality `high`
  std::uint32_t shadow_map_size = 2048;  ///< in `high` and `medium`
  float exposure = 1.15F;
  float glow = 0.16F;               ///< share of too bright light that is spread around it
  float ambient_occlusion = 0.45F;  ///< how much places where things meet are darkened, 0..1
  bool profile = false;             ///< waits for each pass and measures it: pass_times()
  bool right_eye_first = false;     ///< row_interleaved: the screen's uppermost row is the right eye's
  std::string font_folder = default_font_folder();
};

/// The duration of a pass.
struct PassTime {
  const char* pass = "";
  double wall_ms = 0;
  double cpu_ms = 0;  ///< of all threads of this process: a software renderer's cost
};

class Renderer {
 public:
  /// Errors: the driver rejects a shader or a target; a font is missing.
  [[nodiscard]] static Expected<std::unique_ptr<Renderer>> create(const RendererSettings& settings);

  /// Uploads what is new in `assets`.
  void upload(const picture::SceneAssets& assets) { assets_.upload(assets); }
  /// What did not fit on the graphics card: see GpuAssets.
  [[nodiscard]] const std::set<std::string>& refused() const { return assets_.refused(); }
  /// Frees all that was uploaded, for another scenario.
  void forget_assets() {
    assets_ = {};
    if (full_) full_->shadow.forget();
    if (low_) low_->forget();
  }
  [[nodiscard]] Quality quality() const { return quality_; }
  /// From the next picture on.
  void set_quality(Quality quality) { quality_ = quality; }
  /// How many shadow maps have been drawn in `high` and `medium`; none are added by a picture in which nothing moved.
  [[nodiscard]] std::uint64_t shadow_maps_drawn() const { return full_ ? full_->shadow.times_drawn() : 0; }
  /// What draws in `low` and `cached`; null before the first such picture.
  [[nodiscard]] const LowRenderer* low() const { return low_ ? &*low_ : nullptr; }
  /// For row-interleaved screens, whose rows belong to the eyes alternately: sets the screen row of the picture's
  /// uppermost row.
  void begin_at_row(int row) { odd_row_ = row % 2 != 0; }
  /// Draws into the renderer's own picture. Errors: no memory for targets of this size.
  [[nodiscard]] Expected<void> draw(const picture::RenderScene& scene, picture::Stereo stereo, picture::PixelSize size);
  /// The last picture, upper row first. Waits for the graphics card. With quad_buffer: the picture of that eye.
  [[nodiscard]] picture::ImageData read_picture(picture::Eye eye = picture::Eye::left) const;
  /// The passes of the last picture in drawing order, first one eye's, then the other's. Empty without
  /// RendererSettings::profile.
  [[nodiscard]] const std::vector<PassTime>& pass_times() const { return pass_times_; }
  /// Lays out the scene's words, before it is drawn.
  const OverlayLayout& lay_out(const picture::RenderScene& scene, picture::Stereo stereo, picture::PixelSize size) {
    return overlay_.lay_out(scene, picture::seen_size(stereo, size));
  }
  /// The overlay of the last picture, in pixels of one eye's picture.
  [[nodiscard]] const OverlayLayout& overlay() const { return overlay_.layout(); }
  /// Waits until the last picture is drawn.
  static void finish();
  /// Copies the last picture into the window; after quad_buffer, into both of its pictures.
  void copy_to_window(picture::PixelSize window) const;

 private:
  /// Of `high` and `medium`.
  struct FullPasses {
    ShadowPass shadow;
    OpaquePass opaque;
    SkyPass sky;
    MirrorPass mirror;
    WaterPass water;
    ClearPass clear;
    ParticlePass particle;
    BloomPass bloom;
    AmbientOcclusionPass ambient_occlusion;
    TonePass tone;
  };
  [[nodiscard]] static Expected<FullPasses> make_full(std::uint32_t shadow_map_size);
  Renderer(const RendererSettings& settings, CompositePass composite, OverlayPass overlay)
      : settings_(settings),
        quality_(settings.quality),
        composite_(std::move(composite)),
        overlay_(std::move(overlay)) {}
  [[nodiscard]] bool is_low() const { return quality_ == Quality::low || quality_ == Quality::cached; }
  [[nodiscard]] Expected<void> fit_passes();
  [[nodiscard]] Expected<void> fit_targets(picture::Stereo stereo, picture::PixelSize picture, bool inset);
  [[nodiscard]] Expected<void> fit_sky(const picture::Sun& sun);
  void upload_moving(const picture::RenderScene& scene);
  /// Starts measuring; with a name: ends this pass and starts the next.
  void mark(const char* pass);
  /// Draws both eyes, and before them the close-up.
  [[nodiscard]] Expected<void> draw_full(const picture::RenderScene& scene, picture::Stereo stereo);
  [[nodiscard]] Expected<void> draw_low(const picture::RenderScene& scene, picture::Stereo stereo);
  [[nodiscard]] Expected<void> draw_view(const picture::RenderScene& scene, const picture::EyeView& view,
                                         const ShadowSetup& shadows, const HdrTarget& target);
  /// The place of an eye's finished picture: `pixels` of `target`, with the lower left corner at (x, y). Its overlay is
  /// laid out in the proportions of `seen`.
  struct EyeTarget {
    const PictureTarget& target;
    picture::PixelSize pixels;
    picture::PixelSize seen;
    std::int32_t x = 0;
    std::int32_t y = 0;
  };
  [[nodiscard]] EyeTarget target_of(picture::Stereo stereo, std::size_t eye) const;
  [[nodiscard]] static PictureArea area_of(const EyeTarget& into);
  [[nodiscard]] static PictureArea inset_area_of(const EyeTarget& into);
  /// Tone, close-up and words of one eye.
  [[nodiscard]] Expected<void> finish_eye(const picture::RenderScene& scene, const picture::EyeView& view,
                                          const EyeTarget& into);

  bool odd_row_ = false;
  RendererSettings settings_;
  Quality quality_;
  CompositePass composite_;
  OverlayPass overlay_;
  std::optional<FullPasses> full_;  ///< made when they are needed first; so is the next
  std::optional<LowRenderer> low_;
  GpuAssets assets_;
  StreamedMesh ropes_ = StreamedMesh::create();
  std::vector<StreamedMesh> soft_bodies_;  ///< the first ones are the scene's
  SkyLight sky_;
  std::optional<picture::Sun> baked_sun_;
  std::optional<HdrTarget> hdr_;
  std::optional<HdrTarget> inset_;
  std::optional<PictureTarget> picture_;              ///< quad_buffer: not used
  std::array<std::optional<PictureTarget>, 2> eyes_;  ///< left and right, if they are combined afterwards
  picture::Stereo last_ = picture::Stereo::mono;
  std::vector<PassTime> pass_times_;
  std::chrono::steady_clock::time_point wall_mark_;
  std::clock_t cpu_mark_ = 0;
};

}  // namespace mechane::draw
