// One tick as bytes. Only what was there is written: a fresh sample of a one-point hand takes about 140 bytes, an idle tick one.
#pragma once

#include <cstddef>
#include <span>

#include "server/base/byte_order.hpp"
#include "server/record/tick_record.hpp"

namespace mechane::record {

/// No tick takes more.
inline constexpr std::size_t kMaxEncodedTick = 4096;

/// Writes the inputs, events and hash of a tick (not its number) into `out`, which holds at least kMaxEncodedTick bytes; returns how
/// many were written. Called in the loop: allocates nothing. Doubles keep their bits, whatever they are.
[[nodiscard]] std::size_t encode_tick(const TickRecord& record, std::span<std::byte> out) noexcept;

/// True when nothing happened in the tick: nobody present, no command, no event, no hash.
[[nodiscard]] bool is_idle(std::span<const std::byte> encoded) noexcept;

/// Reads one tick into `out`, whose `tick` is set already and whose samples are those of the tick before. False when the bytes are
/// not what encode_tick writes; `out` is then of no use.
[[nodiscard]] bool decode_tick(ByteSource& in, JournalTick& out);

}  // namespace mechane::record
