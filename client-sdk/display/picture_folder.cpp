#include "client-sdk/display/picture_folder.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "client-sdk/picture/image_file.hpp"

namespace mechane::display {

std::string PictureFolder::path_of(const std::string& name) const {
  return fmt::format("{}/{}-{}.png", folder_, name, picture::stereo_name(stereo_));
}

void PictureFolder::queue(picture::ImageData picture, Written written) {
  if (!wanted()) return;
  worker_.wait_until_left(kMostWaiting - 1);
  worker_.give([this, picture = std::move(picture), written = std::move(written)]() mutable {
    written.result = picture::write_png(picture, written.path);
    const std::lock_guard lock(mutex_);
    written_.push_back(std::move(written));
  });
}

void PictureFolder::write(picture::ImageData picture, const std::string& name) {
  queue(std::move(picture), {path_of(name), false, {}, {}});
}

void PictureFolder::write_requested(picture::ImageData picture, std::vector<std::uint64_t> requests) {
  std::string path;
  std::error_code unreadable;
  do {
    path = path_of(fmt::format("request-{:03}", ++requested_));
  } while (std::filesystem::exists(path, unreadable));
  queue(std::move(picture), {std::move(path), true, std::move(requests), {}});
}

std::vector<PictureFolder::Written> PictureFolder::take_written() {
  const std::lock_guard lock(mutex_);
  return std::exchange(written_, {});
}

std::vector<PictureFolder::Written> PictureFolder::finish() {
  worker_.wait_until_left(0);
  return take_written();
}

}  // namespace mechane::display
