// Keeps kiosks as operators have ordered: shows signs and messages on displays that do not yet, takes visitors home at
// closing time, wakes machines at opening, takes timed changes back. On the loop's thread.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "server/base/clock.hpp"
#include <mechane/client/displays.hpp>

namespace mechane::gateway {

class GatewaySite;
struct KioskTarget;
struct TimedChange;

/// Seconds since 1970.
[[nodiscard]] std::int64_t wall_now();

class KioskKeeper {
 public:
  /// Call it often; it looks twice a second. `now`: seconds since 1970.
  void tick(GatewaySite& site, std::int64_t now, TimePoint at);

 private:
  struct Tries {
    int count = 0;
    TimePoint next;
  };
  struct Kept {
    std::string sign = "none";  ///< that the kiosk was led home for
    bool open = false;
    int wakes_left = 0;
    TimePoint next_wake;
  };
  struct Asked {
    TimePoint again;
    std::vector<client::DisplaySetting> settings;
  };
  void lead_home(GatewaySite& site, const std::string& kiosk, const KioskTarget& target);
  void keep_displays(GatewaySite& site, const std::string& kiosk, const KioskTarget& target, TimePoint at);
  void wake_kiosks(GatewaySite& site, std::int64_t now, TimePoint at);
  void take_back(GatewaySite& site, std::int64_t now, TimePoint at);
  /// Whether nothing is left to do for it; otherwise asks the displays once more.
  [[nodiscard]] static bool is_back(GatewaySite& site, const TimedChange& change);

  TimePoint next_look_;
  std::map<std::string, Kept> kept_;
  std::map<std::uint64_t, Asked> asked_;  ///< by a display's session
  std::map<std::uint64_t, Tries> tries_;  ///< by a change's id
};

}  // namespace mechane::gateway
