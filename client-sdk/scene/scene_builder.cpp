#include "client-sdk/scene/scene_builder.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "client-sdk/picture/box_corners.hpp"
#include "client-sdk/scene/effect_builder.hpp"
#include "client-sdk/scene/river_reach.hpp"
#include "client-sdk/scene/thing_names.hpp"
#include "client-sdk/scene/workplace.hpp"

namespace mechane::scene {
namespace {

/// Shallower water is not drawn: the floor shows.
constexpr double kLeastLevel_m = 0.002;
/// Scenery larger than this is a landscape of its own, not just the stand of a machine.
constexpr float kLandscape_m = 40;
/// How far around the touchable things shadows are cast; farther away, haze and distance hide them.
constexpr float kShadowReach_m = 70;
/// The clearing's margin around the scenery, and its least radius: nothing grows where people stand and stones fly.
constexpr float kClearing_m = 13;
constexpr float kLeastClearing_m = 20;
/// In a larger clearing, trees would be too far away to be seen.
constexpr float kMostClearing_m = 120;
/// The touchable things have the sharpest shadows, within this distance of their middle.
constexpr float kSharpReach_m = 2.5F;
/// A thing farther away than any place is large has left its world, or was never in it: it is not drawn and does not
/// count in any box.
constexpr double kStray_m = 10'000;

/// From the middle of a finger's segment to what is still of the hand.
constexpr double kFinger_m = 0.015;

bool is_stray(const Vec3& p_W) {
  return !(p_W.array().abs() <= kStray_m).all();  // true for NaN, too
}

bool is_stray(const client::HandPose& hand) {
  return std::ranges::any_of(hand.X_WS, [](const Pose& X_WS) { return is_stray(X_WS.p); });
}

Eigen::Affine3f affine(const Pose& X) {
  Eigen::Affine3f out = Eigen::Affine3f::Identity();
  out.linear() = X.R.toRotationMatrix().cast<float>();
  out.translation() = X.p.cast<float>();
  return out;
}

/// Deep and dark, standing or flowing.
picture::WaterInstance river_water(const Vec3f& flow_W) {
  picture::WaterInstance water;
  water.clearness = 0.12F;
  water.flow_W = flow_W;
  return water;
}

bool is_earth(const ModelPart& part, const picture::SceneAssets& assets) {
  return !part.water && assets.materials[part.material].land;
}

bool has_earth(const ObjectModel& model, const picture::SceneAssets& assets) {
  return std::ranges::any_of(model.parts, [&](const ModelPart& part) { return is_earth(part, assets); });
}

/// A camera in front of the touchable things, at an adult's height, that sees the land beyond them.
picture::Camera look_over(const Eigen::AlignedBox3d& interest_W) {
  picture::Camera camera;
  camera.p_WC = Vec3(interest_W.center().x(), 1.6, interest_W.max().z() + 1.2);
  camera.p_WT = camera.p_WC + Vec3(0, -0.26, -1);
  camera.nearest_m = picture::nearest_of(interest_W, camera);
  camera.field_of_view_rad = 54 * kPi / 180;
  camera.least_horizontal_rad = 60 * kPi / 180;
  return camera;
}

/// A camera at the scenario's view. The middle of the touchable things lies in the plane of a stereo screen.
picture::Camera camera_at(const client::View& view, const Eigen::AlignedBox3d& interest_W) {
  picture::Camera camera;
  camera.p_WC = view.X_WV.p;
  const Vec3 ahead_W = view.X_WV.rotate(-Vec3::UnitZ());
  const double distance = interest_W.isEmpty() ? 1.5 : ahead_W.dot(interest_W.center() - camera.p_WC);
  camera.p_WT = camera.p_WC + std::clamp(distance, 0.5, 5.0) * ahead_W;
  camera.nearest_m = picture::nearest_of(interest_W, camera);
  camera.up_W = view.X_WV.rotate(Vec3::UnitY());
  camera.field_of_view_rad = view.field_of_view_rad;
  camera.least_horizontal_rad = view.field_of_view_rad;
  return camera;
}

/// Widens the view downwards by the caption's height, so that all it showed is visible above the caption.
picture::Camera above_caption(picture::Camera camera) {
  constexpr double kCaption = 0.12;  // of the picture's height
  const double half = std::tan(camera.field_of_view_rad / 2);
  const double wider = half / (1 - kCaption);
  camera.field_of_view_rad = 2 * std::atan(wider);
  const Vec3 ahead_W = camera.p_WT - camera.p_WC;
  const Vec3 up_W = (camera.up_W - camera.up_W.dot(ahead_W) / ahead_W.squaredNorm() * ahead_W).normalized();
  camera.p_WT -= ahead_W.norm() * (wider - half) * up_W;
  return camera;
}

}  // namespace

SceneBuilder::SceneBuilder(AssetLibrary& library, const std::string& language, Worker* worker)
    : library_(library), hand_(library), arrow_(library), writer_(language), language_(language), worker_(worker) {}

void SceneBuilder::set_manifest(const std::vector<client::SceneObject>& objects) {
  objects_.clear();
  named_.clear();
  for (const client::SceneObject& object : objects) {
    named_.insert(object.index);
    if (object.mesh_uri.empty()) continue;
    objects_.push_back({object, &library_.model(object.mesh_uri, object.mesh_node), object.index});
  }
  add_scenery(objects);
  find_place();
  let_flow();
  let_grow();
}

void SceneBuilder::add_scenery(const std::vector<client::SceneObject>& objects) {
  const std::vector<Placed> before = std::exchange(scenery_, {});
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
      const auto same = std::ranges::find_if(before, [&](const Placed& placed) {
        return placed.object.mesh_uri == uri && placed.object.mesh_node == node.name;
      });
      if (same != before.end() && !same->model->missing) scenery_.back().reaches = same->reaches;
    }
  }
}

