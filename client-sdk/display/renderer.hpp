// Draws a RenderScene: one eye or two, pass after pass. Made, used and destroyed on the thread of a current OpenGL context.
#pragma once

#include <memory>
#include <optional>

#include "client-sdk/display/overlay_pass.hpp"
#include "client-sdk/display/passes.hpp"
#include "client-sdk/display/render_scene.hpp"

namespace mechane::display {

enum class Stereo : std::uint8_t {
  mono,
  side_by_side,  ///< left eye in the left half; each half has the proportions of its own pixels (nothing is squeezed)
};

struct RendererSettings {
  int samples = 4;  ///< a pixel, 1..8
  std::uint32_t shadow_map_size = 2048;
  float exposure = 1.15F;
  std::string font_folder = default_font_folder();
};

class Renderer {
 public:
  /// Errors: the driver refuses a shader or a target; a font is missing.
  [[nodiscard]] static Expected<std::unique_ptr<Renderer>> create(const RendererSettings& settings);

  /// Uploads what is new in `assets`.
  void upload(const SceneAssets& assets) { assets_.upload(assets); }
  /// Frees all that was uploaded: another scenario begins.
  void forget_assets() { assets_ = {}; }
  /// Draws into the renderer's own picture. Errors: no memory for targets of this size.
  [[nodiscard]] Expected<void> draw(const RenderScene& scene, Stereo stereo, PixelSize size);
  /// The last picture, upper row first. Waits for the graphics card.
  [[nodiscard]] ImageData read_picture() const;
  /// Waits until the last picture is drawn.
  static void finish();
  /// Copies the last picture into the window.
  void copy_to_window(PixelSize window) const;

 private:
  struct Passes {
    ShadowPass shadow;
    OpaquePass opaque;
    SkyPass sky;
    WaterPass water;
    ClearPass clear;
    ParticlePass particle;
    TonePass tone;
    OverlayPass overlay;
  };
  Renderer(const RendererSettings& settings, Passes passes) : settings_(settings), passes_(std::move(passes)) {}
  [[nodiscard]] Expected<void> fit_targets(PixelSize picture, PixelSize eye, bool inset);
  [[nodiscard]] Expected<void> fit_sky(const Sun& sun);
  void draw_view(const RenderScene& scene, const EyeView& view, const Eigen::Matrix4f& PV_light,
                 const HdrTarget& target);
  /// Tone, close-up and words of one eye, into the picture from column x on.
  void finish_eye(const RenderScene& scene, PixelSize eye, std::int32_t x);

  RendererSettings settings_;
  Passes passes_;
  GpuAssets assets_;
  StreamedMesh ropes_ = StreamedMesh::create();
  SkyHarmonics sky_{};
  std::optional<Sun> baked_sun_;
  std::optional<HdrTarget> hdr_;
  std::optional<HdrTarget> inset_;
  std::optional<PictureTarget> picture_;
};

}  // namespace mechane::display
