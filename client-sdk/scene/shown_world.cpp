#include "client-sdk/scene/shown_world.hpp"

#include <filesystem>

#include "server/content/mesh_import.hpp"

namespace mechane::scene {
namespace {

/// Another world may bring another manifest, even of the same scenario.
std::string key_of(const client::WorldStatus& status) {
  return status.world + " " + status.scenario + " " + status.scenario_hash;
}

/// So long a model from a server is waited for: from a server that does not answer, the first picture only waits.
constexpr std::chrono::seconds kAssetPatience{15};

}  // namespace

void ShownWorld::begin() {
  key_ = key_of(*status_);
  files_ = source_.store ? std::make_unique<assets::MeshFiles>(source_.store.get(), source_.catalogue)
                         : std::make_unique<assets::MeshFiles>(std::filesystem::path(folder_), source_.catalogue);
  library_ = std::make_unique<AssetLibrary>([this](const std::string& uri) -> Expected<content::ImportedScene> {
    const auto file = files_->find(uri);
    if (!file) return tl::unexpected(file.error());
    return content::import_mesh(*file);
  });
  builder_ = std::make_unique<SceneBuilder>(*library_, language_);
  builder_->show_forces(forces_shown_);
  objects_.clear();
  presentation_.reset();
}

ShownWorld::News ShownWorld::hear(const client::Client& client) {
  News news;
  if (auto status = client.world_status()) {
    status_ = std::move(status);
    folder_ = source_.folder.empty() ? status_->scenario_folder : source_.folder;
    news.another_world = !known() || key_of(*status_) != key_;
    if (news.another_world) begin();
  }
  if (!known()) return news;
  const std::size_t before = news.another_world ? 0 : library_->size();
  if (auto presentation = client.presentation(); presentation != presentation_) {
    presentation_ = std::move(presentation);
    builder_->set_presentation(presentation_);  // it may let rivers go on, and trees grow
  }
  take_manifest(client.objects());
  // Asked before what came is taken, lest something comes in between.
  news.whole = !source_.store || (!objects_.empty() && !source_.store->is_awaited(kAssetPatience));
  take_arrived();
  news.assets = library_->size() != before;
  return news;
}

/// It only grows, object by object as they arrive.
void ShownWorld::take_manifest(std::vector<client::SceneObject> objects) {
  if (objects.size() == objects_.size()) return;
  objects_ = std::move(objects);
  for (const client::SceneObject& object : objects_)
    files_->expect(object.mesh_uri, object.mesh_hash);
  builder_->set_manifest(objects_);
}

/// Files that came from the server of assets take their placeholders' place.
void ShownWorld::take_arrived() {
  if (!source_.store || objects_.empty()) return;
  bool any = false;
  for (const std::string& name : source_.store->take_arrived())
    any = library_->load_again(name) || any;
  if (any) builder_->set_manifest(objects_);
}

void ShownWorld::set_language(const std::string& language) {
  language_ = language;
  if (builder_) builder_->set_language(language);
}

void ShownWorld::show_forces(bool shown) {
  forces_shown_ = shown;
  if (builder_) builder_->show_forces(shown);
}

picture::RenderScene ShownWorld::build(const client::Frame* frame, client::LinkState link) const {
  if (builder_) return builder_->build(frame, status(), link);
  picture::RenderScene scene;
  scene.ground_height_m = 0.0F;
  scene.camera.p_WT = Vec3(0, 1.2, 0);
  scene.overlay.note = visit::link_note(link, false, language_);
  return scene;
}

}  // namespace mechane::scene
