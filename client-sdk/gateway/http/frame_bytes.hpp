// One frame of a world as browsers get it: STREAM.md has the layout.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <mechane/client/types.hpp>

namespace mechane::gateway {

inline constexpr std::size_t kFrameHeader = 32;

/// What all browsers of a kiosk share, encoded once.
struct FrameBody {
  std::uint64_t sequence = 0;
  std::uint64_t tick = 0;
  TimePoint received;            ///< by the gateway's client
  std::vector<std::byte> bytes;  ///< from byte 32 on
};

[[nodiscard]] FrameBody encode_frame(const client::Frame& frame);
/// The first 32 bytes, made when the frame is sent: what was skipped, when it is sent and how old it is differ between browsers.
[[nodiscard]] std::array<std::byte, kFrameHeader> frame_header(const FrameBody& frame, std::uint32_t skipped,
                                                               TimePoint now);

}  // namespace mechane::gateway
