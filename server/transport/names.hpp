// Names of events and of what they are about, for the wire.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "server/state/description.hpp"
#include "server/state/event.hpp"
#include "server/transport/world_port.hpp"

namespace mechane::transport {

struct EventNames {
  const char* kind = "";
  std::string subject;
  std::string object;
};

/// "kiosk-1/0", or "user 2" where the slot has no session.
[[nodiscard]] std::string user_name(const std::array<HandSnapshot, hand::kMaxUsers>& hands, std::uint32_t slot);

/// An index out of range gives an empty name.
[[nodiscard]] EventNames names_of(const state::WorldDescription& world, const state::Event& event,
                                  const std::array<HandSnapshot, hand::kMaxUsers>& hands);

}  // namespace mechane::transport
