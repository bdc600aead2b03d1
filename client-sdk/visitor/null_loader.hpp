// A visitor needs a scenario's moves, not its collision parts.
#pragma once

#include "server/scenario/compiler.hpp"

namespace mechane::visitor {

class NullLoader final : public scenario::ObjectLoader {
 public:
  [[nodiscard]] Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path&,
                                                                        const std::string&) override {
    return nullptr;
  }
  [[nodiscard]] Expected<std::string> content_hash(const std::filesystem::path& file) override {
    return scenario::hash_file(file);
  }
};

}  // namespace mechane::visitor
