#include "client-sdk/display/phone_code.hpp"

#include <memory>

#include <qrencode.h>

namespace mechane::display {

std::optional<picture::OverlayCode> qr_code(const std::string& text) {
  const std::unique_ptr<QRcode, decltype(&QRcode_free)> made(QRcode_encodeString8bit(text.c_str(), 0, QR_ECLEVEL_M),
                                                             QRcode_free);
  if (!made) return {};
  picture::OverlayCode code;
  code.side = static_cast<std::uint32_t>(made->width);
  code.dark.resize(std::size_t{code.side} * code.side);
  for (std::size_t i = 0; i < code.dark.size(); ++i)
    code.dark[i] = (made->data[i] & 1) != 0;
  return code;
}

void PhoneCode::hear(const client::DisplaySettings& settings, std::uint64_t told, TimePoint now) {
  if (told == told_) return;
  told_ = told;
  told_at_ = now;
  const bool whole = !settings.phone_address.empty() && !settings.phone_code.empty();
  std::string address =
      whole ? settings.phone_address + "/kiosk/" + kiosk_ + "?token=" + settings.phone_code : std::string();
  if (address == address_) return;
  address_ = std::move(address);
  code_ = address_.empty() ? std::nullopt : qr_code(address_);
}

std::optional<picture::OverlayCode> PhoneCode::at(TimePoint now, const std::string& language) const {
  if (!code_ || now - told_at_ > kStays) return {};
  std::optional<picture::OverlayCode> code = code_;
  code->text = language == "el" ? "Στο κινητό σας" : "On your phone";
  return code;
}

}  // namespace mechane::display
