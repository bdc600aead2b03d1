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

/// A key that means something to the display itself.
enum class DisplayKey : std::uint8_t {
  home,           ///< Home
  language,       ///< L
  large_text,     ///< +
  high_contrast,  ///< C
  forces,         ///< F
};

class Window : public draw::GlContext {
 public:
  /// The screen's row that the picture's uppermost is; 0 where nobody can tell (Wayland).
  [[nodiscard]] virtual int first_row() const = 0;
  /// Whether it has a picture for each eye (Stereo::quad_buffer).
  [[nodiscard]] virtual bool has_quad_buffer() const = 0;
  /// The visitor, or the operator, closed the window (Esc or its button).
  [[nodiscard]] virtual bool close_wanted() const = 0;
  /// A picture was asked for (key P) since the last call.
  [[nodiscard]] virtual bool take_picture_wanted() = 0;
  /// Where the left button or a finger was pressed since the last call, in order.
  [[nodiscard]] virtual std::vector<picture::PixelPlace> take_clicks() = 0;
  /// What was done with pointer and keys since the last call, in order; take_clicks() tells of presses as well.
  [[nodiscard]] virtual std::vector<pointer::PointerEvent> take_pointer_events() = 0;
  /// The keys pressed since the last call, in order.
  [[nodiscard]] virtual std::vector<DisplayKey> take_keys() = 0;
};

struct WindowOptions {
  bool quad_buffer = false;  ///< with a picture for each eye where the driver has such; has_quad_buffer() tells
  bool full_screen = false;  ///< fills the screen from the start; F11 changes it
};

/// The only window of the process. Filling the screen, it shows no cursor while the mouse rests; nor does it where fingers touch. While it lives
/// no screen saver comes. Errors: no screen to open a window on, no OpenGL 3.3.
[[nodiscard]] Expected<std::unique_ptr<Window>> make_window(picture::PixelSize size, const std::string& title,
                                                            const WindowOptions& options = {});

}  // namespace mechane::display
