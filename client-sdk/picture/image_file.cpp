#include "client-sdk/picture/image_file.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

// The library's code would raise our compiler warnings.
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
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include "server/base/whole_file.hpp"

namespace mechane::picture {
namespace {

struct StbFree {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

}  // namespace

Expected<ImageData> decode_image(std::span<const std::byte> bytes, const std::string& where) {
  const char* remedy = "export the image as PNG or JPEG, at most 8192 pixels a side";
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    return fail(ErrorCode::too_large, "the image is too large", where, remedy);
  int width = 0;
  int height = 0;
  int channels = 0;
  const std::unique_ptr<stbi_uc, StbFree> pixels(stbi_load_from_memory(
      reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &width, &height, &channels, 4));
  if (!pixels)
    return fail(ErrorCode::damaged, std::string("the image cannot be read: ") + stbi_failure_reason(), where, remedy);
  ImageData image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}, true};
  image.rgba.assign(pixels.get(), pixels.get() + std::size_t{4} * image.width * image.height);
  return image;
}

Expected<void> write_png(const ImageData& image, const std::string& path) {
  std::vector<std::byte> png;
  const auto append = [](void* to, void* from, int size) {
    auto& bytes = *static_cast<std::vector<std::byte>*>(to);
    const auto* begin = static_cast<const std::byte*>(from);
    bytes.insert(bytes.end(), begin, begin + size);
  };
  if (stbi_write_png_to_func(append, &png, static_cast<int>(image.width), static_cast<int>(image.height), 4,
                             image.rgba.data(), static_cast<int>(4 * image.width)) == 0)
    return fail(ErrorCode::too_large, "the computer has too little memory to write this picture", path,
                "draw a smaller picture");
  return write_whole(path, png, WholeFile::document);
}

}  // namespace mechane::picture
