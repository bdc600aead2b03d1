// Cuts single moments out of a recorded visit, for the picture tests: a status, a frame, and what they need, a second apart.
//
//   cut_scenes FROM TO MOMENT...     a moment is as FrameRecording::moment() has it: 12.5, turn@0.4, @0.5
//
// Where the scenario lay on the recording machine is left out.
#include <cstdio>
#include <fstream>

#include <fmt/format.h>

#include "client-sdk/recording/recorded_client.hpp"
#include "client-sdk/recording/recording_codec.hpp"

namespace {

using namespace mechane;

Expected<std::vector<std::byte>> cut(const char* from, std::span<char*> moments) {
  const auto recording = recording::FrameRecording::open_file(from);
  if (!recording) return tl::unexpected(recording.error());
  recording::RecordingWriter writer;
  std::string world;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const auto at = recording->moment(moments[i]);
    if (!at) return tl::unexpected(at.error());
    recording::PlaySettings settings;
    settings.from = *at;
    auto again = recording::FrameRecording::open_file(from);
    if (!again) return tl::unexpected(again.error());
    recording::RecordedClient client(std::move(*again), settings);
    client.advance(TimePoint{});
    const Duration time = i * std::chrono::seconds(1);
    client::WorldStatus status = *client.world_status();
    status.scenario_folder.clear();
    writer.add(recording::RecordKind::status, time, recording::encode(status));
    if (std::exchange(world, status.world) != status.world) {
      writer.add(recording::RecordKind::presentation, time, recording::encode(*client.presentation()));
      writer.add(recording::RecordKind::manifest, time, recording::encode(client.objects()));
    }
    client::Frame frame;
    (void)client.newest_frame(frame);
    writer.add(recording::RecordKind::frame, time, recording::encode(frame));
    fmt::print("{}: {:.2f} s, step '{}'{}\n", moments[i], to_seconds(*at), status.step, status.done ? ", done" : "");
  }
  writer.add(recording::RecordKind::end, Duration{0}, {});
  return writer.take_bytes();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: cut_scenes FROM TO MOMENT...\n", stderr);
    return 2;
  }
  const auto bytes = cut(argv[1], std::span(argv + 3, argv + argc));
  if (!bytes) {
    std::fprintf(stderr, "cut_scenes: %s\n", bytes.error().to_string().c_str());
    return 1;
  }
  std::ofstream file(argv[2], std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
  file.flush();
  return file ? 0 : 1;
}
