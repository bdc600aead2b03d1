// What finds a visitor's hand in a camera's pictures: a model that runs in the page, or a program beside the browser. Where there is
// neither, the camera hand is off. Pictures stay on the browser's machine in both cases.
#pragma once

#include <cstdint>
#include <filesystem>

#include "server/base/error.hpp"

namespace mechane::gateway {

struct HandFinders {
  bool model = false;         ///< pages get it at /hand-model
  std::uint16_t program = 0;  ///< its port on the browser's own machine; 0: no program
};

/// Looks at the first bytes of a model, a bundle of MediaPipe (a zip file). Errors: io_failure, damaged.
[[nodiscard]] Expected<void> check_hand_model(const std::filesystem::path& file);

}  // namespace mechane::gateway
