// The journal: every input and event of a world at tick rate, so that the visit can be run again to the bit.
//
// A file is the magic "MECHJRNL" and a version (u32), then frames to the end. The version is that of the state whose hashes it holds
// (state::StateVersion): a journal is compared over the fields of its time. A frame is
//
//     kind u8 | length u32 | checksum u64 | payload of `length` bytes
//
// with the checksum XXH3-64 of kind, length and payload, seeded with the frame's number in the file, so that a reader notices a frame that
// is damaged, missing or in the wrong place. Numbers are little-endian; `v` is a LEB128 number, `s` a length and that many bytes.
//
//     header  one, first: s world, s kiosk, s scenario, s scenario hash, s build, u64 start wall time ns, u64 first tick, s snapshot
//     ticks   u64 first, u64 last tick, then those that are not idle: v ticks since the one before, and the tick (tick_codec.cpp)
//     loss    u64 first lost tick, u64 how many: the journal goes on, but cannot be replayed beyond this
//     close   u64 ticks in all, u64 lost ticks, u8 has hash, u64 final state hash: the end; a file without it was cut off
//
// Ticks have consecutive numbers from the header's first tick on; every frame says which it covers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/state/world_state.hpp"

namespace mechane::record {

/// What a replay needs before the first tick.
struct JournalHeader {
  std::string world_id;
  std::string kiosk;
  std::string scenario_id;  ///< "archimedes-screw"
  std::string
      scenario_hash;     ///< WorldDescription::content_hash: a replay against another one cannot give the same bits
  std::string build_id;  ///< of the server
  std::uint64_t start_wall_ns = 0;  ///< since 1970 UTC; for people
  std::uint64_t first_tick = 0;
  std::vector<std::byte> snapshot;  ///< the state before the first tick; empty: as the scenario describes it
  state::StateVersion state_version = state::kStateVersion;  ///< what the hashes are over
};

/// How a journal ends.
struct JournalEnd {
  enum class Kind {
    closed,   ///< in order
    cut_off,  ///< in the middle of a frame, or without a close: the writer was killed, or is still writing
    damaged,  ///< bytes have changed since they were written
  };
  Kind kind = Kind::cut_off;
  std::uint64_t offset = 0;                 ///< all bytes before it are good
  std::string message;                      ///< for people: what is wrong at the offset; empty when closed
  std::uint64_t ticks = 0;                  ///< how many could be read
  std::uint64_t lost_ticks = 0;             ///< how many are missing, as the journal itself says
  std::optional<std::uint64_t> first_lost;  ///< replay ends before this tick
  std::optional<std::uint64_t> hash;        ///< final state hash, of a closed journal
};

namespace journal_format {

inline constexpr char kMagic[8] = {'M', 'E', 'C', 'H', 'J', 'R', 'N', 'L'};
inline constexpr std::size_t kPreambleSize = sizeof(kMagic) + 4;
inline constexpr std::size_t kFrameHeadSize = 1 + 4 + 8;
inline constexpr std::uint32_t kMaxPayload =
    64u << 20;  ///< room for a header with a large snapshot; frames of ticks are far smaller
inline constexpr std::uint64_t kMaxTicksPerFrame = 1'000'000;
enum class FrameKind : std::uint8_t { header = 1, ticks = 2, loss = 3, close = 4 };

}  // namespace journal_format
}  // namespace mechane::record