void SceneBuilder::set_language(const std::string& language) {
  language_ = language;
  writer_.set_language(language);
}

void SceneBuilder::set_presentation(std::shared_ptr<const client::WorldPresentation> presentation) {
  presentation_ = std::move(presentation);
  find_place();
  let_flow();
  let_grow();
}

/// Continues rivers beyond their modelled pieces, in both directions over the plain.
void SceneBuilder::let_flow() {
  for (Placed& placed : scenery_) {
    placed.flow_W =
        presentation_ ? flow_of(*presentation_, placed.object.mesh_node).cast<float>() : Vec3f(Vec3f::Zero());
    if (placed.flow_W.isZero() || !placed.reaches.empty() || is_stray(placed.object.X_WB.p)) continue;
    for (const ModelPart& part : placed.model->parts) {
      if (!part.water) continue;
      for (const float sign : {-1.0F, 1.0F}) {
        RiverReach reach =
            river_reach(library_.assets().meshes[part.mesh], affine(placed.object.X_WB), sign * placed.flow_W);
        if (reach.mesh_W.indices.empty()) continue;
        picture::WaterInstance& water = placed.reaches.emplace_back(river_water(placed.flow_W));
        water.width_m = reach.width_m;
        water.mesh = library_.add_mesh(std::move(reach.mesh_W));
      }
    }
  }
}

bool SceneBuilder::brings_landscape() const {
  return !box_W_.isEmpty() && box_W_.sizes().maxCoeff() >= kLandscape_m;
}

