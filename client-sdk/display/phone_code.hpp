// The QR code with which a visitor takes a kiosk's page along on a phone, as a gateway tells it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "client-sdk/picture/overlay_content.hpp"
#include "server/base/clock.hpp"
#include <mechane/client/displays.hpp>

namespace mechane::display {

/// The modules of a code of this text, without words; none: it is too long. A seventh of the code may be hidden.
[[nodiscard]] std::optional<picture::OverlayCode> qr_code(const std::string& text);

/// On the display's thread; time is an argument.
class PhoneCode {
 public:
  /// A code that was not told again for so long is not shown: its gateway is gone.
  static constexpr Duration kStays = std::chrono::seconds(60);

  explicit PhoneCode(std::string kiosk) : kiosk_(std::move(kiosk)) {}

  /// The settings as they are, and how often they were told: KioskDesk::codes_told().
  void hear(const client::DisplaySettings& settings, std::uint64_t told, TimePoint now);
  /// The code that is to be shown now, if any.
  [[nodiscard]] std::optional<picture::OverlayCode> at(TimePoint now, const std::string& language) const;

 private:
  const std::string kiosk_;
  std::string address_;
  std::optional<picture::OverlayCode> code_;
  std::uint64_t told_ = 0;
  TimePoint told_at_;
};

}  // namespace mechane::display
