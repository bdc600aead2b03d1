// One tick as bytes. Absent hands take no space: a fresh sample of a one-point hand takes about 140 bytes, an idle tick one byte.
#pragma once

#include <cstddef>
#include <span>

#include "server/base/byte_order.hpp"
#include "server/record/tick_record.hpp"

namespace mechane::record {

/// No tick takes more.
inline constexpr std::size_t kMaxEncodedTick = 4096;

/// Writes the inputs, events and hash of a tick (not its number) into `out`, which has room for kMaxEncodedTick bytes; returns how many
/// bytes were written. Called in the loop: allocates nothing. Doubles keep their bits, NaN too.
[[nodiscard]] std::size_t encode_tick(const TickRecord& record, std::span<std::byte> out) noexcept;

/// True when nothing happened in the tick: nobody present, no command, no event, no hash.
[[nodiscard]] bool is_idle(std::span<const std::byte> encoded) noexcept;

/// Reads one tick into `out`. Before the call, `out.tick` is set and its samples are those of the tick before. False when encode_tick
/// cannot have written the bytes; the content of `out` is then meaningless.
[[nodiscard]] bool decode_tick(ByteSource& in, JournalTick& out);

}  // namespace mechane::record
