// The folder for a display's pictures. Encoding a PNG takes longer than drawing it, so a thread of its own does it.
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

/// Owns a thread. The functions are called on the display's thread.
class PictureFolder {
 public:
  /// How many pictures may wait in memory; the next call waits until one has been written.
  static constexpr std::size_t kMostWaiting = 4;

  struct Written {
    std::string path;
    bool requested = false;               ///< by a person, not by an option
    std::vector<std::uint64_t> requests;  ///< ids of its requests over the network
    Expected<void> result;
  };

  /// `folder` must exist; empty: nothing is written.
  PictureFolder(std::string folder, picture::Stereo stereo) : folder_(std::move(folder)), stereo_(stereo) {}
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  [[nodiscard]] bool wanted() const { return !folder_.empty(); }
  /// Queues a picture to be written under this name; an existing file is replaced.
  void write(picture::ImageData picture, const std::string& name);
  /// The same under a new name: existing files, of an earlier run or of another display, are kept.
  void write_requested(picture::ImageData picture, std::vector<std::uint64_t> requests);

  /// The pictures that were written, or failed, since the last call; in order.
  [[nodiscard]] std::vector<Written> take_written();
  /// The same after waiting until all pictures are written.
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
