// Pictures that a person has accepted: JPEG, so that the repository does not grow by megabytes each time the renderer is mended.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

// The library's own code does not meet our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wcast-align"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include "client-sdk/picture/image_file.hpp"

namespace mechane::test {

/// As it is kept in a file. The same picture gives the same bytes.
[[nodiscard]] inline std::vector<std::byte> jpeg_of(const picture::ImageData& image) {
  constexpr int kQuality = 90;
  std::vector<std::byte> out;
  const auto append = [](void* to, void* data, int size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    static_cast<std::vector<std::byte>*>(to)->insert(static_cast<std::vector<std::byte>*>(to)->end(), bytes,
                                                     bytes + size);
  };
  stbi_write_jpg_to_func(append, &out, static_cast<int>(image.width), static_cast<int>(image.height), 4,
                         image.rgba.data(), kQuality);
  return out;
}

/// What is compared: a picture that went the same way as the accepted one, so that what JPEG leaves out is left out of both.
[[nodiscard]] inline picture::ImageData as_kept(const picture::ImageData& image) {
  return picture::decode_image(jpeg_of(image), "a picture in memory").value();
}

[[nodiscard]] inline bool write_reference(const picture::ImageData& image, const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = jpeg_of(image);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.flush();
  return file.good();
}

/// Nothing where there is none.
[[nodiscard]] inline std::optional<picture::ImageData> read_reference(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  auto image = picture::decode_image(std::as_bytes(std::span(bytes)), file.string());
  return image ? std::optional(std::move(*image)) : std::nullopt;
}

}  // namespace mechane::test
