// A recording may come on a stick from another museum: whatever its bytes, it is drawn or refused. Where the first byte is even, the rest
// is the payload of a record with a right checksum, after a status and a manifest: a fuzzer would not find the checksum by itself.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "client-sdk/recording/frame_recording.hpp"
#include "client-sdk/recording/recorded_client.hpp"
#include "client-sdk/recording/recording_codec.hpp"

namespace {

using namespace mechane;

std::vector<std::byte> with_record(std::uint8_t kind, std::span<const std::byte> payload) {
  recording::RecordingWriter writer;
  client::WorldStatus status;
  status.world = "world-1";
  writer.add(recording::RecordKind::status, Duration{0}, recording::encode(status));
  writer.add(recording::RecordKind::manifest, Duration{0}, recording::encode(std::vector<client::SceneObject>(2)));
  client::Frame frame;
  frame.visible = {1, 1};
  writer.add(recording::RecordKind::frame, Duration{0}, recording::encode(frame));
  writer.add(static_cast<recording::RecordKind>(kind), std::chrono::milliseconds(5), payload);
  return writer.take_bytes();
}

void must(bool held) {
  if (!held) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> input = std::as_bytes(std::span(data, size));
  const bool record = size > 0 && data[0] % 2 == 0;  // a file's own first byte is odd
  std::vector<std::byte> bytes = record ? with_record(static_cast<std::uint8_t>(data[0] / 2 % 8), input.subspan(1))
                                        : std::vector<std::byte>(input.begin(), input.end());
  auto recording = recording::FrameRecording::open_bytes(std::move(bytes), "fuzz");
  if (!recording) return 0;
  const Duration duration = recording->duration();
  recording::RecordedClient client(std::move(*recording), {});
  const TimePoint begun(std::chrono::hours(1));
  for (const Duration at :
       {Duration{0}, std::chrono::duration_cast<Duration>(std::chrono::milliseconds(2)), duration}) {
    client.advance(begun + at);
    client::Frame frame;
    must(client.interpolated_frame(begun + at, Duration{0}, frame) && client.world_status());
    for (const auto& body : frame.bodies)
      must(std::abs(body.X_WB.R.norm() - 1) < 1e-6 && body.object < frame.visible.size());
    for (const auto& rope : frame.ropes)
      must(rope.diameter_m > 0);
  }
  must(client.over());
  return 0;
}