/// Grows trees around scenery that stands on earth. They depend on scenery and viewpoint only, since bodies arrive one
/// by one and move.
void SceneBuilder::let_grow() {
  if (presentation_ == nullptr || !ground_height_m_) return;
  Eigen::AlignedBox3f scenery_W;
  bool earth = false;
  LandscapePlan plan;
  for (const Placed& placed : scenery_) {
    if (is_stray(placed.object.X_WB.p)) continue;
    scenery_W.extend(picture::moved(placed.model->box_B, affine(placed.object.X_WB)));
    earth = earth || has_earth(*placed.model, library_.assets());
    for (const picture::WaterInstance& reach : placed.reaches)
      add_water(library_.assets().meshes[reach.mesh], reach.X_WM, plan);
  }
  if (!earth) return;
  if (!presentation_->views.empty()) scenery_W.extend(Vec3f(camera_.p_WC.cast<float>()));
  if (grown_about_W_.isApprox(scenery_W)) return;  // meshes in the library are never removed, so do not add them twice
  grown_about_W_ = scenery_W;
  const Vec3f sizes = scenery_W.sizes();
  plan.middle_W = scenery_W.center();
  plan.middle_W.y() = *ground_height_m_;
  plan.clearing_m = std::max(std::hypot(sizes.x(), sizes.z()) / 2 + kClearing_m, kLeastClearing_m);
  plan.to_sun_W = picture::Sun{}.to_sun_W;
  plan.seed = static_cast<std::uint32_t>(100 * sizes.norm());
  if (plan.clearing_m >= kMostClearing_m) {
    landscape_.clear();
    coming_ = {};
  } else if (worker_ == nullptr) {
    landscape_ = add_plants(grow(plan, plants_of(plan)), library_);
  } else {
    coming_ = worker_->ask([plan = std::move(plan)] { return grow(plan, plants_of(plan)); });
  }
}

void SceneBuilder::take_grown() {
  if (is_ready(coming_)) landscape_ = add_plants(coming_.get(), library_);
}

void SceneBuilder::find_place() {
  box_W_.setEmpty();
  interest_W_.setEmpty();
  water_height_m_.reset();
  land_material_.reset();
  for (const auto* list : {&objects_, &scenery_}) {
    for (const Placed& placed : *list) {
      if (is_stray(placed.object.X_WB.p)) continue;
      const Eigen::AlignedBox3f box_W = picture::moved(placed.model->box_B, affine(placed.object.X_WB));
      box_W_.extend(box_W);
      for (const ModelPart& part : placed.model->parts) {
        if (is_earth(part, library_.assets())) land_material_ = part.material;
      }
      const bool rises = presentation_ && std::ranges::any_of(presentation_->effects, [&](const client::Effect& e) {
                           return e.kind == "level" && e.node == placed.object.mesh_node;
                         });
      if (rises) water_height_m_ = box_W.min().y();
      if (placed.object.movable || rises) interest_W_.extend(box_W.cast<double>());
    }
  }
  if (interest_W_.isEmpty()) interest_W_ = box_W_.cast<double>();
  // Some air above and in front of what moves.
  if (!interest_W_.isEmpty()) interest_W_.extend(interest_W_.max() + Vec3(0, 0.10, 0.15));
  shadow_box_W_ = box_W_;
  const Vec3f touched = interest_W_.isEmpty() ? Vec3f(Vec3f::Zero()) : Vec3f(interest_W_.center().cast<float>());
  const Vec3f sharp = Vec3f::Constant(kSharpReach_m);
  focus_box_W_ = interest_W_.cast<float>().intersection({touched - sharp, touched + sharp});
  // The plain lies under the modelled ground, which is never quite level.
  if (!box_W_.isEmpty()) ground_height_m_ = scenery_.empty() ? std::min(box_W_.min().y(), 0.0F) : -0.06F;
  // A file without scenery and activities is not an exhibit: nothing says where its ground is, and things may fall or hang below 0.
  if (scenery_.empty() && presentation_ != nullptr && presentation_->activities.empty()) ground_height_m_.reset();
  camera_ = standpoint();
  if (!brings_landscape()) return;
  ground_height_m_ = box_W_.min().y();  // below its rivers, too
  const Vec3f reach = Vec3f::Constant(kShadowReach_m);
  shadow_box_W_ = box_W_.intersection({touched - reach, touched + reach});
}

picture::Camera SceneBuilder::standpoint() const {
  if (presentation_ && !presentation_->views.empty() && !is_stray(presentation_->views.front().X_WV.p))
    return above_caption(camera_at(presentation_->views.front(), interest_W_));
  return brings_landscape() ? look_over(interest_W_)
                            : picture::frame_box(interest_W_, Vec3(0.20, 0.27, 1.0), 40.0 * kPi / 180);
}

