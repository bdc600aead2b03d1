#include "client-sdk/display/scene_builder.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace mechane::display {
namespace {

constexpr const char* kBasin = "WATER_BASIN";
constexpr const char* kBarrel = "OUTER";
/// How fast water leaves the barrel's end, along its axis: a guess by eye, it only shapes the picture.
constexpr float kSpoutSpeed_m_per_s = 0.55F;
/// Scenery larger than this is a landscape about what is to be touched, not a machine's stand.
constexpr float kLandscape_m = 40;
/// How far about the eye's foreground things throw shadows: one map covers them, farther off nobody misses them.
constexpr float kShadowReach_m = 13;

/// The value of the first quantity whose name contains `word`, in SI; 0 when there is none.
double quantity(const client::Frame& frame, const client::WorldStatus& status, std::string_view word) {
  for (std::size_t i = 0; i < std::min(status.quantities.size(), frame.quantities.size()); ++i) {
    const client::QuantityInfo& info = status.quantities[i];
    if (info.name.find(word) == std::string::npos || !std::isfinite(frame.quantities[i])) continue;
    const double scale = info.unit == "l/s" ? 1e-3 : info.unit == "l/min" ? 1e-3 / 60 : info.unit == "l" ? 1e-3 : 1;
    return scale * frame.quantities[i];
  }
  return 0;
}

Eigen::Affine3f affine(const Pose& X) {
  Eigen::Affine3f out = Eigen::Affine3f::Identity();
  out.linear() = X.R.toRotationMatrix().cast<float>();
  out.translation() = X.p.cast<float>();
  return out;
}

/// The box, in W, around a box in B.
Eigen::AlignedBox3f moved(const Eigen::AlignedBox3f& box_B, const Pose& X_WB) {
  Eigen::AlignedBox3f box_W;
  if (box_B.isEmpty()) return box_W;
  const Eigen::Affine3f X = affine(X_WB);
  for (int corner = 0; corner < 8; ++corner) {
    box_W.extend(X * box_B.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)));
  }
  return box_W;
}

/// Stands before what is to be touched, at a grown person's height, and sees the land beyond over it.
Camera look_over(const Eigen::AlignedBox3d& interest_W) {
  Camera camera;
  camera.p_WC = Vec3(interest_W.center().x(), 1.6, interest_W.max().z() + 1.2);
  camera.p_WT = camera.p_WC + Vec3(0, -0.26, -1);
  camera.field_of_view_rad = 54 * kPi / 180;
  camera.least_horizontal_rad = 60 * kPi / 180;
  return camera;
}

}  // namespace

std::optional<Spout> find_spout(const content::ImportedScene& scene, const std::string& node, const Pose& X_WB) {
  const std::optional<std::uint32_t> top = content::find_node(scene, node);
  if (!top) return {};
  std::vector<Vec3f> points;
  for (std::uint32_t n = 0; n < scene.nodes.size(); ++n) {
    if (!content::is_under(scene, n, *top)) continue;
    const Eigen::Affine3f X_BN = content::pose_in(scene, n, top).cast<float>();
    for (const std::uint32_t m : scene.nodes[n].meshes) {
      for (const Vec3f& p : scene.meshes[m].positions)
        points.push_back(X_BN * p);
    }
  }
  float end = -1e9F;
  for (const Vec3f& p : points)
    end = std::max(end, p.z());
  // Of the rim, the inner edge: the lowest place that water still runs over.
  const Vec3f down_B = X_WB.R.conjugate().toRotationMatrix().cast<float>() * Vec3f(0, -1, 0);
  const Vec3f side_B = (down_B - Vec3f(0, 0, down_B.z())).normalized();
  float lowest = 0;
  float inner = 1e9F;
  for (const Vec3f& p : points) {
    if (p.z() < end - 0.005F) continue;
    const float r = std::hypot(p.x(), p.y());
    inner = std::min(inner, r);
    lowest = std::max(lowest, p.dot(side_B));
  }
  if (!(lowest > 0) || !side_B.allFinite()) return {};
  Spout spout;
  spout.p_BS = 0.94F * std::min(inner, lowest) * side_B + Vec3f(0, 0, end - 0.02F);
  return spout;
}

