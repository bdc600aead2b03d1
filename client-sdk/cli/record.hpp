// `mechane record FILE`: records what a kiosk's displays hear, without drawing.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "client-sdk/recording/frame_recording.hpp"

namespace mechane::cli {

struct RecordOptions {
  std::string file;
  std::string kiosk = "kiosk-1";
  std::uint32_t domain = 0;
  double seconds = 0;  ///< 0: until a signal
  recording::RecorderSettings recorder;
};

/// Runs until Ctrl-C or SIGTERM, or for so long as asked. Returns the exit status: 1 if the file cannot be written, the
/// network cannot be joined, the recording ended early (a full disk, the size limit), or there was no frame to record.
[[nodiscard]] int run_record(const RecordOptions& options, std::ostream& err);

}  // namespace mechane::cli
