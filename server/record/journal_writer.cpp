#include "server/record/journal_writer.hpp"

#include <utility>

#include <xxhash.h>

#include "server/base/assert.hpp"
#include "server/base/byte_order.hpp"
#include "server/record/tick_codec.hpp"

namespace mechane::record {

using journal_format::FrameKind;

namespace {
constexpr std::size_t kFullFrame = 256u << 10;
}  // namespace

JournalWriter::JournalWriter(const JournalHeader& header) {
  VectorSink file(bytes_);
  file.append(reinterpret_cast<const std::byte*>(journal_format::kMagic), sizeof journal_format::kMagic);
  put(file, static_cast<std::uint32_t>(header.state_version));
  std::vector<std::byte> payload;
  VectorSink sink(payload);
  for (const std::string* text :
       {&header.world_id, &header.kiosk, &header.scenario_id, &header.scenario_hash, &header.build_id}) {
    put_string(sink, *text);
  }
  put(sink, header.start_wall_ns);
  put(sink, header.first_tick);
  put_bytes(sink, header.snapshot);
  put_frame(FrameKind::header, payload);
  at_.first_tick = header.first_tick;
  at_.next_tick = header.first_tick;
  frame_first_tick_ = header.first_tick;
  last_recorded_ = header.first_tick;
}

void JournalWriter::add(const TickRecord& record) {
  std::byte buffer[kMaxEncodedTick];
  const std::size_t size = encode_tick(record, buffer);
  add_encoded(record.tick, {buffer, size});
}

void JournalWriter::add_encoded(std::uint64_t tick, std::span<const std::byte> encoded) {
  MECHANE_ASSERT(tick >= at_.next_tick);
  note_loss_before(tick);
  if (frame_first_tick_ + journal_format::kMaxTicksPerFrame == tick || ticks_.size() >= kFullFrame) flush();
  at_.next_tick = tick + 1;
  if (is_idle(encoded)) return;
  VectorSink sink(ticks_);
  put_varint(sink, tick - last_recorded_);
  sink.append(encoded.data(), encoded.size());
  last_recorded_ = tick + 1;
}

void JournalWriter::flush() {
  if (at_.next_tick == frame_first_tick_) return;
  std::vector<std::byte> payload;
  VectorSink sink(payload);
  put(sink, frame_first_tick_);
  put(sink, at_.next_tick - 1);
  sink.append(ticks_.data(), ticks_.size());
  put_frame(FrameKind::ticks, payload);
  ticks_.clear();
  frame_first_tick_ = at_.next_tick;
  last_recorded_ = at_.next_tick;
}

void JournalWriter::note_loss_before(std::uint64_t tick) {
  if (tick == at_.next_tick) return;
  flush();
  const std::uint64_t lost = tick - at_.next_tick;
  std::vector<std::byte> payload;
  VectorSink sink(payload);
  put(sink, at_.next_tick);
  put(sink, lost);
  put_frame(FrameKind::loss, payload);
  at_.lost += lost;
  at_.next_tick = tick;
  frame_first_tick_ = tick;
  last_recorded_ = tick;
}

void JournalWriter::close(std::optional<std::uint64_t> hash, std::optional<std::uint64_t> through_tick) {
  if (through_tick && *through_tick > at_.next_tick) note_loss_before(*through_tick);
  flush();
  std::vector<std::byte> payload;
  VectorSink sink(payload);
  put(sink, at_.next_tick - at_.first_tick - at_.lost);
  put(sink, at_.lost);
  put(sink, static_cast<std::uint8_t>(hash ? 1 : 0));
  put(sink, hash.value_or(0));
  put_frame(FrameKind::close, payload);
}

void JournalWriter::put_frame(FrameKind kind, std::span<const std::byte> payload) {
  MECHANE_ASSERT(payload.size() <= journal_format::kMaxPayload);
  std::vector<std::byte> frame;
  frame.reserve(journal_format::kFrameHeadSize + payload.size());
  VectorSink sink(frame);
  put(sink, static_cast<std::uint8_t>(kind));
  put(sink, static_cast<std::uint32_t>(payload.size()));
  sink.append(payload.data(), payload.size());
  const std::uint64_t checksum = XXH3_64bits_withSeed(frame.data(), frame.size(), at_.frame++);
  VectorSink out(bytes_);
  out.append(frame.data(), 5);
  put(out, checksum);
  out.append(payload.data(), payload.size());
}

std::vector<std::byte> JournalWriter::take_bytes() {
  return std::exchange(bytes_, {});
}

void JournalWriter::rewind(const Position& position) {
  bytes_.clear();
  ticks_.clear();
  at_ = position;
  frame_first_tick_ = position.next_tick;
  last_recorded_ = position.next_tick;
}

}  // namespace mechane::record
