// The payloads of a recording: what a display receives, as bytes and back. Rotations, lengths and forces keep the
// wire's precision (float32), quantities their full precision.
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

/// These return false, with `out` in an unspecified state, where the bytes are not valid: cut short or too long, a
/// number that is not finite, a rotation that is not a unit quaternion, a control character in a text. What they accept
/// can be drawn without further checks, as with client::parse(). The caller sets a frame's time of receipt.
[[nodiscard]] bool decode(std::span<const std::byte> bytes, client::WorldStatus& out);
[[nodiscard]] bool decode(std::span<const std::byte> bytes, client::WorldPresentation& out);
[[nodiscard]] bool decode(std::span<const std::byte> bytes, std::vector<client::SceneObject>& out);
[[nodiscard]] bool decode(std::span<const std::byte> bytes, client::Frame& out);
[[nodiscard]] bool decode(std::span<const std::byte> bytes, client::WorldEvent& out);

}  // namespace mechane::recording
