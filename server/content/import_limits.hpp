// How large a mesh file may be before it is refused. The child that reads the file and the parent that reads the child's result have the
// same limits.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>

namespace mechane::content {

/// The defaults are many times what a detailed exhibit needs.
struct ImportLimits {
  std::uint64_t file_bytes = 512ULL << 20U;
  std::uint32_t nodes = 20'000;
  std::uint32_t meshes = 20'000;
  std::uint32_t materials = 2'000;
  std::uint32_t textures = 500;
  std::uint64_t vertices = 4'000'000;           ///< of all meshes together
  std::uint64_t triangles = 4'000'000;          ///< of all meshes together
  std::uint64_t texture_bytes = 256ULL << 20U;  ///< of all textures together, as they lie in the file
  double largest_m = 1000;                      ///< a wider model was not exported in metres
  double smallest_m = 0.0005;                   ///< a narrower one was not, either
  std::uint64_t memory_bytes = 2ULL << 30U;     ///< address space of the child; not applied under the address sanitizer
  std::uint32_t cpu_seconds = 15;               ///< processor time of the child
  std::chrono::milliseconds wall_time{20'000};  ///< after this the child is killed
  std::filesystem::path helper;                 ///< the program mechane-mesh-import; empty: looked for, see import_mesh
};

}  // namespace mechane::content
