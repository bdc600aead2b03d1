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

inline constexpr std::uint32_t kSceneCodecVersion = 2;  // 2: occlusion images
inline constexpr std::size_t kSceneHeaderBytes = 32;

/// A whole message, header included.
[[nodiscard]] std::vector<std::byte> encode_scene(const ImportedScene& scene);
[[nodiscard]] std::vector<std::byte> encode_failure(const Error& error);

/// Sets the header of a scene message right for the payload that follows it: for tests and fuzzers that change payloads.
/// `message` must hold at least kSceneHeaderBytes.
void seal_scene(std::span<std::byte> message);

/// The longest message that a scene within the limits can make: what a reader need accept.
[[nodiscard]] std::uint64_t longest_message(const ImportLimits& limits);

/// The scene of a message, checked in full (check_scene), or the error that it carries. Anything else is an Error too, and costs no
/// more memory than the message itself.
[[nodiscard]] Expected<ImportedScene> decode_scene(std::span<const std::byte> message, const ImportLimits& limits);

}  // namespace mechane::content
