// Wakes a sleeping machine by its network card: the magic packet of AMD's white paper 20213, as a UDP broadcast.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/base/error.hpp"

namespace mechane::gateway {

using MacAddress = std::array<std::uint8_t, 6>;

/// "02:00:5e:10:00:01", also with '-' or large letters. Nothing if it is not such an address.
[[nodiscard]] std::optional<MacAddress> parse_mac(std::string_view text);
/// Small letters, ':'.
[[nodiscard]] std::string mac_text(const MacAddress& mac);

/// Six bytes of ones, and the address sixteen times.
[[nodiscard]] std::array<std::uint8_t, 102> magic_packet(const MacAddress& mac);

/// Sends one to `to`, "255.255.255.255:9": never waits. Errors: invalid_value (not an address), io_failure.
[[nodiscard]] Expected<void> wake(const MacAddress& mac, const std::string& to);

}  // namespace mechane::gateway
