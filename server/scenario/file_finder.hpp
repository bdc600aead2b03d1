// For who needs a scenario without its collision parts: a checker, a visitor.
#pragma once

#include "server/scenario/compiler.hpp"

namespace mechane::scenario {

/// Looks whether mesh files are there and names their content; builds nothing.
class FileFinder final : public ObjectLoader {
 public:
  [[nodiscard]] Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path&,
                                                                        const std::string&) override {
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
