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
  /// What draws, also once it is lost: "llvmpipe (LLVM 15.0.6, 256 bits)".
  [[nodiscard]] virtual std::string renderer_name() const = 0;
  /// Size of the window's picture, in pixels; offscreen: what was asked for.
  [[nodiscard]] virtual picture::PixelSize size() const = 0;
  /// Shows the picture and takes the window's events. Offscreen: nothing.
  virtual void present() = 0;
  /// The graphics card has forgotten all (its driver was reset, it was unplugged, the machine slept): nothing more is drawn in this context.
  [[nodiscard]] virtual bool lost() const = 0;
  /// Another context in its place, in the same window; whatever was made in the one before must be gone. Errors: the driver is not back yet.
  [[nodiscard]] virtual Expected<void> renew() = 0;
};

/// What lost() asks: whether the driver tells of a reset since the last call. Drivers that do not tell of any say no.
[[nodiscard]] bool driver_was_reset();

/// EGL without a screen or X server: on the first graphics card that has OpenGL 3.3, else on Mesa's surfaceless platform, which draws with
/// the processor where it must. LIBGL_ALWAYS_SOFTWARE=1 leaves cards out. Errors: no EGL, no such platform, no OpenGL 3.3.
[[nodiscard]] Expected<std::unique_ptr<GlContext>> make_offscreen_context(picture::PixelSize size);

}  // namespace mechane::draw
