// What a visitor is shown while a glove is fitted to the hand: the pose to show, how far it is, and a thank-you.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client-sdk/picture/overlay_content.hpp"
#include "server/base/clock.hpp"
#include <mechane/client/types.hpp>

namespace mechane::visit {

/// Without a clock of its own: the display passes the time of its steady clock.
class CalibrationGuide {
 public:
  static constexpr Duration kThanks = std::chrono::seconds(3);
  /// In which the ring fills by what one message tells: a tenth of a pose's time.
  static constexpr Duration kRingStep = std::chrono::milliseconds(300);

  /// Takes the states of the kiosk's devices; call it once a picture. The first hand that is asked for a pose counts.
  void hear(const std::vector<client::DeviceReport>& devices, TimePoint now);
  /// Whether a visitor is asked for a pose.
  [[nodiscard]] bool asks() const;
  /// In Greek ("el"), or else in English. None: nothing is asked, or the thanks are over.
  [[nodiscard]] std::optional<picture::OverlayPose> at(TimePoint now, const std::string& language) const;

 private:
  [[nodiscard]] float ring(TimePoint now) const;

  std::uint32_t user_ = 0;
  client::HandSide side_ = client::HandSide::right;
  client::CalibrationNews told_;
  float ring_before_ = 0;  // when told_ came
  TimePoint since_;
  std::optional<TimePoint> thanked_;
};

}  // namespace mechane::visit
