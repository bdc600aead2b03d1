// The quality `auto`: steps down where pictures take too long to draw, and up again where there is much time to spare.
// Pure: measured times in, a quality out.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "client-sdk/draw/quality.hpp"
#include "server/base/clock.hpp"

namespace mechane::draw {

/// What the start-up probe has measured.
struct DrawingSpeed {
  double megapixel_ms = 0;    ///< to draw a million pixels of sky
  bool by_processor = false;  ///< the processor draws, not a graphics card
};

/// The quality to begin with.
[[nodiscard]] Quality quality_for(const DrawingSpeed& speed);

class QualityGovernor {
 public:
  static constexpr std::size_t kJudged = 20;   ///< so many pictures are judged together, by their median
  static constexpr std::size_t kIgnored = 10;  ///< after a step: shaders are compiled, and things come to rest
  static constexpr double kTooLong = 1.3;      ///< of the time allowed: a step down
  static constexpr double kShort = 0.3;        ///< less than this share, for as long as it waits: a step up
  static constexpr Duration kWait = std::chrono::seconds(10);
  static constexpr Duration kLongestWait = std::chrono::minutes(20);  ///< it doubles with each step up that failed

  /// `allowed_ms`: for one picture.
  QualityGovernor(Quality quality, double allowed_ms) : quality_(quality), allowed_ms_(allowed_ms) {}
  [[nodiscard]] Quality quality() const { return quality_; }
  /// How long a picture took to draw. Returns the quality of the next one.
  Quality drawn(double ms, TimePoint now);

 private:
  void step(Quality to);

  Quality quality_;
  double allowed_ms_;
  std::size_t ignored_ = 0;
  std::vector<double> ms_;
  std::optional<TimePoint> short_since_;
  bool rose_ = false;  ///< the last step was up
  Duration wait_ = kWait;
};

}  // namespace mechane::draw
