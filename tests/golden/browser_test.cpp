// What the browser's pages compute again in TypeScript: cameras, eyes, hands, plants and sounds of the native programs, in browser.txt.
// client-sdk/web/tests/native.test.ts compares the pages with the same file.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "client-sdk/picture/stereo.hpp"
#include "client-sdk/scene/hand_skin.hpp"
#include "client-sdk/scene/landscape.hpp"
#include "client-sdk/sound/sound_scene.hpp"
#include "server/base/random.hpp"
#include "tests/support/golden_rows.hpp"

namespace mechane {
namespace {

using Rows = std::vector<std::string>;

template <class Numbers>
void add(Rows& rows, const std::string& name, const Numbers& numbers) {
  rows.push_back(fmt::format("{} {:.7g}", name, fmt::join(numbers, " ")));
}
template <class Derived>
void add_matrix(Rows& rows, const std::string& name, const Eigen::DenseBase<Derived>& m) {
  const Eigen::MatrixXd all = m.derived().template cast<double>();
  add(rows, name, std::vector<double>(all.data(), all.data() + all.size()));  // by columns
}

void add_random(Rows& rows) {
  ShortRandom random(7, 3, 11);
  std::vector<double> units(6);
  for (double& unit : units)
    unit = random.unit();
  add(rows, "random", units);
}

void add_hand(Rows& rows, const std::string& name, const scene::SegmentPoses& X_HS) {
  for (std::size_t s = 0; s < X_HS.size(); ++s)
    add_matrix(rows, fmt::format("hand.{}.{}", name, s), X_HS[s].p);
  for (std::size_t f = 0; f < client::kFingers; ++f)
    add_matrix(rows, fmt::format("tip.{}.{}", name, f), scene::finger_tip(X_HS, f));
}

void add_skin(Rows& rows) {
  const auto& p_H = scene::HandSkin::shared().rest().positions;
  for (std::size_t i = 0; i < p_H.size(); i += p_H.size() / 20)
    add_matrix(rows, "skin", p_H[i]);
}

/// What each eye sees, and where.
void add_eyes(Rows& rows, const std::string& name, const picture::Camera& camera) {
  constexpr double kAspect = 1.5;
  for (const auto& [word, eye] : {std::pair("left", picture::Eye::left), std::pair("right", picture::Eye::right)}) {
    const picture::EyeView view = picture::eye_view(camera, eye, kAspect);
    add_matrix(rows, fmt::format("camera.{}.{}.at", name, word), view.p_WE);
    add_matrix(rows, fmt::format("camera.{}.{}.P", name, word), view.P);
    add_matrix(rows, fmt::format("camera.{}.{}.V", name, word), view.V_CW);
  }
}

void add_cameras(Rows& rows) {
  picture::Camera camera;
  camera.p_WC = {0.3, 1.5, 2};
  camera.p_WT = {0.1, 1.1, -0.2};
  camera.field_of_view_rad = 0.8;
  camera.least_horizontal_rad = 0.9;
  camera.room_below = 1.1;
  const Eigen::AlignedBox3d box_W(Vec3(-0.5, 0.8, -0.4), Vec3(0.6, 1.4, 0.5));
  camera.nearest_m = picture::nearest_of(box_W, camera);
  add(rows, "camera.nearest", std::vector{camera.nearest_m});
  const auto on = [](const picture::Camera& seen, double width_m, double away_m, double eyes_m) {
    return picture::for_screen(seen, {width_m, away_m, eyes_m}, nullptr, 1.5);
  };
  add_eyes(rows, "any_screen", on(camera, 0, 0, 0.064));
  add_eyes(rows, "narrow_eyes", on(camera, 0, 0, 0.03));
  add_eyes(rows, "known_screen", on(camera, 0.6, 0.7, 0.06));
  add_eyes(rows, "framed", on(picture::frame_box(box_W, {0.2, 0.3, 1}, 0.7), 0, 0, 0.064));
  add_eyes(rows, "narrowed", on(picture::narrowed_to(camera, {0.1, 0.05, 0.2}, 1.5, 2), 0, 0, 0.064));
  const Eigen::AlignedBox2d seen = picture::seen_box(camera, box_W);
  add(rows, "camera.seen", std::vector{seen.min().x(), seen.min().y(), seen.max().x(), seen.max().y()});
}

void add_stereo(Rows& rows) {
  for (const auto& [name, stereo] : picture::stereo_names()) {
    if (stereo == picture::Stereo::quad_buffer) continue;  // no browser shows it
    const auto eye = picture::eye_size(stereo, {1920, 1081});
    const auto seen = picture::seen_size(stereo, {1920, 1081});
    add(rows, fmt::format("stereo.{}", name),
        std::vector{static_cast<double>(picture::eyes_of(stereo).size()), double(eye.width), double(eye.height),
                    double(seen.width), double(seen.height)});
  }
}

void add_plants(Rows& rows) {
  scene::LandscapePlan plan;
  plan.middle_W = {1, 0, -2};
  plan.clearing_m = 9;
  plan.seed = 5;
  plan.waters_W = {{Vec3f(10, 0, -60), Vec3f(60, 0, 40), Vec3f(30, 0, 60)}};
  const auto plants = scene::plants_of(plan);
  for (std::size_t i = 0; i < plants.size(); i += 10) {
    const scene::Plant& plant = plants[i];
    add(rows, "plant",
        std::vector<double>{double(plant.kind), plant.p_W.x(), plant.p_W.y(), plant.p_W.z(), plant.height_m,
                            double(plant.seed)});
  }
}

void add_sounds(Rows& rows) {
  client::SceneObject crank;
  crank.name = "crank";
  crank.movable = true;
  client::Frame before, now;
  before.tick = 1000;
  before.bodies = {{0, {Vec3(0, 1, 0), Quat::Identity()}}};
  before.visible = now.visible = {1};
  before.quantities = now.quantities = {0.3};
  now.tick = 1050;
  now.bodies = {{0, {Vec3(0.01, 1, 0.02), quat_from_rotation_vector(Vec3(0, 0, 0.02))}}};
  std::vector<sound::SoundEffect> effects;
  for (const char* kind : {"water", "wood", "rope", "stone", "fire", "steam", "ratchet"}) {
    sound::SoundEffect effect;
    effect.name = kind;
    effect.kind = fmt::format("sound.{}", kind);
    effect.quantity = 0;
    effect.size_m = 2.5;
    effects.push_back(effect);
  }
  sound::SoundEffect creak;  // as loud as the crank turns
  creak.name = "crank";
  creak.kind = "sound.wood";
  creak.object = 0;
  creak.p_B = {0.1, 0, 0};
  creak.full = 3;
  creak.size_m = 0.4;
  effects.push_back(creak);
  sound::SoundEffect bow;
  bow.name = "bow";
  bow.kind = "sound.bow";
  bow.object = 0;
  bow.p_B = {0, 2, 0};
  effects.push_back(bow);
  std::vector<client::WorldEvent> events;
  for (const char* kind : {"grasped", "released", "placed", "assembled", "part_refused", "pushed", "pulled", "lit",
                           "broke", "spilled", "fired"})
    events.push_back({1050, kind, "", "crank", 0.0005});
  for (const sound::SoundSource& source : sound::sound_sources({&before, &now, events, {&crank, 1}, effects})) {
    add(rows, "sound", std::vector{double(source.kind), source.gain, source.pitch, source.near_m});
    add_matrix(rows, "sound_at", source.p_W);
  }
}

TEST(Browser, ComputesWhatTheNativeProgramsDo) {
  Rows rows;
  add_random(rows);
  add_hand(rows, "flat", scene::HandSkin::rest_poses());
  add_hand(rows, "pointing", scene::place_hand(scene::pointing_hand()));
  add_hand(rows, "pinching", scene::place_hand(scene::pinching_hand()));
  add_skin(rows);
  add_cameras(rows);
  add_stereo(rows);
  add_plants(rows);
  add_sounds(rows);
  test::expect_accepted("browser.txt", rows, 1e-5);
}

}  // namespace
}  // namespace mechane
