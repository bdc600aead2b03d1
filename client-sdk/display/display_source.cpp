#include "client-sdk/display/display_source.hpp"

#include "server/log/log.hpp"

namespace mechane::display {

Expected<DisplaySource> open_source(const SourceOptions& options, const client::ClientConfig& server) {
  DisplaySource source;
  if (options.play.empty()) {
    auto client = client::Client::connect(server);
    if (!client) return tl::unexpected(client.error());
    source.client = std::move(*client);
  } else {
    auto recording = FrameRecording::open_file(options.play);
    if (!recording) return tl::unexpected(recording.error());
    if (recording->cut_off()) log::warning("the recording " + options.play + " was cut off; what there is, is shown");
    PlaySettings player = options.player;
    if (!options.play_from.empty()) {
      const auto from = recording->moment(options.play_from);
      if (!from) return tl::unexpected(from.error());
      player.from = *from;
    }
    auto recorded = std::make_unique<RecordedClient>(std::move(*recording), player);
    source.recorded = recorded.get();
    source.client = std::move(recorded);
  }
  if (options.record.empty()) return source;
  auto recorder = FrameRecorder::create(options.record, options.recorder);
  if (!recorder) return tl::unexpected(recorder.error());
  source.recorder.emplace(std::move(*recorder));
  return source;
}

}  // namespace mechane::display
