#include "server/content/importer/image_file.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

#include "server/base/whole_file.hpp"

namespace mechane::content {
namespace {

std::optional<TextureEncoding> encoding_of(std::span<const std::byte> bytes) {
  constexpr unsigned char kPng[] = {0x89, 'P', 'N', 'G'};
  constexpr unsigned char kJpeg[] = {0xFF, 0xD8, 0xFF};
  if (bytes.size() > sizeof kPng && std::memcmp(bytes.data(), kPng, sizeof kPng) == 0) return TextureEncoding::png;
  if (bytes.size() > sizeof kJpeg && std::memcmp(bytes.data(), kJpeg, sizeof kJpeg) == 0) return TextureEncoding::jpeg;
  return std::nullopt;
}

}  // namespace

Expected<ImportedTexture> encoded_texture(const std::string& name, std::span<const std::byte> bytes) {
  const auto encoding = encoding_of(bytes);
  if (!encoding) {
    return fail(ErrorCode::not_supported, "the image is neither PNG nor JPEG", "texture " + name,
                "export the images as PNG or JPEG");
  }
  return ImportedTexture{name, *encoding, 0, 0, {bytes.begin(), bytes.end()}};
}

Expected<ImportedTexture> texture_file(const FolderIo& io, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const auto file = io.allowed(name);
  if (!file) {
    return fail(ErrorCode::not_found, "the image is not in the model's folder", "texture " + name,
                "put it there, or export the model with its images inside (.glb)");
  }
  const auto bytes = read_whole(*file, std::numeric_limits<std::uintmax_t>::max());  // allowed() has a limit
  if (!bytes) return tl::unexpected(bytes.error().in("texture " + name));
  return encoded_texture(name, *bytes);
}

}  // namespace mechane::content
