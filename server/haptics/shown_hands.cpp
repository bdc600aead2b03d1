#include "server/haptics/shown_hands.hpp"

#include <Eigen/Dense>
#include <boost/container/static_vector.hpp>

#include "server/hand/friction_spring.hpp"
#include "server/haptics/wall_sides.hpp"

namespace mechane::haptics {
namespace {

/// The move that leaves the least sum of squares of depths behind the walls. A small cost of the move itself keeps the answer unique, and
/// falls short by under a hundredth. A wall that the hand is moved past does not count, which each round finds out anew.
Vec3 out_of_walls_W(const HandModel& hand, const state::WorldState& state, const state::UserState& user) {
  constexpr double kCostOfMove = 0.01;
  constexpr int kRounds = 4;
  struct Wall {
    Vec3 n_W;
    double in_m;
  };
  boost::container::static_vector<Wall, state::kMaxSides> walls;
  for (const state::WallSide& side : user.side_span())
    walls.push_back({state[side.body].X_WB.rotate(side.n_B), depth_behind_m(hand, state, user, side)});
  Vec3 out_W = Vec3::Zero();
  for (int round = 0; round < kRounds; ++round) {
    Mat3 A = kCostOfMove * Mat3::Identity();
    Vec3 b = Vec3::Zero();
    for (const Wall& wall : walls) {
      if (wall.in_m <= wall.n_W.dot(out_W)) continue;
      A += wall.n_W * wall.n_W.transpose();
      b += wall.in_m * wall.n_W;
    }
    out_W = A.ldlt().solve(b);
  }
  return out_W;
}

}  // namespace

void ShownHands::follow(const HandModel& hand, const state::WorldState& state) noexcept {
  const double passed_s = kTickSeconds * static_cast<double>(state.tick - tick_);
  tick_ = state.tick;
  for (std::size_t i = 0; i < state.users.size(); ++i) {
    const state::UserState& user = state.users[i];
    if (!user.present || user.sample.session != session_[i]) {
      out_W_[i] = Vec3::Zero();
    } else {
      const Vec3 wanted_W = user.grasp.active ? Vec3(Vec3::Zero()) : out_of_walls_W(hand, state, user);
      const double moved_m = (user.X_WH.p - p_WH_[i]).norm();
      out_W_[i] += hand::at_most(wanted_W - out_W_[i], moved_m + kCatchesUp_m_per_s * passed_s);
    }
    session_[i] = user.sample.session;
    p_WH_[i] = user.X_WH.p;
  }
}

}  // namespace mechane::haptics
