// The position of a visitor's head in front of a screen: sent by a program with a tracker, received by displays.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/base/math.hpp"

namespace mechane::client {

/// Frame S: the middle of the screen, x to the right, y up, z towards the visitor. Frame V: between the eyes, x towards
/// the right one.
struct ViewerHead {
  Pose X_SV;           ///< metres
  bool seen = false;   ///< false: nobody is there, and X_SV means nothing
  TimePoint received;  ///< on this client's clock
};

/// Sends a head's position to displays. Any thread, one at a time.
class HeadTracker {
 public:
  /// `display`: whose screen it is; empty: all displays of the kiosk. Errors: a bad name, a domain over 230, an
  /// unusable network configuration.
  [[nodiscard]] static Expected<std::unique_ptr<HeadTracker>> open(const std::string& kiosk, const std::string& display,
                                                                   std::uint32_t domain);
  virtual ~HeadTracker() = default;

  /// Call it at the tracker's own rate, 30 to 250 times a second. After half a second of silence the picture returns to
  /// the place where visitors usually stand. False where the pose is not valid, or could not be sent.
  virtual bool tell(const Pose& X_SV) = 0;
  /// Nobody is in front of the screen any more.
  virtual bool tell_nobody() = 0;
};

}  // namespace mechane::client
