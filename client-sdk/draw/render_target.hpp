// The targets of passes: a multisampled HDR picture, a shadow map, a finished 8-bit picture.
#pragma once

#include <cstdint>
#include <vector>

#include "client-sdk/draw/gl_context.hpp"
#include "client-sdk/draw/gl_object.hpp"
#include "client-sdk/picture/scene_assets.hpp"
#include "server/base/error.hpp"

namespace mechane::draw {

/// Half-float colour and depth, `samples` a pixel. The colour is a multisample texture: the tone pass resolves it.
struct HdrTarget {
  FramebufferName framebuffer;
  TextureName colour;
  RenderbufferName depth;
  picture::PixelSize size;
  int samples = 1;
  FramebufferName depth_copy_framebuffer;
  TextureName depth_copy;  ///< one sample a pixel, written by resolve_depth()
  int asked_samples = 1;   ///< the driver may have fewer

  [[nodiscard]] static Expected<HdrTarget> create(picture::PixelSize size, int samples);
  /// Copies the depth to where shaders can read it, and leaves `framebuffer` bound.
  void resolve_depth() const;
};

/// Half-float colour with depth and a stencil, one sample a pixel.
struct MirrorTarget {
  FramebufferName framebuffer;
  TextureName colour;
  RenderbufferName depth;
  picture::PixelSize size;

  [[nodiscard]] static Expected<MirrorTarget> create(picture::PixelSize size);
  /// Binds and clears it, with a viewport of its full size, and disables the stencil test.
  void begin() const;
};

/// Square depth textures, one per layer. They are read with comparison, or, with the sampler `plain_depth` bound to the
/// same unit, as plain depths.
struct ShadowTarget {
  FramebufferName framebuffer;
  TextureName depth;
  SamplerName plain_depth;
  std::uint32_t size = 0;

  [[nodiscard]] static Expected<ShadowTarget> create(std::uint32_t size, std::uint32_t layers);
  /// Binds this layer for drawing.
  void bind_layer(std::uint32_t layer) const;
};

/// The finished picture, sRGB values in 8 bits.
struct PictureTarget {
  FramebufferName framebuffer;
  TextureName colour;
  picture::PixelSize size;

  [[nodiscard]] static Expected<PictureTarget> create(picture::PixelSize size);
  /// Reads the picture back, upper row first, opaque.
  [[nodiscard]] picture::ImageData read() const;
};

/// Screen colours with depth, one sample a pixel.
struct ScreenTarget {
  enum class Use : std::uint8_t {
    drawn,  ///< its depth can be copied to where shaders read it
    kept,   ///< has its light too: see screen.glsl
  };
  FramebufferName framebuffer;
  TextureName colour;
  TextureName depth;
  picture::PixelSize size;
  FramebufferName depth_copy_framebuffer;  ///< drawn
  TextureName depth_copy;                  ///< drawn; written by copy_depth()
  TextureName all_light;                   ///< kept
  TextureName sun_light;                   ///< kept

  [[nodiscard]] static Expected<ScreenTarget> create(picture::PixelSize size, Use use);
  /// Binds it with a viewport of its full size.
  void bind() const;
  /// Copies the depth to depth_copy, and leaves `framebuffer` bound.
  void copy_depth() const;
  /// Makes colour and depth those of another target of this size, and leaves `framebuffer` bound.
  void copy_from(const ScreenTarget& other) const;
};

/// A rectangle of a target, (x, y) its lower left corner.
struct PictureArea {
  const FramebufferName& framebuffer;
  std::int32_t x = 0;
  std::int32_t y = 0;
  picture::PixelSize size;

  /// Binds it, with a viewport of just this area.
  void bind() const;
};

/// One float picture without depth: the sky's map (radiance, rows from the zenith down), or an intermediate picture.
struct FloatTarget {
  FramebufferName framebuffer;
  TextureName colour;
  picture::PixelSize size;

  [[nodiscard]] static Expected<FloatTarget> create(picture::PixelSize size);
  /// Binds it with a viewport of its full size.
  void bind() const;
  [[nodiscard]] std::vector<Vec3f> read() const;
};

}  // namespace mechane::draw
