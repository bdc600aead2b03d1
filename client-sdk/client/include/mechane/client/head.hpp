// Where a visitor's head is before a screen: told by a program of the museum's own that has a tracker, heard by displays.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/base/math.hpp"

namespace mechane::client {

/// Frame S: the middle of the screen, x to the right, y up, z towards the visitor. Frame V: between the eyes, x towards the right one.
struct ViewerHead {
  Pose X_SV;           ///< metres
  bool seen = false;   ///< otherwise nobody is there, and X_SV means nothing
  TimePoint received;  ///< on this client's clock
};

/// Tells displays of a head. Any one thread of the caller's at a time.
class HeadTracker {
 public:
  /// `display`: whose screen it is; empty: of all displays of the kiosk. Errors: a bad name, a domain over 230, a configuration of the network
  /// that cannot be used.
  [[nodiscard]] static Expected<std::unique_ptr<HeadTracker>> open(const std::string& kiosk, const std::string& display,
                                                                   std::uint32_t domain);
  virtual ~HeadTracker() = default;

  /// As often as the tracker knows: 30 to 250 times a second. After half a second of silence the picture goes back to where visitors stand as a
  /// rule. False where the pose is not valid, or the network did not take it.
  virtual bool tell(const Pose& X_SV) = 0;
  /// Nobody is before the screen any more.
  virtual bool tell_nobody() = 0;
};

}  // namespace mechane::client
