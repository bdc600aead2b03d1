#include "client-sdk/studio/draft/draft_loader.hpp"

#include "client-sdk/studio/draft/draft_files.hpp"

namespace mechane::studio {

namespace fs = std::filesystem;

DraftLoader::DraftLoader(fs::path exhibit, fs::path draft, scenario::ObjectLoader& inner)
    : exhibit_(std::move(exhibit)), draft_(std::move(draft)), inner_(inner) {
  std::error_code unknown;
  has_folder_ = fs::is_directory(exhibit_.parent_path(), unknown);
}

fs::path DraftLoader::place_of(const fs::path& file) const {
  if (file == exhibit_) return draft_;
  const fs::path plain = file.lexically_normal();
  const fs::path url = plain.lexically_relative(exhibit_.parent_path().lexically_normal());
  if (fs::path own = own_file(draft_.parent_path(), url); !own.empty()) return own;
  // A folder that is made only when the draft is published: "new/../models/a.glb" is there, but the system cannot find the way.
  return has_folder_ ? file : plain;
}

Expected<std::shared_ptr<const collision::Object>> DraftLoader::load(const fs::path& file, const std::string& node,
                                                                     const geometry::SolidChoice& solid) {
  return inner_.load(place_of(file), node, solid);
}

Expected<void> DraftLoader::find_node(const fs::path& file, const std::string& node) {
  return inner_.find_node(place_of(file), node);
}

Expected<std::optional<scenario::Solid>> DraftLoader::solid(const fs::path& file, const std::string& node) {
  return inner_.solid(place_of(file), node);
}

Expected<std::string> DraftLoader::content_hash(const fs::path& file) {
  return inner_.content_hash(place_of(file));
}

}  // namespace mechane::studio
