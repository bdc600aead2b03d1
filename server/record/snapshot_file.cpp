#include "server/record/snapshot_file.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <xxhash.h>

#include "server/base/byte_order.hpp"
#include "server/base/whole_file.hpp"
#include "server/record/file.hpp"

// A file: magic "MECHWRLD", u32 version, u64 checksum (XXH3-64) of what follows: s world, s kiosk, s scenario, s scenario hash,
// u64 tick, u64 wall time ns, s state.
namespace mechane::record {
namespace {

constexpr char kMagic[8] = {'M', 'E', 'C', 'H', 'W', 'R', 'L', 'D'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kPrefix = sizeof kMagic + 4 + 8;
constexpr std::uintmax_t kMostBytes = 256U << 20;  // far more than the state of any world
constexpr const char* kExtension = ".snapshot";

std::vector<std::byte> to_bytes(const SnapshotInfo& info, std::span<const std::byte> state) {
  std::vector<std::byte> body;
  VectorSink sink(body);
  for (const std::string* text : {&info.world_id, &info.kiosk, &info.scenario_id, &info.scenario_hash})
    put_string(sink, *text);
  put(sink, info.tick);
  put(sink, info.wall_ns);
  put_bytes(sink, state);
  std::vector<std::byte> bytes;
  VectorSink file(bytes);
  file.append(reinterpret_cast<const std::byte*>(kMagic), sizeof kMagic);
  put(file, kVersion);
  put(file, static_cast<std::uint64_t>(XXH3_64bits(body.data(), body.size())));
  file.append(body.data(), body.size());
  return bytes;
}

}  // namespace

std::filesystem::path snapshot_path(const std::filesystem::path& folder, const std::string& world_id) {
  return folder / (file_name_of(world_id) + kExtension);
}

Expected<void> write_snapshot_file(const std::filesystem::path& path, const SnapshotInfo& info,
                                   std::span<const std::byte> state) {
  return write_whole(path, to_bytes(info, state), WholeFile::durable);
}

Expected<SnapshotFile> read_snapshot_file(const std::filesystem::path& path) {
  const std::string where = path.string();
  const Expected<std::vector<std::byte>> file = read_whole(path, kMostBytes);
  if (!file) return tl::unexpected(file.error());
  const std::span<const std::byte> bytes = *file;
  if (bytes.size() < kPrefix || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0) {
    return fail(ErrorCode::damaged, "is not a snapshot of a world", where, "remove it; the world starts afresh");
  }
  ByteSource prefix(bytes.subspan(sizeof kMagic));
  if (const auto version = prefix.get<std::uint32_t>(); version != kVersion) {
    return fail(ErrorCode::wrong_version,
                fmt::format("is a snapshot of version {}; this program reads version {}", version, kVersion), where,
                "use the release that wrote it, or remove it");
  }
  const auto checksum = prefix.get<std::uint64_t>();
  const auto body = bytes.subspan(kPrefix);
  ByteSource in(body);
  SnapshotFile out;
  SnapshotInfo& info = out.info;
  for (std::string* field : {&info.world_id, &info.kiosk, &info.scenario_id, &info.scenario_hash})
    *field = in.get_string();
  info.tick = in.get<std::uint64_t>();
  info.wall_ns = in.get<std::uint64_t>();
  const auto state = in.get_bytes();
  if (XXH3_64bits(body.data(), body.size()) != checksum || !in.ok() || in.remaining() != 0) {
    return fail(ErrorCode::damaged, "the snapshot is damaged", where, "remove it; the world starts afresh");
  }
  out.state.assign(state.begin(), state.end());
  return out;
}

std::vector<std::filesystem::path> find_snapshots(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  for (const std::filesystem::path& path : files_of(folder)) {
    if (path.extension() == kExtension) found.push_back(path);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace mechane::record
