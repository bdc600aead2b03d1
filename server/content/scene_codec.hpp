// The form in which the child that reads a mesh file hands its result to the parent: one message over a pipe.
//
//   offset  size  field (little endian, as the machines that we run on)
//        0     4  "MSCN"
//        4     4  version (kSceneCodecVersion)
//        8     4  kind: 0 a scene, 1 an error
//       12     4  zero
//       16     8  length of the payload in bytes
//       24     8  XXH3-64 of the payload
//       32        payload
//
// Both ends are the same build, so the version guards against a stale program beside a new one, and the checksum against a child
// that died half way through or wrote something else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/base/error.hpp"
#include "server/content/import_limits.hpp"
#include "server/content/imported_scene.hpp"

namespace mechane::content {

inline constexpr std::uint32_t kSceneCodecVersion = 3;  // 2: occlusion images; 3: an error's code and line
inline constexpr std::size_t kSceneHeaderBytes = 32;

/// A whole message, header included.
[[nodiscard]] std::vector<std::byte> encode_scene(const ImportedScene& scene);
[[nodiscard]] std::vector<std::byte> encode_failure(const Error& error);

/// Makes the header of a message that says `kind` fit the payload that follows it: for tests and fuzzers that change payloads. `message`
/// must hold at least kSceneHeaderBytes.
enum class SceneMessage : std::uint32_t { scene = 0, failure = 1 };
void seal_scene(std::span<std::byte> message, SceneMessage kind = SceneMessage::scene);

/// The longest message that a scene within the limits can make: a reader may refuse longer ones.
[[nodiscard]] std::uint64_t longest_message(const ImportLimits& limits);

/// The scene of a message, checked in full (check_scene), or the error that the message carries, with its code and line. Errors of the
/// message itself: damaged, wrong_version. They cost no more memory than the message.
[[nodiscard]] Expected<ImportedScene> decode_scene(std::span<const std::byte> message, const ImportLimits& limits);

}  // namespace mechane::content
