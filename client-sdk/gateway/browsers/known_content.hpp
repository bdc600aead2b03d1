// Which mesh files and exhibits this gateway has heard of: only these are served. On the loop's thread.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include <mechane/client/types.hpp>

namespace mechane::gateway {

class KnownContent {
 public:
  static constexpr std::size_t kMostMeshes = 10'000;
  static constexpr std::size_t kMostExhibits = 200;

  /// A world was heard of, on this machine or another.
  void hear(const client::WorldStatus& status, std::span<const client::SceneObject> objects);

  struct Mesh {
    std::filesystem::path folder;
    std::string path;  ///< its name there
  };
  [[nodiscard]] std::optional<Mesh> mesh(const std::string& hash) const;
  /// The exhibit's folder, by the scenario's id.
  [[nodiscard]] std::optional<std::filesystem::path> exhibit(const std::string& scenario) const;

 private:
  std::map<std::string, Mesh> meshes_;
  std::map<std::string, std::filesystem::path> exhibits_;
};

}  // namespace mechane::gateway
