// Measures what drawing costs: the graphics card's own time, or the processor's where that draws. In a current context.
#pragma once

#include <ctime>
#include <optional>

#include "client-sdk/draw/gl_object.hpp"
#include "client-sdk/draw/quality_governor.hpp"
#include "server/base/error.hpp"

namespace mechane::draw {

/// Draws a little, for some milliseconds on a graphics card. Errors: the driver rejects a shader or a target.
[[nodiscard]] Expected<DrawingSpeed> measure_drawing_speed();

class DrawTimer {
 public:
  explicit DrawTimer(bool by_processor) : by_processor_(by_processor) {}
  /// Around the drawing of each picture. Of those of a graphics card some are left out, because it tells its times
  /// later.
  void begin();
  void end();
  /// The time of a picture whose time is known now, milliseconds; each only once.
  [[nodiscard]] std::optional<double> take();

 private:
  bool by_processor_;
  QueryName query_;
  bool measures_ = false;  ///< this picture
  bool waits_ = false;     ///< for the card's answer
  std::clock_t began_ = 0;
  std::optional<double> ms_;
};

}  // namespace mechane::draw
