// From what the client library receives to what the renderer draws. Nothing moves here by itself: poses, levels, flow and time come
// from the frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client-sdk/display/asset_library.hpp"
#include "client-sdk/display/hand_model.hpp"
#include "client-sdk/display/overlay_text.hpp"
#include "client-sdk/display/render_scene.hpp"
#include <mechane/client/client.hpp>

namespace mechane::display {

/// Where water leaves a screw or a pipe: the lowest point of the rim of its upper end.
struct Spout {
  Vec3f p_BS = Vec3f::Zero();     ///< in the object's frame
  Vec3f axis_B = Vec3f::UnitZ();  ///< out of the opening, unit
};

/// The rim at the +z end of an object that has the pose X_WB. None when the object has no height along z.
[[nodiscard]] std::optional<Spout> find_spout(const content::ImportedScene& scene, const std::string& node,
                                              const Pose& X_WB);

/// The width of a stream that carries `flow_m3_per_s` away at `speed_m_per_s`; its section is an ellipse a little flatter than half as
/// thick as wide.
[[nodiscard]] double stream_width_m(double flow_m3_per_s, double speed_m_per_s);

class SceneBuilder {
 public:
  SceneBuilder(AssetLibrary& library, const std::string& language);

  /// Takes the manifest; loads what is new in it. Slow (files).
  void set_manifest(const std::vector<client::SceneObject>& objects);
  /// The scene of a frame. `frame` may be null (nothing has come yet): then objects stand where the manifest has them.
  [[nodiscard]] RenderScene build(const client::Frame* frame, const client::WorldStatus* status,
                                  client::LinkState link);

 private:
  struct Placed {
    client::SceneObject object;
    const ObjectModel* model = nullptr;
    std::optional<std::uint32_t> index{};  ///< of the manifest; scenery has none
  };
  void add_scenery(const std::vector<client::SceneObject>& objects);
  void find_place();
  /// A close-up of the basin, once there is water.
  [[nodiscard]] Inset basin_inset() const;
  void add_object(const Placed& placed, const Pose& X_WB, double level_m, RenderScene& out) const;
  void add_stream(const client::Frame& frame, const client::WorldStatus& status, double level_m,
                  RenderScene& out) const;

  AssetLibrary& library_;
  HandModel hand_;
  OverlayWriter writer_;
  std::string language_;
  std::vector<Placed> objects_;  ///< of the manifest
  std::vector<Placed> scenery_;  ///< parts of the same files that no object names: SCENE, WATER_...
  Camera camera_;
  Eigen::AlignedBox3f box_W_;
  Eigen::AlignedBox3f shadow_box_W_;
  std::optional<float> ground_height_m_;
  std::optional<std::size_t> spout_object_;
  Spout spout_;
  Eigen::AlignedBox3f basin_W_;  ///< the water's surface when the basin is empty
};

}  // namespace mechane::display
