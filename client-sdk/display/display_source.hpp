// Where a display gets its worlds from (a server or a recording), and where it records them to.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client-sdk/recording/frame_recording.hpp"
#include "client-sdk/recording/recorded_client.hpp"
#include "server/base/error.hpp"
#include <mechane/client/client.hpp>

namespace mechane::display {

struct SourceOptions {
  std::string play;                ///< file of a recording; empty: a server
  std::string play_from;           ///< for FrameRecording::moment(); empty: the beginning
  recording::PlaySettings player;  ///< its `from` is set from play_from
  std::string record;              ///< file; empty: nothing is recorded
  recording::RecorderSettings recorder;
};

/// Used on the display's thread.
struct DisplaySource {
  std::unique_ptr<client::Client> client;
  recording::RecordedClient* recorded = nullptr;  ///< the same client, if it is a recording
  std::optional<recording::FrameRecorder> recorder;
};

/// Errors: `record` is also read as a recording, by this name or another (a link, another spelling), and would be
/// overwritten. `attract`: file of the recording that is shown while nobody is there; empty: none.
[[nodiscard]] Expected<void> check_recordings(const SourceOptions& options, const std::string& attract);

/// Errors: those of Client::connect(), of FrameRecording and of FrameRecorder.
[[nodiscard]] Expected<DisplaySource> open_source(const SourceOptions& options, const client::ClientConfig& server);

}  // namespace mechane::display
