#include "client-sdk/scene/workplace.hpp"

#include <algorithm>

#include "client-sdk/picture/box_corners.hpp"

namespace mechane::scene {
namespace {

using client::Affordance;
using Box = Eigen::AlignedBox3d;

/// What a hand holds is this near to it.
constexpr double kHeld_m = 0.10;
/// How much is shown around a place where something belongs.
constexpr double kAroundGoal_m = 0.06;

Vec3 nearest_place(const StandingObject& object, const Vec3& p_WQ) {
  const Vec3 p_BQ = object.X_WB.inverse() * p_WQ;
  return object.X_WB * Vec3(p_BQ.cwiseMax(object.box_B.min()).cwiseMin(object.box_B.max()));
}

void add_whole(const StandingObject& object, Box& out) {
  out.extend(picture::moved(object.box_B, object.X_WB));
}

class Step {
 public:
  Step(std::span<const Affordance> affordances, std::span<const std::string> enabled, const StandingObjects& standing)
      : affordances_(affordances), enabled_(enabled), standing_(standing) {}

  [[nodiscard]] Box seen_with(std::span<const WorkingHand> hands) const {
    Box out;
    for (const Affordance& affordance : affordances_) {
      if (affordance.kind != Affordance::Kind::taken || !is_enabled(affordance)) continue;
      const StandingObject object = standing_(affordance.object);
      if (object.box_B.isEmpty()) continue;
      if (hands.empty()) {
        add_whole(object, out);
        add_goals(affordance.object, out);
      }
      for (const WorkingHand& hand : hands)
        add_next(hand, affordance.object, object, out);
    }
    if (out.isEmpty()) return out;
    for (const WorkingHand& hand : hands)
      out.extend(hand.box_W);
    return out;
  }

  [[nodiscard]] std::vector<picture::SeenThing> things_for(std::span<const WorkingHand> hands) const {
    std::vector<picture::SeenThing> held, free;
    for (const Affordance& affordance : affordances_) {
      if (affordance.kind != Affordance::Kind::taken || !is_enabled(affordance)) continue;
      const StandingObject object = standing_(affordance.object);
      if (object.box_B.isEmpty()) continue;
      if (hands.empty()) {
        free.push_back(thing_about(object, object.X_WB * Vec3(object.box_B.center())));
        add_goals(affordance.object, free);
      }
      for (const WorkingHand& hand : hands) {
        const Vec3 p_W = nearest_place(object, hand.box_W.center());
        if (!hand.holding) {
          free.push_back(thing_about(object, p_W));
        } else if (hand.box_W.exteriorDistance(p_W) <= kHeld_m) {
          held.push_back(thing_about(object, p_W));
          add_goals(affordance.object, held);
        }
      }
    }
    held.insert(held.end(), free.begin(), free.end());
    return held;
  }

 private:
  [[nodiscard]] bool is_enabled(const Affordance& affordance) const {
    return affordance.agent.empty() || std::ranges::find(enabled_, affordance.agent) != enabled_.end();
  }

  void add_next(const WorkingHand& hand, std::uint32_t index, const StandingObject& object, Box& out) const {
    const Vec3 p_W = nearest_place(object, hand.box_W.center());
    if (!hand.holding) {
      out.extend(p_W);
    } else if (hand.box_W.exteriorDistance(p_W) <= kHeld_m) {
      out.extend(p_W);
      add_goals(index, out);
      add_arc(hand, index, out);
    }
  }

  /// Where a hand goes next that turns what it holds: a quarter of a turn either way, since a lever goes no further.
  void add_arc(const WorkingHand& hand, std::uint32_t index, Box& out) const {
    for (const Affordance& joint : affordances_) {
      if (joint.kind != Affordance::Kind::turns || joint.object != index || !is_enabled(joint)) continue;
      const Pose X_WJ = standing_at(joint) * joint.X_AJ;
      const Vec3 p_JH = X_WJ.inverse() * hand.box_W.center();
      const Vec3 half = hand.box_W.sizes() / 2;
      for (const double turn_rad : {-kPi / 2, -kPi / 4, kPi / 4, kPi / 2}) {
        const Vec3 p_WH = X_WJ * (Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()) * p_JH);
        out.extend(Box(p_WH - half, p_WH + half));
      }
    }
  }

  /// X_WA of an affordance's base.
  [[nodiscard]] Pose standing_at(const Affordance& affordance) const {
    return affordance.base ? standing_(*affordance.base).X_WB : Pose{};
  }

  /// p_WJ of each place where an object belongs.
  [[nodiscard]] std::vector<Vec3> goals_of(std::uint32_t index) const {
    std::vector<Vec3> places;
    for (const Affordance& goal : affordances_) {
      const bool belongs = goal.kind == Affordance::Kind::placed || goal.kind == Affordance::Kind::brought;
      if (belongs && goal.object == index && is_enabled(goal)) places.emplace_back(standing_at(goal) * goal.X_AJ.p);
    }
    return places;
  }

  void add_goals(std::uint32_t index, Box& out) const {
    for (const Vec3& p_WJ : goals_of(index))
      out.extend(Box(p_WJ - Vec3::Constant(kAroundGoal_m), p_WJ + Vec3::Constant(kAroundGoal_m)));
  }

  void add_goals(std::uint32_t index, std::vector<picture::SeenThing>& out) const {
    for (const Vec3& p_WJ : goals_of(index))
      out.push_back({{p_WJ.cast<float>()}, static_cast<float>(kAroundGoal_m)});
  }

  static picture::SeenThing thing_about(const StandingObject& object, const Vec3& about_W) {
    picture::SeenThing thing{{}, 0, about_W.cast<float>()};
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p_WQ = object.X_WB * Vec3(object.box_B.corner(static_cast<Box::CornerType>(corner)));
      thing.points_W.emplace_back(p_WQ.cast<float>());
    }
    return thing;
  }

  std::span<const Affordance> affordances_;
  std::span<const std::string> enabled_;
  const StandingObjects& standing_;
};

}  // namespace

Box workplace(std::span<const WorkingHand> hands, std::span<const Affordance> affordances,
              std::span<const std::string> enabled, const StandingObjects& standing) {
  return Step(affordances, enabled, standing).seen_with(hands);
}

std::vector<picture::SeenThing> things_at_work(std::span<const WorkingHand> hands,
                                               std::span<const Affordance> affordances,
                                               std::span<const std::string> enabled, const StandingObjects& standing) {
  return Step(affordances, enabled, standing).things_for(hands);
}

}  // namespace mechane::scene
