// From what the client library receives to what the renderer draws. Poses, levels, flow and time all come from the
// frame.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/scene/asset_library.hpp"
#include "client-sdk/scene/force_arrow.hpp"
#include "client-sdk/scene/hand_model.hpp"
#include "client-sdk/scene/landscape.hpp"
#include "client-sdk/visit/overlay_text.hpp"
#include "server/base/worker.hpp"
#include <mechane/client/client.hpp>

namespace mechane::scene {

class SceneBuilder {
 public:
  /// Trees are made on the worker, which must outlive this; without one, on the calling thread.
  SceneBuilder(AssetLibrary& library, const std::string& language, Worker* worker = nullptr);

  /// Takes the manifest, and its models from the library.
  void set_manifest(const std::vector<client::SceneObject>& objects);
  /// Takes the presentation: views and effects. Null: not known.
  void set_presentation(std::shared_ptr<const client::WorldPresentation> presentation);
  /// Whether trees are being made on the worker.
  [[nodiscard]] bool growing() const { return coming_.valid(); }
  /// Adds finished trees to the library.
  void take_grown();
  /// Language of all words, from the next scene on.
  void set_language(const std::string& language);
  /// Whether hands have an arrow of their force, from the next scene on.
  void show_forces(bool shown) { forces_shown_ = shown; }
  /// How hands look, from the next scene on.
  void show_hands(HandLook look) { hand_.wear(look); }
  /// The scene of a frame. `frame` is null before the first one: then objects stand where the manifest has them.
  [[nodiscard]] picture::RenderScene build(const client::Frame* frame, const client::WorldStatus* status,
                                           client::LinkState link);
  /// Name of an object that the last scene left out because it is kilometres away; empty: none.
  [[nodiscard]] const std::string& stray() const { return stray_; }
  /// A body of the last scene's frame that the manifest does not contain: it is not drawn. This is normal for a moment,
  /// while a manifest arrives or a world restarts.
  [[nodiscard]] std::optional<std::uint32_t> unknown() const { return unknown_; }

 private:
  struct Placed {
    client::SceneObject object;
    const ObjectModel* model = nullptr;
    std::optional<std::uint32_t> index{};           ///< of the manifest; scenery has none
    Vec3f flow_W = Vec3f::Zero();                   ///< of its water, m/s
    std::vector<picture::WaterInstance> reaches{};  ///< a river's continuations beyond its modelled piece
  };
  void add_scenery(const std::vector<client::SceneObject>& objects);
  void find_place();
  void let_flow();
  void let_grow();
  [[nodiscard]] bool brings_landscape() const;
  /// The usual camera: the scenario's first view, or one in front of the touchable things.
  [[nodiscard]] picture::Camera standpoint() const;
  [[nodiscard]] std::optional<picture::Inset> detail(const client::WorldStatus& status) const;
  [[nodiscard]] std::optional<std::uint32_t> first_unknown(const client::Frame& frame) const;
  [[nodiscard]] Pose pose_of(const Placed& placed, const client::Frame* frame) const;
  void add_object(const Placed& placed, const Pose& X_WB, const client::Frame* frame, picture::RenderScene& out) const;
  void add_name(const Placed& placed, const Pose& X_WB, picture::RenderScene& out) const;
  void add_what_moves(const client::Frame& frame, const client::WorldStatus* status, picture::RenderScene& out);
  void add_hands(const client::Frame& frame, const client::WorldStatus* status, picture::RenderScene& out) const;

  AssetLibrary& library_;
  HandModel hand_;
  ForceArrow arrow_;
  bool forces_shown_ = false;
  visit::OverlayWriter writer_;
  std::string language_;
  std::set<std::uint32_t> named_;  ///< objects of the manifest
  std::string stray_;
  std::optional<std::uint32_t> unknown_;
  std::vector<Placed> objects_;  ///< of the manifest
  std::vector<Placed> scenery_;  ///< nodes of the same files that belong to no object: SCENE, WATER_...
  Worker* worker_;
  std::vector<picture::Instance> landscape_;
  std::future<PlantMeshes> coming_;    ///< of the next landscape; not valid: none
  Eigen::AlignedBox3f grown_about_W_;  ///< the scenery around which trees grow; empty: no trees yet
  picture::Camera camera_;
  Eigen::AlignedBox3f box_W_;
  Eigen::AlignedBox3f shadow_box_W_;
  Eigen::AlignedBox3f focus_box_W_;
  std::optional<float> ground_height_m_;
  std::optional<std::uint32_t> land_material_;
  std::shared_ptr<const client::WorldPresentation> presentation_;
  Eigen::AlignedBox3d interest_W_;       ///< contains what moves or fills, and some air
  std::optional<float> water_height_m_;  ///< y in W at which the rising water surface was modelled
};

}  // namespace mechane::scene
