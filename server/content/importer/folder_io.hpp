// File access for assimp within one folder: a model may refer to buffers, materials and images beside itself, but not to /etc/passwd.
#pragma once

#include <filesystem>
#include <optional>

#include <assimp/DefaultIOSystem.h>

namespace mechane::content {

/// OBJ files are read through plain_obj().
class FolderIo : public Assimp::DefaultIOSystem {
 public:
  /// Only files in `folder` of at most `most_bytes` each can be opened.
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
