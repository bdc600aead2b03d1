// The grasps: how near the palm comes and how far the fingers bend is found by asking the exact meshes for the depth.
#include <algorithm>
#include <cmath>
#include <functional>

#include "server/geometry/surface_samples.hpp"
#include "tests/benchmark/collision/scene.hpp"
#include "tests/benchmark/collision/solid_query.hpp"

namespace mechane::benchmark {
namespace {

constexpr double kOpen_rad = 0.1;
constexpr double kMostBent_rad = 1.7;  // of one joint
constexpr double kTouch_pct = 0.05;    // of the object's diagonal: where a finger or the palm begins to feel the object
constexpr double kPress_pct = 1.1;     // how deep it presses, about
constexpr double kTouch_m = 0.0002;    // the same for a thing of its true size
constexpr double kPress_m = 0.003;
constexpr double kReach_m = 0.25;  // from where the hand comes to it

/// A range from first touch to firm press, of the palm's distance or of a finger's bend.
struct Range {
  double touch = 0, press = 0;
  [[nodiscard]] double at(double share) const { return std::lerp(touch, press, share); }
};

/// Where a palm goes, from where, and how deep the hand then presses.
struct Aim {
  Vec3 p_W = Vec3::Zero();
  Vec3 z_W = Vec3::UnitZ();  ///< of the palm: out of what is grasped
  double far_m = 0;          ///< from here on the palm feels for the object
  double away_m = 0;         ///< from where it comes, beyond the first touch
  double touch_m = 0, press_m = 0;
};

/// At the object's middle from above, up to half a right angle aside.
Aim aim_at_middle(const SceneObject& object, Random& random) {
  const double tilt = kPi / 4 * random.unit();
  const double towards = 2 * kPi * random.unit();
  return {object.X_WO * object.mesh_O.bounds().center(),
          Vec3(std::sin(tilt) * std::cos(towards), std::cos(tilt), std::sin(tilt) * std::sin(towards)),
          1.2 * object.diagonal_m,
          0.8 * object.diagonal_m,
          kTouch_pct / 100 * object.diagonal_m,
          kPress_pct / 100 * object.diagonal_m};
}

/// At a place of the surface, straight in, with a hand's own reach: for things much larger than a hand.
Aim aim_at_surface(const SceneObject& object, const Vec3& p_O, const Vec3& n_O) {
  return {object.X_WO * p_O, object.X_WO.rotate(n_O), kReach_m, kReach_m, kTouch_m, kPress_m};
}

class Grasp {
 public:
  Grasp(const SceneObject& object, const HandModel& hand, const Aim& aim, Random& random)
      : object_(object), hand_(hand), query_(object), X_OW_(object.X_WO.inverse()), aim_(aim) {
    const Quat up = Quat::FromTwoVectors(Vec3::UnitZ(), aim.z_W);
    // Any turn about the palm's normal.
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
    const double away = (1 - near) * aim_.away_m;
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
  /// The palm above the place it aims at, its palmar side that far from it.
  [[nodiscard]] Pose palm(double distance_m) const {
    // The object lies under the roots of the fingers.
    const Vec3 p_PalmMiddle(0.6 * hand_[0].shape.a.x(), 0, -distance_m);
    return {aim_.p_W - R_WPalm_ * p_PalmMiddle, R_WPalm_};
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
    const double touch = aim_.touch_m;
    const double press = aim_.press_m;
    Bends bent;
    for (auto& finger : bent)
      finger.fill(kOpen_rad);
    const auto palm_depth = [&](double distance) { return depth(hand_pose(palm(distance), bent), 0, kSegments); };
    palm_.touch = reach(aim_.far_m, 0, touch, palm_depth);
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
  SolidQuery query_;
  Pose X_OW_;
  Aim aim_;
  Quat R_WPalm_;
  double phase_ = 0;
  Range palm_;
  std::array<std::array<Range, kJoints>, kFingers> fingers_;
};

/// The places of the surface before which a hand has the most room, of many.
std::vector<Aim> free_aims(const SceneObject& object, std::size_t count, std::uint64_t seed) {
  constexpr std::size_t kCandidates = 20;  // for each
  const SolidQuery query(object);
  const geometry::Mesh& surface = object.skin_O.triangles.empty() ? object.mesh_O : object.skin_O;
  std::vector<std::pair<double, Aim>> found;
  for (const auto& place : geometry::sample_by_area(surface, kCandidates * count, seed)) {
    const Vec3 n_O = query.triangle_normal(place.triangle);
    double room = 1;
    for (const double ahead : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      const Vec3 p = place.p + ahead * kReach_m * n_O;
      room = std::min(room, query.signed_distance(p) / (ahead * kReach_m));
    }
    found.emplace_back(room, aim_at_surface(object, place.p, n_O));
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& l, const auto& r) { return l.first > r.first; });
  // The freest half, evenly: not the freest alone, which lie side by side.
  std::vector<Aim> aims;
  for (std::size_t i = 0; i < count; ++i)
    aims.push_back(found[i * found.size() / (2 * count)].second);
  return aims;
}

}  // namespace

Scene make_scene(std::uint64_t seed, std::size_t steps) {
  Scene scene;
  scene.seed = seed;
  scene.objects = make_objects(seed);
  scene.hand = make_hand();
  Random random(seed + 1000);
  for (std::size_t i = 0; i < kSceneObjects; ++i) {
    const Aim aim = aim_at_middle(scene.objects[i], random);
    const Grasp grasp(scene.objects[i], scene.hand, aim, random);
    const std::size_t count = steps * (i + 1) / kSceneObjects - steps * i / kSceneObjects;
    for (std::size_t k = 0; k < count; ++k) {
      scene.steps.push_back(grasp.at(static_cast<double>(k) / static_cast<double>(count)));
      scene.grasped.push_back(i);
    }
  }
  return scene;
}

Scene make_scene_of(SceneObject object, std::uint64_t seed, std::size_t grasps, std::size_t steps) {
  Scene scene;
  scene.seed = seed;
  scene.objects.push_back(std::move(object));
  scene.hand = make_hand();
  Random random(seed + 2000);
  const std::size_t each = steps / grasps;
  for (const Aim& aim : free_aims(scene.objects.front(), grasps, seed + 3000)) {
    const Grasp grasp(scene.objects.front(), scene.hand, aim, random);
    for (std::size_t k = 0; k < each; ++k) {
      scene.steps.push_back(grasp.at(static_cast<double>(k) / static_cast<double>(each)));
      scene.grasped.push_back(0);
    }
  }
  return scene;
}

}  // namespace mechane::benchmark
