// A window with an OpenGL context, and what visitors and operators do in it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client-sdk/draw/gl_context.hpp"
#include "client-sdk/picture/pixels.hpp"
#include "client-sdk/pointer/pointer_event.hpp"
#include "server/base/error.hpp"

namespace mechane::display {

/// A key for the display itself.
enum class DisplayKey : std::uint8_t {
  home,           ///< Home
  language,       ///< L
  large_text,     ///< +
  high_contrast,  ///< C
  forces,         ///< F
};

class Window : public draw::GlContext {
 public:
  /// The screen row of the picture's uppermost row; 0 if unknown (Wayland).
  [[nodiscard]] virtual int first_row() const = 0;
  /// Whether it can show a picture for each eye (Stereo::quad_buffer).
  [[nodiscard]] virtual bool has_quad_buffer() const = 0;
  /// Whether the window was closed (Esc or its button).
  [[nodiscard]] virtual bool close_wanted() const = 0;
  /// Whether a picture was requested (key P) since the last call.
  [[nodiscard]] virtual bool take_picture_wanted() = 0;
  /// Where the left button or a finger was pressed since the last call, in order.
  [[nodiscard]] virtual std::vector<picture::PixelPlace> take_clicks() = 0;
  /// Pointer and key events since the last call, in order; presses are also in take_clicks().
  [[nodiscard]] virtual std::vector<pointer::PointerEvent> take_pointer_events() = 0;
  /// The keys pressed since the last call, in order.
  [[nodiscard]] virtual std::vector<DisplayKey> take_keys() = 0;
};

struct WindowOptions {
  bool quad_buffer = false;  ///< a picture for each eye, if the driver supports it; see has_quad_buffer()
  bool full_screen = false;  ///< fills the screen from the start; F11 changes it
};

/// The only window of the process. In full screen it hides the cursor while the mouse rests, and while fingers are
/// used. It disables the screen saver. Errors: no screen for a window, no OpenGL 3.3.
[[nodiscard]] Expected<std::unique_ptr<Window>> make_window(picture::PixelSize size, const std::string& title,
                                                            const WindowOptions& options = {});

}  // namespace mechane::display
