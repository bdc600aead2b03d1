// Where the native display sees the things of the nine places, in places.txt; client-sdk/web/tests/places.test.ts compares the pages.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "client-sdk/picture/box_corners.hpp"
#include "client-sdk/picture/stereo.hpp"
#include "tests/support/golden_rows.hpp"
#include "tests/support/recorded_place.hpp"

namespace mechane {
namespace {

constexpr double kAspect = 16.0 / 9;
constexpr int kMoment = 2;

std::vector<double> numbers(const Pose& X) {
  return {X.p.x(), X.p.y(), X.p.z(), X.R.x(), X.R.y(), X.R.z(), X.R.w()};
}

std::string row(const std::string& name, const std::vector<double>& numbers) {
  return fmt::format("{} {:.7g}", name, fmt::join(numbers, " "));
}

/// Left, lower, right, upper: -1 and 1 at the picture's edges.
std::vector<double> seen_box(const picture::Camera& camera, const Eigen::AlignedBox3f& box_B, const Pose& X_WB) {
  const picture::EyeView view = picture::eye_view(camera, picture::Eye::middle, kAspect);
  Eigen::AlignedBox2f out;
  for (const Vec3f& p_B : picture::corners_of(box_B)) {
    const Vec3f p_W = (X_WB * Vec3(p_B.cast<double>())).cast<float>();
    const Eigen::Vector4f clip = view.P * view.V_CW * p_W.homogeneous();
    out.extend(Eigen::Vector2f(clip.hnormalized().head<2>()));
  }
  return {out.min().x(), out.min().y(), out.max().x(), out.max().y()};
}

/// What a page needs to show the place, and where its movable things are seen.
void add_place(const std::string& name, std::vector<std::string>& rows) {
  test::RecordedPlace place(name);
  const picture::Camera camera = place.scene(kMoment, kAspect).camera;
  const auto presentation = place.client().presentation();
  for (const client::View& view : presentation->views) {
    std::vector<double> seen = numbers(view.X_WV);
    seen.push_back(view.field_of_view_rad);
    rows.push_back(row(fmt::format("{}|view|{}", name, view.name), seen));
  }
  for (const client::Effect& effect : presentation->effects)
    if (effect.kind == "level") rows.push_back(row(fmt::format("{}|level|{}", name, effect.node), {}));
  for (const client::SceneObject& object : place.client().objects()) {
    const auto body = std::ranges::find(place.frame().bodies, object.index, &client::BodyPose::object);
    const Pose& X_WB = body == place.frame().bodies.end() ? object.X_WB : body->X_WB;
    std::vector<double> all = numbers(object.X_WB);
    if (object.movable) {
      std::ranges::copy(numbers(X_WB), std::back_inserter(all));
      std::ranges::copy(seen_box(camera, place.library().model(object.mesh_uri, object.mesh_node).box_B, X_WB),
                        std::back_inserter(all));
    }
    rows.push_back(row(fmt::format("{}|{}|{}|{}", name, object.name, object.mesh_uri, object.mesh_node), all));
  }
}

TEST(Places, AreSeenWhereTheyWere) {
  std::vector<std::string> rows;
  for (const char* name : {"aiolos-sphere", "archimedes-screw", "catapult", "compound-pulley-crane", "crossbow",
                           "ktesibios-pump", "odometer", "pulley-crane", "village"})
    add_place(name, rows);
  test::expect_accepted("places.txt", rows, 1e-4);
}

}  // namespace
}  // namespace mechane