double stream_width_m(double flow_m3_per_s, double speed_m_per_s) {
  // Area of the ellipse: pi/4 * width * 0.45 width.
  return flow_m3_per_s > 0 ? std::sqrt(flow_m3_per_s / (speed_m_per_s * 0.45 * kPi / 4)) : 0;
}

SceneBuilder::SceneBuilder(AssetLibrary& library, const std::string& language)
    : library_(library), hand_(library), writer_(language), language_(language) {}

void SceneBuilder::set_manifest(const std::vector<client::SceneObject>& objects) {
  objects_.clear();
  spout_object_.reset();
  for (const client::SceneObject& object : objects) {
    if (object.mesh_uri.empty()) continue;
    objects_.push_back({object, &library_.model(object.mesh_uri, object.mesh_node), object.index});
    if (object.mesh_node != kBarrel) continue;
    const content::ImportedScene* file = library_.file(object.mesh_uri);
    if (file == nullptr) continue;
    if (const auto spout = find_spout(*file, kBarrel, object.X_WB)) {
      spout_ = *spout;
      spout_object_ = objects_.size() - 1;
    }
  }
  add_scenery(objects);
  find_place();
}

void SceneBuilder::add_scenery(const std::vector<client::SceneObject>& objects) {
  scenery_.clear();
  std::set<std::pair<std::string, std::string>> named;
  std::set<std::string> files;
  for (const client::SceneObject& object : objects) {
    if (object.mesh_uri.empty()) continue;
    named.insert({object.mesh_uri, object.mesh_node});
    files.insert(object.mesh_uri);
  }
  for (const std::string& uri : files) {
    const content::ImportedScene* file = library_.file(uri);
    if (file == nullptr || named.contains({uri, ""})) continue;
    for (const content::ImportedNode& node : file->nodes) {
      const bool scenery = node.name == "SCENE" || node.name.starts_with("WATER_");
      if (!scenery || named.contains({uri, node.name})) continue;
      client::SceneObject object;
      object.name = node.name;
      object.mesh_uri = uri;
      object.mesh_node = node.name;
      const Eigen::Affine3d X_FN = content::pose_in(*file, static_cast<std::uint32_t>(&node - file->nodes.data()), {});
      object.X_WB = {X_FN.translation(), Quat(X_FN.rotation())};
      scenery_.push_back({object, &library_.model(uri, node.name)});
    }
  }
}

void SceneBuilder::find_place() {
  Eigen::AlignedBox3d interest_W;
  box_W_.setEmpty();
  basin_W_.setEmpty();
  for (const auto* list : {&objects_, &scenery_}) {
    for (const Placed& placed : *list) {
      const Eigen::AlignedBox3f box_W = moved(placed.model->box_B, placed.object.X_WB);
      box_W_.extend(box_W);
      const bool basin = placed.object.mesh_node == kBasin;
      if (basin) basin_W_ = box_W;
      if (placed.object.movable || basin || placed.object.mesh_node == kBarrel) interest_W.extend(box_W.cast<double>());
    }
  }
  if (interest_W.isEmpty()) interest_W = box_W_.cast<double>();
  // A hand's breadth of air around what moves.
  interest_W.extend(interest_W.max() + Vec3(0, 0.10, 0.15));
  camera_ = frame_box(interest_W, Vec3(0.20, 0.27, 1.0), 40.0 * kPi / 180);
  shadow_box_W_ = box_W_;
  // The plain lies under the modelled ground, which is never quite level.
  if (!box_W_.isEmpty()) ground_height_m_ = scenery_.empty() ? std::min(box_W_.min().y(), 0.0F) : -0.06F;
  if (box_W_.isEmpty() || box_W_.sizes().maxCoeff() < kLandscape_m) return;
  camera_ = look_over(interest_W);
  ground_height_m_ = box_W_.min().y();  // under its rivers too
  const Vec3f middle = interest_W.center().cast<float>() - Vec3f(0, 0, 0.7F * kShadowReach_m);
  shadow_box_W_ =
      box_W_.intersection({middle - Vec3f::Constant(kShadowReach_m), middle + Vec3f::Constant(kShadowReach_m)});
}

