// Any bytes as the message of a mesh import: an Error with a code that exists, or a scene that check_scene accepts. The checksum would stop
// nearly every input, so the bytes are tried as they are, and as the payload of a scene and of an error with a right header.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

#include "server/content/scene_check.hpp"
#include "server/content/scene_codec.hpp"

namespace {

void try_message(std::span<const std::byte> message) {
  const mechane::content::ImportLimits limits;
  const auto scene = mechane::content::decode_scene(message, limits);
  if (!scene) {
    const mechane::Error& error = scene.error();
    if (error.code > mechane::kLastErrorCode || error.line < 0) std::abort();
    return;
  }
  if (!mechane::content::check_scene(*scene, limits)) std::abort();
  (void)mechane::content::collision_parts(*scene, "");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
  try_message(bytes);
  std::vector<std::byte> message(mechane::content::kSceneHeaderBytes);
  message.insert(message.end(), bytes.begin(), bytes.end());
  for (const auto kind : {mechane::content::SceneMessage::scene, mechane::content::SceneMessage::failure}) {
    mechane::content::seal_scene(message, kind);
    try_message(message);
  }
  return 0;
}
