#include "client-sdk/display/attract_loop.hpp"

#include "client-sdk/display/overlay_text.hpp"
#include "server/content/mesh_import.hpp"
#include "server/log/log.hpp"

namespace mechane::display {
namespace {

constexpr const char* kInviteEnglish = "Touch to begin";
constexpr const char* kInviteGreek = "Αγγίξτε για να ξεκινήσετε";

PlaySettings over_and_over() {
  PlaySettings settings;
  settings.again = true;
  return settings;
}

/// Calm: no step, no gauge, no question of somebody else's visit.
OverlayContent invitation(const client::WorldStatus* status, const std::string& language, const OverlayStyle& style) {
  OverlayContent content;
  const bool greek = language == "el";
  if (status != nullptr) content.title = text_in(status->title, language);
  content.caption = greek ? kInviteGreek : kInviteEnglish;
  content.hint = greek ? kInviteEnglish : kInviteGreek;
  content.style = style;
  return content;
}

}  // namespace

Expected<std::unique_ptr<AttractLoop>> AttractLoop::open(const std::string& file, AttractAssets assets) {
  auto recording = FrameRecording::open_file(file);
  if (!recording) return tl::unexpected(recording.error());
  if (recording->cut_off()) log::warning("the recording " + file + " was cut off; what there is, is shown");
  return std::unique_ptr<AttractLoop>(new AttractLoop(std::move(*recording), std::move(assets)));
}

AttractLoop::AttractLoop(FrameRecording recording, AttractAssets assets)
    : assets_(std::move(assets)), recorded_(std::move(recording), over_and_over()) {
  begin_world({});
}

void AttractLoop::begin_world(const client::WorldStatus& status) {
  world_ = status.world + " " + status.scenario;
  mesh_files_ = assets_.store
                    ? std::make_unique<MeshFiles>(assets_.store.get(), assets_.catalogue)
                    : std::make_unique<MeshFiles>(
                          std::filesystem::path(assets_.folder.empty() ? status.scenario_folder : assets_.folder),
                          assets_.catalogue);
  library_ = std::make_unique<AssetLibrary>([this](const std::string& uri) -> Expected<content::ImportedScene> {
    const auto file = mesh_files_->find(uri);
    if (!file) return tl::unexpected(file.error());
    return content::import_mesh(*file);
  });
  builder_ = std::make_unique<SceneBuilder>(*library_, "en");
  presentation_.reset();
  objects_.clear();
}

bool AttractLoop::advance(TimePoint now) {
  recorded_.advance(now);
  const auto status = recorded_.world_status();
  if (!status) return false;
  bool anew = false;
  if (status->world + " " + status->scenario != world_) {
    begin_world(*status);
    anew = true;
  }
  if (auto presentation = recorded_.presentation(); presentation != presentation_) {
    presentation_ = std::move(presentation);
    builder_->set_presentation(presentation_);
  }
  if (std::vector<client::SceneObject> objects = recorded_.objects(); objects.size() != objects_.size()) {
    objects_ = std::move(objects);
    for (const client::SceneObject& object : objects_)
      mesh_files_->expect(object.mesh_uri, object.mesh_hash);
    builder_->set_manifest(objects_);
    anew = true;
  }
  if (assets_.store) {
    bool came = false;
    for (const std::string& name : assets_.store->take_arrived())
      came = library_->load_again(name) || came;
    if (came) builder_->set_manifest(objects_);
    anew = anew || came;
  }
  return anew;
}

RenderScene AttractLoop::build(TimePoint now, const std::string& language, const OverlayStyle& style) {
  client::Frame frame;
  const bool any = recorded_.interpolated_frame(now, Duration{0}, frame);
  for (client::HandPose& hand : frame.hands)
    hand.force_W = Vec3::Zero();
  const auto status = recorded_.world_status();
  RenderScene scene = builder_->build(any ? &frame : nullptr, status ? &*status : nullptr, client::LinkState::joined);
  scene.overlay = invitation(status ? &*status : nullptr, language, style);
  scene.inset.reset();
  return scene;
}

}  // namespace mechane::display