RenderScene SceneBuilder::build(const client::Frame* frame, const client::WorldStatus* status, client::LinkState link) {
  RenderScene scene;
  scene.camera = camera_;
  scene.ground_height_m = ground_height_m_;
  scene.shadow_box_W = shadow_box_W_;
  const bool known = frame != nullptr && status != nullptr;
  const double level_m = known ? std::clamp(quantity(*frame, *status, "level"), 0.0, 5.0) : 0;
  for (const Placed& placed : objects_) {
    Pose X_WB = placed.object.X_WB;
    bool visible = true;
    if (frame != nullptr) {
      const auto body = std::ranges::find(frame->bodies, placed.object.index, &client::BodyPose::object);
      if (body != frame->bodies.end()) X_WB = body->X_WB;
      if (placed.object.index < frame->visible.size()) visible = frame->visible[placed.object.index] != 0;
    }
    if (visible) add_object(placed, X_WB, level_m, scene);
  }
  for (const Placed& placed : scenery_)
    add_object(placed, placed.object.X_WB, level_m, scene);
  if (frame != nullptr) {
    scene.time_s = static_cast<double>(frame->tick % 3'600'000) * kTickSeconds;
    for (const client::HandPose& hand : frame->hands)
      hand_.draw(hand, scene);
  }
  if (known) add_stream(*frame, *status, level_m, scene);
  if (!basin_W_.isEmpty() && (level_m > 0.002 || !scene.streams.empty())) scene.inset = basin_inset();
  if (status != nullptr) scene.overlay = writer_.write(*status, frame);
  scene.overlay.note = link_note(link, status != nullptr, language_);
  return scene;
}

Inset SceneBuilder::basin_inset() const {
  Inset inset;
  inset.caption = language_ == "el" ? "Η δεξαμενή" : "The basin";
  const Vec3 middle = basin_W_.center().cast<double>();
  const double side = basin_W_.sizes().cast<double>().maxCoeff();
  inset.camera.p_WT = middle + Vec3(0, 0.30 * side, 0);
  inset.camera.p_WC = middle + side * Vec3(0.45, 2.5, 1.9);
  inset.camera.field_of_view_rad = 30 * kPi / 180;
  return inset;
}

void SceneBuilder::add_object(const Placed& placed, const Pose& X_WB, double level_m, RenderScene& out) const {
  Eigen::Affine3f X = affine(X_WB);
  const bool basin = placed.object.mesh_node == kBasin;
  if (basin) X.translation().y() += static_cast<float>(level_m);
  for (const ModelPart& part : placed.model->parts) {
    if (part.water) {
      // An empty basin shows its floor.
      if (basin && level_m < 0.002) continue;
      out.waters.push_back({part.mesh, X, basin ? 0.55F : 0.12F, basin ? 0.6F : 1.0F});
    } else {
      out.instances.push_back({part.mesh, part.material, X, true, placed.index});
    }
  }
}

void SceneBuilder::add_stream(const client::Frame& frame, const client::WorldStatus& status, double level_m,
                              RenderScene& out) const {
  if (!spout_object_) return;
  const Placed& barrel = objects_[*spout_object_];
  Pose X_WB = barrel.object.X_WB;
  const auto body = std::ranges::find(frame.bodies, barrel.object.index, &client::BodyPose::object);
  if (body != frame.bodies.end()) X_WB = body->X_WB;
  const double width = stream_width_m(quantity(frame, status, "flow"), kSpoutSpeed_m_per_s);
  // Under a drop's width nothing is seen.
  if (width < 0.004) return;
  WaterStream stream;
  stream.p_WS = affine(X_WB) * spout_.p_BS;
  const Vec3f axis_W = X_WB.R.toRotationMatrix().cast<float>() * spout_.axis_B;
  stream.v_W = kSpoutSpeed_m_per_s * Vec3f(axis_W.x(), 0.15F * axis_W.y(), axis_W.z());
  stream.landing_height_m = (basin_W_.isEmpty() ? 0.0F : basin_W_.min().y()) + static_cast<float>(level_m);
  stream.width_m = std::min(static_cast<float>(width), 0.25F);
  out.streams.push_back(stream);
}

}  // namespace mechane::display
