#include "client-sdk/scene/shown_world.hpp"

#include <filesystem>
#include <utility>

namespace mechane::scene {
namespace {

/// Another world may bring another manifest, even of the same scenario.
std::string key_of(const client::WorldStatus& status) {
  return status.world + " " + status.scenario + " " + status.scenario_hash;
}

/// How long to wait for models from a web server before the scene counts as complete without them.
constexpr std::chrono::seconds kAssetPatience{15};

}  // namespace

void ShownWorld::begin() {
  key_ = key_of(*status_);
  importer_ = std::make_unique<MeshImporter>(source_.store
                                                 ? assets::MeshFiles(source_.store, source_.catalogue)
                                                 : assets::MeshFiles(std::filesystem::path(folder_), source_.catalogue),
                                             source_.worker);
  library_ = std::make_unique<AssetLibrary>([this](const std::string& uri) { return importer_->take(uri); });
  builder_ = std::make_unique<SceneBuilder>(*library_, language_, source_.worker);
  builder_->show_forces(forces_shown_);
  builder_->show_hands(hand_look_);
  objects_.clear();
  unplaced_ = false;
  arrived_.clear();
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
    builder_->set_presentation(presentation_);  // may add rivers and trees
  }
  take_manifest(client.objects());
  // Checked before arrived files are taken, as more may arrive in between.
  const bool here = !source_.store || (!objects_.empty() && !source_.store->is_awaited(kAssetPatience));
  take_arrived();
  place();
  builder_->take_grown();
  news.whole = here && placed() && arrived_.empty() && !builder_->growing();
  news.assets = library_->size() != before;
  return news;
}

/// The manifest only grows, object by object as they arrive.
void ShownWorld::take_manifest(std::vector<client::SceneObject> objects) {
  if (objects.size() == objects_.size()) return;
  objects_ = std::move(objects);
  for (const client::SceneObject& object : objects_)
    importer_->want(object.mesh_uri, object.mesh_hash);
  unplaced_ = true;
}

/// Imports the files that have arrived from the web server.
void ShownWorld::take_arrived() {
  if (!source_.store || objects_.empty()) return;
  for (const std::string& uri : source_.store->take_arrived()) {
    importer_->want_again(uri);
    arrived_.insert(uri);
  }
}

/// Once no file is being read, adds objects to the scene and replaces placeholders by files that have arrived.
void ShownWorld::place() {
  if (importer_->busy()) return;
  bool any = std::exchange(unplaced_, false);
  for (const std::string& uri : std::exchange(arrived_, {}))
    any = library_->load_again(uri) || any;
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

void ShownWorld::show_hands(HandLook look) {
  hand_look_ = look;
  if (builder_) builder_->show_hands(look);
}

picture::RenderScene ShownWorld::build(const client::Frame* frame, client::LinkState link) const {
  picture::RenderScene scene;
  if (builder_) {
    scene = builder_->build(frame, status(), link);
    if (placed()) return scene;
    if (!scene.ground_height_m) scene.ground_height_m = 0.0F;
    if (scene.overlay.note.empty())
      scene.overlay.note = visit::link_note(client::LinkState::searching, false, language_);
    return scene;
  }
  scene.ground_height_m = 0.0F;
  scene.camera.p_WT = Vec3(0, 1.2, 0);
  scene.overlay.note = visit::link_note(link, false, language_);
  return scene;
}

}  // namespace mechane::scene
