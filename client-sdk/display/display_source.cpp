#include "client-sdk/display/display_source.hpp"

#include <filesystem>
#include <system_error>

namespace mechane::display {
namespace {

bool same_file(const std::string& one, const std::string& other) {
  std::error_code not_there;  // a missing file cannot be overwritten
  return !one.empty() && !other.empty() && std::filesystem::equivalent(one, other, not_there);
}

}  // namespace

Expected<void> check_recordings(const SourceOptions& options, const std::string& attract) {
  const bool played = same_file(options.record, options.play);
  if (!played && !same_file(options.record, attract)) return {};
  return fail(ErrorCode::conflict,
              std::string("this is the file of ") + (played ? "--play" : "--attract") + ", and would be overwritten",
              "--record " + options.record, "give --record another name");
}

Expected<DisplaySource> open_source(const SourceOptions& options, const client::ClientConfig& server) {
  DisplaySource source;
  if (options.play.empty()) {
    auto client = client::Client::connect(server);
    if (!client) return tl::unexpected(client.error());
    source.client = std::move(*client);
  } else {
    auto recording = recording::FrameRecording::open_file(options.play);
    if (!recording) return tl::unexpected(recording.error());
    recording::PlaySettings player = options.player;
    if (!options.play_from.empty()) {
      const auto from = recording->moment(options.play_from);
      if (!from) return tl::unexpected(from.error());
      player.from = *from;
    }
    auto recorded = std::make_unique<recording::RecordedClient>(std::move(*recording), player);
    source.recorded = recorded.get();
    source.client = std::move(recorded);
  }
  if (options.record.empty()) return source;
  auto recorder = recording::FrameRecorder::create(options.record, options.recorder);
  if (!recorder) return tl::unexpected(recorder.error());
  source.recorder.emplace(std::move(*recorder));
  return source;
}

}  // namespace mechane::display
