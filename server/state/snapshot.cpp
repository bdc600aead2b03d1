#include "server/state/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <xxhash.h>

#include "server/state/archive.hpp"

namespace mechane::state {
namespace {

constexpr char kMagic[8] = {'M', 'E', 'C', 'H', 'S', 'N', 'A', 'P'};

/// In front of the fields. All numbers little-endian, as on every machine that the server runs on.
struct Header {
  char magic[8];
  StateVersion version;
  std::uint32_t bodies;
  std::uint32_t joints;
  std::uint32_t quantities;
  std::uint32_t agents;
  std::uint32_t memory;
  std::uint64_t body_bytes;
  std::uint64_t checksum;  ///< XXH3 of what follows
};

class WriteArchive {
 public:
  explicit WriteArchive(std::vector<std::byte>& out) : out_(out) {}
  template <class T>
  void bytes(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t at = out_.size();
    out_.resize(at + sizeof(T));
    std::memcpy(out_.data() + at, &value, sizeof(T));
  }

 private:
  std::vector<std::byte>& out_;
};

/// Reads within bounds; a bool takes any byte but 0 as true, and a number that is not finite fails the read.
class ReadArchive {
 public:
  explicit ReadArchive(std::span<const std::byte> in) : in_(in) {}
  template <class T>
  void bytes(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (in_.size() - at_ < sizeof(T)) {
      ok_ = false;
      return;
    }
    if constexpr (std::is_same_v<T, bool>) {
      value = in_[at_] != std::byte{0};
    } else {
      std::memcpy(&value, in_.data() + at_, sizeof(T));
    }
    if constexpr (std::is_floating_point_v<T>) ok_ = ok_ && std::isfinite(value);
    at_ += sizeof(T);
  }
  [[nodiscard]] bool complete() const { return ok_ && at_ == in_.size(); }

 private:
  std::span<const std::byte> in_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

Header header_of(const WorldState& state, StateVersion version) {
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.version = version;
  header.bodies = static_cast<std::uint32_t>(state.bodies.size());
  header.joints = static_cast<std::uint32_t>(state.joints.size());
  header.quantities = static_cast<std::uint32_t>(state.quantities.size());
  header.agents = static_cast<std::uint32_t>(state.agent_enabled.size());
  header.memory = static_cast<std::uint32_t>(state.memory.size());
  return header;
}

bool same_tables(const Header& a, const Header& b) {
  return a.bodies == b.bodies && a.joints == b.joints && a.quantities == b.quantities && a.agents == b.agents &&
         a.memory == b.memory;
}

/// Whether the ids lie inside the tables that they index. Those of steps and activities are checked by the world, which has the
/// description.
bool ids_in_range(const WorldState& state) {
  for (const UserState& user : state.users) {
    if (user.grasp.active && (!user.grasp.body || user.grasp.body.index() >= state.bodies.size())) return false;
    if (!hand::is_hand_kind(static_cast<std::uint8_t>(user.sample.kind)) ||
        !hand::is_hand_side(static_cast<std::uint8_t>(user.sample.side)))
      return false;
    if (user.anchor_count > user.anchors.size() || user.side_count > user.sides.size()) return false;
    const auto in_hand = [&](const WallSide& side) {
      return side.body.index() < state.bodies.size() && side.segment < hand::segment_count(user.sample.kind);
    };
    if (!std::ranges::all_of(user.side_span(), in_hand)) return false;
  }
  return true;
}

}  // namespace

void write_snapshot(const WorldState& state, std::vector<std::byte>& out, StateVersion version) {
  Header header = header_of(state, version);
  out.clear();
  out.resize(sizeof header);
  WriteArchive archive(out);
  StateWalk<WriteArchive, const WorldState>(archive, state, version).run();
  header.body_bytes = out.size() - sizeof header;
  header.checksum = XXH3_64bits(out.data() + sizeof header, header.body_bytes);
  std::memcpy(out.data(), &header, sizeof header);
}

Expected<void> read_snapshot(std::span<const std::byte> bytes, WorldState& state) {
  const auto refuse = [](ErrorCode code, std::string what) {
    return fail(code, std::move(what), "snapshot", "delete it; the world then starts from the beginning");
  };
  Header header{};
  if (bytes.size() < sizeof header) return refuse(ErrorCode::damaged, "the snapshot is cut off in its header");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0)
    return refuse(ErrorCode::damaged, "this is not a snapshot");
  if (!is_known(header.version)) {
    return refuse(ErrorCode::wrong_version,
                  fmt::format("the snapshot has version {}, but this program reads those up to {}",
                              static_cast<std::uint32_t>(header.version), static_cast<std::uint32_t>(kStateVersion)));
  }
  if (!same_tables(header, header_of(state, header.version))) {
    return refuse(ErrorCode::conflict, "the snapshot is of another scenario, or of an earlier form of this one");
  }
  const auto body = bytes.subspan(sizeof header);
  if (body.size() != header.body_bytes || XXH3_64bits(body.data(), body.size()) != header.checksum) {
    return refuse(ErrorCode::damaged, "the snapshot is damaged");
  }
  ReadArchive archive(body);
  WorldState read = state;
  StateWalk<ReadArchive, WorldState>(archive, read, header.version).run();
  if (!archive.complete() || !ids_in_range(read)) {
    return refuse(ErrorCode::damaged, "the snapshot holds impossible values");
  }
  state = read;
  return {};
}

}  // namespace mechane::state
