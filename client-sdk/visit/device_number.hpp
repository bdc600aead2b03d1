// By what visitors and staff tell a kiosk's handles, or its gloves, from each other: the number on its sticker, which is
// its hand's, counted from 1. Inside this room only.
#pragma once

#include <string>
#include <string_view>

#include <mechane/client/types.hpp>

namespace mechane::visit {

/// A program without a device does not count.
[[nodiscard]] inline bool is_another_of_its_kind(const client::DeviceReport& other,
                                                 const client::DeviceReport& device) {
  return other.user != device.user && other.kind == device.kind && other.state != client::DeviceState::none;
}

/// In a sentence in English or Greek that speaks of the handle or the glove: "Put the glove on" is "Put glove 2 on".
[[nodiscard]] std::string by_number(std::string_view sentence, const client::DeviceReport& device);

}  // namespace mechane::visit