Pose SceneBuilder::pose_of(const Placed& placed, const client::Frame* frame) const {
  if (frame == nullptr) return placed.object.X_WB;
  // A frame's bodies are sorted by object.
  const auto body = std::ranges::lower_bound(frame->bodies, placed.index.value_or(0), {}, &client::BodyPose::object);
  const bool moves = placed.index && body != frame->bodies.end() && body->object == *placed.index;
  return moves ? body->X_WB : placed.object.X_WB;
}

std::optional<std::uint32_t> SceneBuilder::first_unknown(const client::Frame& frame) const {
  const auto body =
      std::ranges::find_if(frame.bodies, [this](const client::BodyPose& b) { return !named_.contains(b.object); });
  return body == frame.bodies.end() ? std::nullopt : std::optional(body->object);
}

picture::RenderScene SceneBuilder::build(const client::Frame* frame, const client::WorldStatus* status,
                                         client::LinkState link) {
  picture::RenderScene scene;
  stray_.clear();
  unknown_ = frame == nullptr ? std::nullopt : first_unknown(*frame);
  scene.camera = camera_;
  scene.ground_height_m = ground_height_m_;
  scene.shadow_box_W = shadow_box_W_;
  scene.focus_box_W = focus_box_W_;
  scene.land_material = land_material_;
  for (const Placed& placed : objects_) {
    const bool told = frame != nullptr && placed.object.index < frame->visible.size();
    if (told && frame->visible[placed.object.index] == 0) continue;
    const Pose X_WB = pose_of(placed, frame);
    if (is_stray(X_WB.p)) {
      if (stray_.empty()) stray_ = placed.object.name;
    } else {
      add_object(placed, X_WB, frame, scene);
      add_name(placed, X_WB, scene);
    }
  }
  for (const Placed& placed : scenery_)
    add_object(placed, placed.object.X_WB, frame, scene);
  if (!brings_landscape()) scene.instances.insert(scene.instances.end(), landscape_.begin(), landscape_.end());
  if (frame != nullptr) add_what_moves(*frame, status, scene);
  if (status != nullptr) {
    scene.inset = detail(*status);
    scene.overlay = writer_.write(*status, frame);
  }
  scene.overlay.note = visit::link_note(link, status != nullptr, language_);
  return scene;
}

void SceneBuilder::add_name(const Placed& placed, const Pose& X_WB, picture::RenderScene& out) const {
  std::string name = visit::text_in(placed.object.title, language_);
  if (name.empty() || placed.model->box_B.isEmpty()) return;
  out.named.push_back({placed.object.index, std::move(name), affine(X_WB), placed.model->box_B});
}

void SceneBuilder::add_what_moves(const client::Frame& frame, const client::WorldStatus* status,
                                  picture::RenderScene& out) {
  out.time_s = static_cast<double>(frame.tick % 3'600'000) * kTickSeconds;
  add_hands(frame, status, out);
  for (const client::RopeShape& rope : frame.ropes) {
    if (std::ranges::any_of(rope.points_W, [](const Vec3& p_W) { return is_stray(p_W); })) continue;
    picture::RenderRope& drawn = out.ropes.emplace_back();
    drawn.radius_m = static_cast<float>(rope.diameter_m / 2);
    // From the tied end: the twist of the strands starts there, and does not move while a drum winds up the other end.
    for (auto p_W = rope.points_W.rbegin(); p_W != rope.points_W.rend(); ++p_W)
      drawn.points_W.push_back(p_W->cast<float>());
  }
  if (presentation_ == nullptr || status == nullptr) return;
  float landing_height_m = ground_height_m_.value_or(0);
  for (const client::Effect& effect : presentation_->effects) {
    if (effect.kind == "level" && water_height_m_)
      landing_height_m =
          *water_height_m_ + static_cast<float>(level_of(*presentation_, frame, effect.node).value_or(0));
  }
  const auto pose = [&](std::uint32_t object) {
    const auto placed = std::ranges::find(objects_, std::optional(object), &Placed::index);
    return placed == objects_.end() ? Pose{} : pose_of(*placed, &frame);
  };
  add_effects(*presentation_, frame, *status, pose, landing_height_m, out);
  std::erase_if(out.streams, [](const picture::WaterStream& stream) {
    return is_stray(stream.p_WS.cast<double>()) || !stream.v_W.allFinite() || !std::isfinite(stream.width_m);
  });
  std::erase_if(out.effects, [](const picture::ParticleEffect& effect) { return is_stray(effect.p_W.cast<double>()); });
}

