// The journal's reader accepts any bytes. Unless they begin like a journal, they become the content of a frame with a right checksum, which
// a fuzzer would not find by itself.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include <xxhash.h>

#include "server/base/byte_order.hpp"
#include "server/record/journal_reader.hpp"
#include "server/record/journal_writer.hpp"

namespace {

using mechane::put;
using mechane::VectorSink;
using namespace mechane::record;

std::vector<std::byte> journal_with_frame(std::uint8_t kind, std::span<const std::byte> payload) {
  JournalWriter writer(JournalHeader{});
  std::vector<std::byte> bytes = writer.take_bytes();
  std::vector<std::byte> checked;
  VectorSink sink(checked);
  put(sink, kind);
  put(sink, static_cast<std::uint32_t>(payload.size()));
  sink.append(payload.data(), payload.size());
  VectorSink file(bytes);
  file.append(checked.data(), 5);
  put(file, static_cast<std::uint64_t>(XXH3_64bits_withSeed(checked.data(), checked.size(), 1)));
  file.append(payload.data(), payload.size());
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> input = std::as_bytes(std::span(data, size));
  const bool frame = size > 0 && data[0] != 'M';  // a journal's own first byte
  const std::vector<std::byte> bytes =
      frame ? journal_with_frame(static_cast<std::uint8_t>(data[0] / 2 % 8), input.subspan(1))
            : std::vector<std::byte>(input.begin(), input.end());
  auto reader = JournalReader::open_bytes(bytes, "fuzz");
  if (!reader) return 0;
  JournalTick tick;
  std::uint64_t ticks = 0;
  while (ticks < 10'000 && reader->next(tick))
    ++ticks;
  if (ticks < 10'000 && reader->end().ticks != ticks) std::abort();
  if (ticks < 10'000 && reader->end().offset > bytes.size()) std::abort();
  return 0;
}
