// File access for assimp that ends at a folder: a model may name buffers, materials and images beside itself, not /etc/passwd.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <assimp/DefaultIOSystem.h>

namespace mechane::content {

/// ".obj", whatever the case in the name.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);

/// OBJ files are opened as plain_obj gives them.
class FolderIo : public Assimp::DefaultIOSystem {
 public:
  /// `folder` and `most_bytes` (of one file) bound what can be opened.
  FolderIo(const std::filesystem::path& folder, std::uint64_t most_bytes);

  bool Exists(const char* name) const override;
  Assimp::IOStream* Open(const char* name, const char* mode) override;

  /// The real path of a file named by the model, if it lies in the folder (links followed), exists and is not too long.
  [[nodiscard]] std::optional<std::filesystem::path> allowed(const std::filesystem::path& name) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
};

}  // namespace mechane::content
