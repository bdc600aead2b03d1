// From what the client library receives to what the renderer draws. Nothing moves here by itself: poses, levels, flow and time come
// from the frame.
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
  /// With a worker, which outlives this, trees grow on it.
  SceneBuilder(AssetLibrary& library, const std::string& language, Worker* worker = nullptr);

  /// Takes the manifest, and what is new in it from the library.
  void set_manifest(const std::vector<client::SceneObject>& objects);
  /// Takes what never changes of the world: from where one looks, what is seen beside the bodies. Null: nothing is known of it.
  void set_presentation(std::shared_ptr<const client::WorldPresentation> presentation);
  /// Trees grow on the worker.
  [[nodiscard]] bool growing() const { return coming_.valid(); }
  /// Gives the library the trees that have grown meanwhile.
  void take_grown();
  /// Of all words, from the next scene on.
  void set_language(const std::string& language);
  /// Whether hands have an arrow of the force that they feel, from the next scene on.
  void show_forces(bool shown) { forces_shown_ = shown; }
  /// The scene of a frame. `frame` may be null (nothing has come yet): then objects stand where the manifest has them.
  [[nodiscard]] picture::RenderScene build(const client::Frame* frame, const client::WorldStatus* status,
                                           client::LinkState link);
  /// Name of an object that the last scene left out because it lies kilometres away; empty: there was none.
  [[nodiscard]] const std::string& stray() const { return stray_; }
  /// A body of the last scene's frame that the manifest does not name: it is not drawn. While a manifest comes, or a world begins anew in
  /// mid-frame, there may be some for a moment.
  [[nodiscard]] std::optional<std::uint32_t> unknown() const { return unknown_; }

 private:
  struct Placed {
    client::SceneObject object;
    const ObjectModel* model = nullptr;
    std::optional<std::uint32_t> index{};           ///< of the manifest; scenery has none
    Vec3f flow_W = Vec3f::Zero();                   ///< of its water, m/s
    std::vector<picture::WaterInstance> reaches{};  ///< of a river, beyond what was modelled
  };
  void add_scenery(const std::vector<client::SceneObject>& objects);
  void find_place();
  void let_flow();
  void let_grow();
  [[nodiscard]] bool brings_landscape() const;
  /// Where a display stands: as the scenario says, or before what can be touched.
  [[nodiscard]] picture::Camera standpoint() const;
  [[nodiscard]] std::optional<picture::Inset> detail(const client::WorldStatus& status) const;
  [[nodiscard]] std::optional<std::uint32_t> first_unknown(const client::Frame& frame) const;
  [[nodiscard]] Pose pose_of(const Placed& placed, const client::Frame* frame) const;
  void add_object(const Placed& placed, const Pose& X_WB, const client::Frame* frame, picture::RenderScene& out) const;
  void add_name(const Placed& placed, const Pose& X_WB, picture::RenderScene& out) const;
  void add_what_moves(const client::Frame& frame, const client::WorldStatus* status, picture::RenderScene& out);

  AssetLibrary& library_;
  HandModel hand_;
  ForceArrow arrow_;
  bool forces_shown_ = false;
  visit::OverlayWriter writer_;
  std::string language_;
  std::set<std::uint32_t> named_;  ///< by the manifest
  std::string stray_;
  std::optional<std::uint32_t> unknown_;
  std::vector<Placed> objects_;  ///< of the manifest
  std::vector<Placed> scenery_;  ///< parts of the same files that no object names: SCENE, WATER_...
  Worker* worker_;
  std::vector<picture::Instance> landscape_;
  std::future<PlantMeshes> coming_;    ///< of the next landscape; not valid: there is none
  Eigen::AlignedBox3f grown_about_W_;  ///< empty: not yet
  picture::Camera camera_;
  Eigen::AlignedBox3f box_W_;
  Eigen::AlignedBox3f shadow_box_W_;
  Eigen::AlignedBox3f focus_box_W_;
  std::optional<float> ground_height_m_;
  std::optional<std::uint32_t> land_material_;
  std::shared_ptr<const client::WorldPresentation> presentation_;
  Eigen::AlignedBox3d interest_W_;       ///< what moves or fills, and a hand's breadth of air
  std::optional<float> water_height_m_;  ///< y in W where the risen surface was modelled
};

}  // namespace mechane::scene
