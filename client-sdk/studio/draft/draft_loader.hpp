// What a draft's mesh files hold: as a server will find them beside the exhibit's file, with the draft itself in that file's place, and
// its own files over those of the exhibit.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "server/scenario/compiler.hpp"

namespace mechane::studio {

/// Passes on to another loader: a MeshFinder, which looks into files, or a FileFinder, which is quick. One thread.
class DraftLoader final : public scenario::ObjectLoader {
 public:
  /// `exhibit`: the exhibit's file, which need not be there; `draft`: the file with the draft's text. `inner` outlives this.
  DraftLoader(std::filesystem::path exhibit, std::filesystem::path draft, scenario::ObjectLoader& inner);

  [[nodiscard]] Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path& file,
                                                                        const std::string& node,
                                                                        const geometry::SolidChoice& solid) override;
  [[nodiscard]] Expected<void> find_node(const std::filesystem::path& file, const std::string& node) override;
  [[nodiscard]] Expected<std::optional<scenario::Solid>> solid(const std::filesystem::path& file,
                                                               const std::string& node) override;
  [[nodiscard]] bool has_meshes_at_hand() const override { return inner_.has_meshes_at_hand(); }
  [[nodiscard]] Expected<std::string> content_hash(const std::filesystem::path& file) override;

 private:
  [[nodiscard]] std::filesystem::path place_of(const std::filesystem::path& file) const;

  std::filesystem::path exhibit_;
  std::filesystem::path draft_;
  scenario::ObjectLoader& inner_;
  bool has_folder_;
};

}  // namespace mechane::studio
