// An OpenGL 3.3 core context, in a window or without a surface. Belongs to the thread that makes it.
#pragma once

#include <memory>
#include <string>

#include "client-sdk/picture/pixels.hpp"
#include "server/base/error.hpp"

namespace mechane::draw {

class GlContext {
 public:
  virtual ~GlContext() = default;
  /// The renderer's name, available after a loss too: "llvmpipe (LLVM 15.0.6, 256 bits)".
  [[nodiscard]] virtual std::string renderer_name() const = 0;
  /// Size of the window's picture, in pixels; offscreen: the requested size.
  [[nodiscard]] virtual picture::PixelSize size() const = 0;
  /// Shows the picture and takes the window's events. Offscreen: nothing.
  virtual void present() = 0;
  /// Whether the graphics card has lost everything (its driver was reset, it was unplugged, the machine slept): nothing
  /// more can be drawn in this context.
  [[nodiscard]] virtual bool lost() const = 0;
  /// Replaces the context by a new one in the same window; destroy everything that was made in the old one first.
  /// Errors: the driver is not back yet.
  [[nodiscard]] virtual Expected<void> renew() = 0;
};

/// For lost(): whether the driver reports a reset since the last call. False for drivers that report none.
[[nodiscard]] bool driver_was_reset();

/// EGL without a screen or X server: on the first graphics card with OpenGL 3.3, else on Mesa's surfaceless platform,
/// which can draw with the processor. LIBGL_ALWAYS_SOFTWARE=1 skips the cards. Errors: no EGL, no such platform, no
/// OpenGL 3.3.
[[nodiscard]] Expected<std::unique_ptr<GlContext>> make_offscreen_context(picture::PixelSize size);

}  // namespace mechane::draw
