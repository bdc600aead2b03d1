// An OpenGL 3.3 core context: in a window, or of no surface at all. Belongs to the thread that makes it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client-sdk/display/pointer_event.hpp"
#include "server/base/error.hpp"

namespace mechane::display {

struct PixelSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  friend bool operator==(const PixelSize&, const PixelSize&) = default;
};

/// A place in the picture, in pixels; (0, 0) is the upper left corner.
struct PixelPlace {
  double x = 0;
  double y = 0;
};

/// A key that means something to the display itself.
enum class DisplayKey : std::uint8_t {
  home,           ///< Home
  language,       ///< L
  large_text,     ///< +
  high_contrast,  ///< C
  forces,         ///< F
};

class GlContext {
 public:
  virtual ~GlContext() = default;
  /// What draws, also once it is lost: "llvmpipe (LLVM 15.0.6, 256 bits)".
  [[nodiscard]] virtual std::string renderer_name() const = 0;
  /// Size of the window's picture, in pixels; offscreen: what was asked for.
  [[nodiscard]] virtual PixelSize size() const = 0;
  /// The screen's row that the picture's uppermost is; 0 where nobody can tell (Wayland).
  [[nodiscard]] virtual int first_row() const { return 0; }
  /// Shows the picture and takes the window's events. Offscreen: nothing.
  virtual void present() = 0;
  /// The graphics card has forgotten all (its driver was reset, it was unplugged, the machine slept): nothing more is drawn in this context.
  [[nodiscard]] virtual bool lost() const = 0;
  /// Another context in its place, in the same window; whatever was made in the one before must be gone. Errors: the driver is not back yet.
  [[nodiscard]] virtual Expected<void> renew() = 0;
  /// The visitor, or the operator, closed the window (Esc or its button).
  [[nodiscard]] virtual bool close_wanted() const = 0;
  /// A picture was asked for (key P) since the last call.
  [[nodiscard]] virtual bool take_picture_wanted() = 0;
  /// Where the left button or a finger was pressed since the last call, in order.
  [[nodiscard]] virtual std::vector<PixelPlace> take_clicks() { return {}; }
  /// What was done with pointer and keys since the last call, in order; take_clicks() tells of presses as well.
  [[nodiscard]] virtual std::vector<PointerEvent> take_pointer_events() { return {}; }
  /// Whether the window has a picture for each eye (Stereo::quad_buffer).
  [[nodiscard]] virtual bool has_quad_buffer() const { return false; }
  /// The keys pressed since the last call, in order.
  [[nodiscard]] virtual std::vector<DisplayKey> take_keys() { return {}; }
};

/// What lost() asks: whether the driver tells of a reset since the last call. Drivers that do not tell of any say no.
[[nodiscard]] bool driver_was_reset();

/// EGL on Mesa's surfaceless platform: no screen, no X server. Errors: no EGL, no such platform, no OpenGL 3.3.
[[nodiscard]] Expected<std::unique_ptr<GlContext>> make_offscreen_context(PixelSize size);

struct WindowOptions {
  bool quad_buffer = false;  ///< with a picture for each eye where the driver has such; has_quad_buffer() tells
  bool full_screen = false;  ///< fills the screen from the start; F11 changes it
};

/// A window with a context of its own, the only one of the process. Filling the screen, it shows no cursor while the mouse rests; nor does it
/// where fingers touch. While it lives no screen saver comes. Errors: no screen to open a window on, no OpenGL 3.3.
[[nodiscard]] Expected<std::unique_ptr<GlContext>> make_window_context(PixelSize size, const std::string& title,
                                                                       const WindowOptions& options = {});

}  // namespace mechane::display
