// The grasps: how near the palm comes and how far the fingers bend is found by asking the exact meshes for the depth.
#include <algorithm>
#include <cmath>
#include <functional>

#include "server/geometry/mesh_query.hpp"
#include "tests/benchmark/collision/scene.hpp"

namespace mechane::benchmark {
namespace {

constexpr double kOpen_rad = 0.1;
constexpr double kMostBent_rad = 1.7;  // of one joint
constexpr double kTouch_pct = 0.05;    // of the object's diagonal: where a finger or the palm begins to feel the object
constexpr double kPress_pct = 1.1;     // how deep it presses, about

/// A range from first touch to firm press, of the palm's distance or of a finger's bend.
struct Range {
  double touch = 0, press = 0;
  [[nodiscard]] double at(double share) const { return std::lerp(touch, press, share); }
};

class Grasp {
 public:
  Grasp(const SceneObject& object, const HandModel& hand, geometry::Random& random)
      : object_(object), hand_(hand), query_(object.mesh_O), X_OW_(object.X_WO.inverse()) {
    // From above, up to half a right angle aside; any turn about the palm's normal.
    const double tilt = kPi / 4 * random.unit();
    const double towards = 2 * kPi * random.unit();
    const Vec3 z(std::sin(tilt) * std::cos(towards), std::cos(tilt), std::sin(tilt) * std::sin(towards));
    const Quat up = Quat::FromTwoVectors(Vec3::UnitZ(), z);
    R_WPalm_ = up * Quat(Eigen::AngleAxisd(2 * kPi * random.unit(), Vec3::UnitZ()));
    phase_ = 2 * kPi * random.unit();
    calibrate();
  }

  /// `share` of the whole grasp, 0 to 1: come, close, press and play, open, leave.
  [[nodiscard]] HandPose at(double share) const {
    constexpr double kCome = 0.3, kClose = 0.5, kOpen = 0.88, kLeave = 0.93;
    const auto ramp = [&](double from, double to) {
      const double t = std::clamp((share - from) / (to - from), 0.0, 1.0);
      return t * t * (3 - 2 * t);
    };
    const double near = ramp(0, kCome) - ramp(kLeave, 1);
    const double closed = ramp(kCome, kClose) - ramp(kOpen, kLeave);
    const double away = (1 - near) * 0.8 * object_.diagonal_m;
    const double firm = 0.5 + 0.5 * std::sin(phase_ + 14 * share);
    Bends bent{};
    for (std::size_t f = 0; f < kFingers; ++f) {
      const double firmness = 0.5 + 0.5 * std::sin(phase_ + 40 * share + 1.3 * static_cast<double>(f));
      // One joint after the other, in the order in which their ranges were measured. The last one plays, which moves no other.
      for (std::size_t j = 0; j < kJoints; ++j) {
        const double turn = std::clamp(kJoints * closed - static_cast<double>(j), 0.0, 1.0);
        bent[f][j] = std::lerp(kOpen_rad, fingers_[f][j].at(j + 1 < kJoints ? 0.5 : firmness), turn);
      }
    }
    return hand_pose(palm(palm_.at(near * firm) + away), bent);
  }

 private:
  /// The palm above the object's middle, its palmar side that far from it.
  [[nodiscard]] Pose palm(double distance_m) const {
    const Vec3 middle = object_.X_WO * object_.mesh_O.bounds().center();
    // The object lies under the roots of the fingers.
    const Vec3 p_PalmMiddle(0.6 * hand_[0].shape.a.x(), 0, -distance_m);
    return {middle - R_WPalm_ * p_PalmMiddle, R_WPalm_};
  }

  /// How deep the deepest sample of these segments lies in the object, metres; 0 outside.
  [[nodiscard]] double depth(const HandPose& X_WS, std::size_t first, std::size_t count) const {
    double deepest = 0;
    for (std::size_t s = first; s < first + count; ++s) {
      const Pose X_OS = X_OW_ * X_WS[s];
      for (const Vec3f& p_SP : hand_[s].samples_S) {
        const Vec3 p = X_OS * p_SP.cast<double>();
        if (!object_.box_O.contains(p.cast<float>())) continue;
        deepest = std::max(deepest, -query_.signed_distance(p));
      }
    }
    return deepest;
  }

  /// The first value from `from` to `to` at which the depth is reached; `to` when it never is.
  static double reach(double from, double to, double depth_m, const std::function<double(double)>& depth_at) {
    constexpr int kScan = 40;
    constexpr int kHalvings = 12;
    for (int i = 1; i <= kScan; ++i) {
      const double end = std::lerp(from, to, static_cast<double>(i) / kScan);
      if (depth_at(end) < depth_m) continue;
      double low = std::lerp(from, to, (i - 1.0) / kScan);
      double high = end;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (low + high);
        (depth_at(middle) < depth_m ? low : high) = middle;
      }
      return low;
    }
    return to;
  }

  void calibrate() {
    const double touch = kTouch_pct / 100 * object_.diagonal_m;
    const double press = kPress_pct / 100 * object_.diagonal_m;
    Bends bent;
    for (auto& finger : bent)
      finger.fill(kOpen_rad);
    const auto palm_depth = [&](double distance) { return depth(hand_pose(palm(distance), bent), 0, kSegments); };
    const double far = 1.2 * object_.diagonal_m;
    palm_.touch = reach(far, 0, touch, palm_depth);
    palm_.press = reach(palm_.touch, 0, 0.4 * press, palm_depth);
    // From the knuckle on, each joint closes until its segment, or one behind it, presses.
    for (std::size_t f = 0; f < kFingers; ++f) {
      for (std::size_t j = 0; j < kJoints; ++j) {
        const auto joint_depth = [&](double angle) {
          bent[f][j] = angle;
          return depth(hand_pose(palm(palm_.at(0.5)), bent), 1 + kJoints * f + j, kJoints - j);
        };
        const double firm = (j + 1 < kJoints ? 0.7 : 1) * press;
        fingers_[f][j].touch = reach(kOpen_rad, kMostBent_rad, touch, joint_depth);
        fingers_[f][j].press = reach(fingers_[f][j].touch, kMostBent_rad, firm, joint_depth);
        bent[f][j] = fingers_[f][j].at(0.5);
      }
    }
  }

  const SceneObject& object_;
  const HandModel& hand_;
  geometry::MeshQuery query_;
  Pose X_OW_;
  Quat R_WPalm_;
  double phase_ = 0;
  Range palm_;
  std::array<std::array<Range, kJoints>, kFingers> fingers_;
};

}  // namespace

Scene make_scene(std::uint64_t seed, std::size_t steps) {
  Scene scene;
  scene.seed = seed;
  scene.objects = make_objects(seed);
  scene.hand = make_hand();
  geometry::Random random(seed + 1000);
  for (std::size_t i = 0; i < kSceneObjects; ++i) {
    const Grasp grasp(scene.objects[i], scene.hand, random);
    const std::size_t count = steps * (i + 1) / kSceneObjects - steps * i / kSceneObjects;
    for (std::size_t k = 0; k < count; ++k) {
      scene.steps.push_back(grasp.at(static_cast<double>(k) / static_cast<double>(count)));
      scene.grasped.push_back(i);
    }
  }
  return scene;
}

}  // namespace mechane::benchmark
