// A loader for programs that need a scenario without its collision parts: catalogue, visitor.
#pragma once

#include "server/scenario/compiler.hpp"

namespace mechane::scenario {

/// Hashes mesh files, and does not read their content.
class FileFinder final : public ObjectLoader {
 public:
  [[nodiscard]] Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path&,
                                                                        const std::string&,
                                                                        const geometry::SolidChoice&) override {
    return nullptr;
  }
  [[nodiscard]] Expected<std::optional<Solid>> solid(const std::filesystem::path&, const std::string&) override {
    return std::nullopt;
  }
  [[nodiscard]] Expected<std::string> content_hash(const std::filesystem::path& file) override {
    return hash_file(file);
  }
};

}  // namespace mechane::scenario
