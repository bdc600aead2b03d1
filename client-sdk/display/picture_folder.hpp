// The folder that a display writes its pictures to. Encoding a PNG takes longer than drawing it: a thread of its own does that.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "client-sdk/picture/scene_assets.hpp"
#include "client-sdk/picture/stereo.hpp"
#include "server/base/error.hpp"
#include "server/base/worker.hpp"

namespace mechane::display {

/// Owns a thread. The functions are the display's thread's.
class PictureFolder {
 public:
  /// So many pictures wait in memory; who brings one more waits for the first to be written.
  static constexpr std::size_t kMostWaiting = 4;

  struct Written {
    std::string path;
    bool requested = false;               ///< by a person, and not by an option
    std::vector<std::uint64_t> requests;  ///< that asked for it over the network
    Expected<void> result;
  };

  /// `folder` exists; empty: nothing is written.
  PictureFolder(std::string folder, picture::Stereo stereo) : folder_(std::move(folder)), stereo_(stereo) {}
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  [[nodiscard]] bool wanted() const { return !folder_.empty(); }
  /// Queues a picture to be written under this name, in the place of a file that has it.
  void write(picture::ImageData picture, const std::string& name);
  /// The same under a new name: files that are there already, of an earlier run or of another display, stay.
  void write_requested(picture::ImageData picture, std::vector<std::uint64_t> requests);

  /// What was written, or could not be, since the last call; in order.
  [[nodiscard]] std::vector<Written> take_written();
  /// The same once nothing waits any more.
  [[nodiscard]] std::vector<Written> finish();

 private:
  [[nodiscard]] std::string path_of(const std::string& name) const;
  void queue(picture::ImageData picture, Written written);

  std::string folder_;
  picture::Stereo stereo_;
  std::uint32_t requested_ = 0;
  std::mutex mutex_;  // guards what follows
  std::vector<Written> written_;
  Worker worker_{"pictures"};  // last: its jobs use what is above
};

}  // namespace mechane::display
