#include "client-sdk/picture/image_file.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>

// The library's own code does not meet our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wcast-align"
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_MAX_DIMENSIONS 8192
#define STBI_NO_STDIO
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace mechane::picture {
namespace {

struct StbFree {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

}  // namespace

Expected<ImageData> decode_image(std::span<const std::byte> bytes, const std::string& where) {
  const char* remedy = "export the image as PNG or JPEG, at most 8192 pixels a side";
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    return fail("the image is too large", where, remedy);
  int width = 0;
  int height = 0;
  int channels = 0;
  const std::unique_ptr<stbi_uc, StbFree> pixels(stbi_load_from_memory(
      reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &width, &height, &channels, 4));
  if (!pixels) return fail(std::string("the image cannot be read: ") + stbi_failure_reason(), where, remedy);
  ImageData image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}, true};
  image.rgba.assign(pixels.get(), pixels.get() + std::size_t{4} * image.width * image.height);
  return image;
}

Expected<void> write_png(const ImageData& image, const std::string& path) {
  const std::string temporary = path + ".part";
  const int written = stbi_write_png(temporary.c_str(), static_cast<int>(image.width), static_cast<int>(image.height),
                                     4, image.rgba.data(), static_cast<int>(4 * image.width));
  if (written == 0 || std::rename(temporary.c_str(), path.c_str()) != 0) {
    std::remove(temporary.c_str());
    return fail("the picture cannot be written", path, "check that the folder exists, is writable and has room");
  }
  return {};
}

}  // namespace mechane::picture
