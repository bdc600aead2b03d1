#include "server/record/journal_channel.hpp"

#include <chrono>
#include <span>
#include <utility>

#include "server/base/byte_order.hpp"
#include "server/record/snapshot_file.hpp"

namespace mechane::record {
namespace {

// Before each record in the ring: its tick's number.
constexpr std::size_t kNumberSize = 8;

std::uint64_t number_of(std::span<const std::byte> record) {
  ByteSource number(record);
  return number.get<std::uint64_t>();
}

}  // namespace

JournalChannel::JournalChannel(const JournalHeader& header, std::filesystem::path journal,
                               std::filesystem::path snapshot, std::size_t ring_bytes, std::size_t snapshot_capacity,
                               Duration retry_after, std::vector<std::filesystem::path> replaced)
    : ring_(ring_bytes),
      snapshots_([snapshot_capacity] {
        Snapshot slot;
        slot.bytes.reserve(snapshot_capacity);
        return slot;
      }),
      encoded_{},
      through_tick_(header.first_tick),
      taken_through_(header.first_tick),
      header_(header),
      journal_path_(std::move(journal)),
      snapshot_path_(std::move(snapshot)),
      replaced_(std::move(replaced)),
      retry_after_(retry_after),
      writer_(header),
      stored_(writer_.position()),
      beginning_(writer_.take_bytes()) {
  header_.snapshot = {};
}

void JournalChannel::push(const TickRecord& record) noexcept {
  const std::span<std::byte> buffer(encoded_);
  SpanSink number(buffer);
  put(number, record.tick);
  const std::size_t size = encode_tick(record, buffer.subspan(kNumberSize));
  if (!ring_.push(buffer.first(kNumberSize + size))) {
    refused_.store(refused_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  through_tick_.store(record.tick + 1, std::memory_order_release);
}

void JournalChannel::commit_snapshot(std::uint64_t tick) noexcept {
  snapshots_.writable().tick = tick;
  snapshots_.commit();
}

void JournalChannel::drain(TimePoint now) {
  write_snapshot();
  if (given_up_ || (rest_until_ && now < *rest_until_)) return discard();
  gather();
  store(now);
}

// From the ring to the writer. Where ticks are missing, for which the ring or the disk had no room, the writer notices the gap.
void JournalChannel::gather() {
  for (auto front = ring_.front(); front.found; front = ring_.front()) {
    const std::uint64_t tick = number_of(front.record);
    writer_.add_encoded(tick, front.record.subspan(kNumberSize));
    taken_through_ = tick + 1;
    ring_.pop();
  }
}

void JournalChannel::discard() {
  for (auto front = ring_.front(); front.found; front = ring_.front()) {
    taken_through_ = number_of(front.record) + 1;
    ring_.pop();
  }
}

void JournalChannel::store(TimePoint now) {
  writer_.flush();
  const std::vector<std::byte> bytes = writer_.take_bytes();
  if (bytes.empty() && beginning_.empty()) return;
  if (auto appended = append(bytes); !appended) {
    journal_problem_ = appended.error().to_string();
    writer_.rewind(stored_);
    rest_until_ = now + retry_after_;
    return;
  }
  stored_ = writer_.position();
  journal_problem_.clear();
  rest_until_.reset();
}

Expected<void> JournalChannel::append(std::span<const std::byte> bytes) {
  if (!file_.is_open()) {
    auto created = AppendFile::create(journal_path_);
    if (!created) return tl::unexpected(created.error());
    file_ = std::move(*created);
  }
  if (!beginning_.empty()) {
    if (auto begun = file_.append(beginning_); !begun) {
      // An empty file is not a journal: try from the start.
      file_.close();
      std::error_code ignored;
      std::filesystem::remove(journal_path_, ignored);
      return begun;
    }
    bytes_written_ += beginning_.size();
    beginning_ = {};
  }
  if (bytes.empty()) return {};
  auto appended = file_.append(bytes);
  if (appended) bytes_written_ += bytes.size();
  given_up_ = !file_.is_open();
  return appended;
}

void JournalChannel::write_snapshot() {
  const Snapshot* snapshot = snapshots_.take();
  if (snapshot == nullptr) return;
  const SnapshotInfo info{header_.world_id,      header_.kiosk,  header_.scenario_id,
                          header_.scenario_hash, snapshot->tick, wall_now_ns()};
  auto written = write_snapshot_file(snapshot_path_, info, snapshot->bytes);
  snapshot_problem_ = written ? std::string() : written.error().to_string();
  if (!written) return;
  ++snapshots_written_;
  remove_replaced();
}

void JournalChannel::remove_replaced() {
  std::error_code ignored;
  for (const std::filesystem::path& path : std::exchange(replaced_, {}))
    std::filesystem::remove(path, ignored);
}

void JournalChannel::sync() {
  if (!file_.is_open()) return;
  auto synced = file_.sync();
  sync_problem_ = synced ? std::string() : synced.error().to_string();
}

const std::string& JournalChannel::problem() const {
  if (!journal_problem_.empty()) return journal_problem_;
  return sync_problem_.empty() ? snapshot_problem_ : sync_problem_;
}

std::uint64_t JournalChannel::ticks_lost() const {
  // What is still in the ring is not lost: the disk may have room again before it is written.
  if (journal_problem_.empty()) return writer_.lost_ticks();
  return writer_.lost_ticks() + (taken_through_ - stored_.next_tick);
}

void JournalChannel::finish(TimePoint now, std::optional<std::uint64_t> hash, bool remove_snapshot) {
  write_snapshot();
  if (remove_snapshot) {
    remove_replaced();
    std::error_code ignored;  // there may be no snapshot
    std::filesystem::remove(snapshot_path_, ignored);
  }
  // One last try, even before the time to try again has come.
  given_up_ ? discard() : gather();
  taken_through_ = through_tick();
  if (given_up_) return;
  writer_.close(hash, taken_through_);
  store(now);
  sync();
  file_.close();
}

}  // namespace mechane::record
