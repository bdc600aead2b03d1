// What a display hears, as bytes and back: the payloads of a recording. Rotations, lengths and forces keep the wire's precision (float32),
// quantities all of theirs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <mechane/client/types.hpp>

namespace mechane::recording {

[[nodiscard]] std::vector<std::byte> encode(const client::WorldStatus& status);
[[nodiscard]] std::vector<std::byte> encode(const client::WorldPresentation& presentation);
[[nodiscard]] std::vector<std::byte> encode(const std::vector<client::SceneObject>& manifest);
[[nodiscard]] std::vector<std::byte> encode(const client::Frame& frame);
[[nodiscard]] std::vector<std::byte> encode(const client::WorldEvent& event);

/// These return false, with `out` in no particular state, where the bytes are no such thing as a whole: cut short or too long, a number that
/// is not finite, a rotation that is not a unit quaternion, a control character in a text. What they take is fit to
/// be drawn, as what client::parse() takes
/// is. A frame's time of receipt is the caller's.
[[nodiscard]] bool decode(std::span<const std::byte> bytes, client::WorldStatus& out);
[[nodiscard]] bool decode(std::span<const std::byte> bytes, client::WorldPresentation& out);
[[nodiscard]] bool decode(std::span<const std::byte> bytes, std::vector<client::SceneObject>& out);
[[nodiscard]] bool decode(std::span<const std::byte> bytes, client::Frame& out);
[[nodiscard]] bool decode(std::span<const std::byte> bytes, client::WorldEvent& out);

}  // namespace mechane::recording
