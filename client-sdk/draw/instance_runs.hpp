// Groups equal pieces into one draw call: one call for many trees.
#pragma once

#include <cstdint>
#include <vector>

#include "client-sdk/picture/scene_parts.hpp"

namespace mechane::draw {

/// Pieces of one instance's mesh that are to be drawn one after another.
struct ShownPieces {
  float order = 0;  ///< pieces of different order are not grouped
  std::uint32_t instance = 0;
  std::vector<std::uint32_t> pieces;
};

/// The same pieces of one mesh, in one material, of one instance or more.
struct InstanceRun {
  std::uint32_t mesh = 0;
  std::uint32_t material = 0;
  std::vector<std::uint32_t> pieces;
  std::vector<Eigen::Affine3f> X_WM;  ///< of each instance
};

/// Runs, in the order of their first members.
[[nodiscard]] std::vector<InstanceRun> runs_of(const std::vector<picture::Instance>& instances,
                                               const std::vector<ShownPieces>& shown);

}  // namespace mechane::draw
