// What a visitor is told of the kiosk's haptic device: a few words and a sign, while something is wrong with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client-sdk/picture/overlay_content.hpp"
#include "server/base/clock.hpp"
#include <mechane/client/types.hpp>

namespace mechane::visit {

/// Without a clock of its own: the display passes the time of its steady clock.
class DeviceNotice {
 public:
  /// A state that ends earlier is not shown: nothing flickers.
  static constexpr Duration kLasts = std::chrono::seconds(1);

  /// Takes the states of the kiosk's devices; call it once a picture. The most serious one counts. A device that nobody
  /// holds counts only where no other one is in use. Beside another one of its kind that is well, or has another fault,
  /// a device is called by its number.
  void hear(const std::vector<client::DeviceReport>& devices, TimePoint now);
  /// In Greek ("el"), or else in English. None: all is well, or it has not lasted yet.
  [[nodiscard]] std::optional<picture::OverlayNotice> at(TimePoint now, const std::string& language) const;

 private:
  std::optional<client::DeviceReport> told_;
  bool numbered_ = false;
  TimePoint since_;
};

}  // namespace mechane::visit