void SceneBuilder::add_hands(const client::Frame& frame, const client::WorldStatus* status,
                             picture::RenderScene& out) const {
  std::vector<WorkingHand> hands;
  for (const client::HandPose& hand : frame.hands) {
    if (is_stray(hand)) continue;
    const std::size_t before = out.occluders.size();
    hand_.draw(hand, camera_, out);
    if (forces_shown_) arrow_.draw(hand, camera_, out);
    if (hand.stale) continue;
    WorkingHand& working = hands.emplace_back();
    working.holding = hand.holding;
    picture::SeenThing& seen = out.seen.emplace_back();
    seen.around_m = static_cast<float>(kFinger_m);
    for (const picture::Occluder& segment : std::span(out.occluders).subspan(before)) {
      seen.points_W.push_back(segment.p_WO);
      const Vec3 p_W = segment.p_WO.cast<double>();
      working.box_W.extend(Eigen::AlignedBox3d(p_W - Vec3::Constant(kFinger_m), p_W + Vec3::Constant(kFinger_m)));
    }
  }
  out.near_hand = named_near(out.named, frame.hands);
  if (presentation_ == nullptr || status == nullptr || status->done) return;
  const auto standing = [&](std::uint32_t object) {
    const auto placed = std::ranges::find(objects_, std::optional(object), &Placed::index);
    if (placed == objects_.end()) return StandingObject{};
    return StandingObject{pose_of(*placed, &frame), placed->model->box_B.cast<double>()};
  };
  out.work_W = workplace(hands, presentation_->affordances, status->enabled_agents, standing);
  for (picture::SeenThing& thing : things_at_work(hands, presentation_->affordances, status->enabled_agents, standing))
    out.seen.push_back(std::move(thing));
}

std::optional<picture::Inset> SceneBuilder::detail(const client::WorldStatus& status) const {
  if (presentation_ == nullptr || status.detail.empty()) return std::nullopt;
  const auto view = std::ranges::find(presentation_->views, status.detail, &client::View::name);
  if (view == presentation_->views.end() || is_stray(view->X_WV.p)) return std::nullopt;
  return picture::Inset{camera_at(*view, interest_W_), language_ == "el" ? "Από κοντά" : "Close up"};
}

void SceneBuilder::add_object(const Placed& placed, const Pose& X_WB, const client::Frame* frame,
                              picture::RenderScene& out) const {
  Eigen::Affine3f X = affine(X_WB);
  const std::optional<double> level_m =
      presentation_ && frame != nullptr ? level_of(*presentation_, *frame, placed.object.mesh_node) : std::nullopt;
  if (level_m) X.translation().y() += static_cast<float>(*level_m);
  for (const ModelPart& part : placed.model->parts) {
    if (part.water) {
      if (level_m && *level_m < kLeastLevel_m) continue;
      picture::WaterInstance water = level_m ? picture::WaterInstance{0, {}, 0.55F, 0.6F} : river_water(placed.flow_W);
      water.mesh = part.mesh;
      water.X_WM = X;
      out.waters.push_back(water);
    } else {
      // Land casts no shadow: its rim would shade the land itself, although the plain continues there.
      const bool land = library_.assets().materials[part.material].land;
      out.instances.push_back({part.mesh, part.material, X, !land, placed.index});
    }
  }
  if (!placed.flow_W.isZero()) out.waters.insert(out.waters.end(), placed.reaches.begin(), placed.reaches.end());
}

}  // namespace mechane::scene
