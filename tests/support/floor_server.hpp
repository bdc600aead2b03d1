// What a server answers about a block with its top at a given height: the contacts and forces of its tick, without its network.
#pragma once

#include <memory>
#include <set>
#include <utility>

#include "server/haptics/contacts.hpp"
#include "server/haptics/near_surfaces.hpp"
#include "server/haptics/render_forces.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/touch.hpp"

namespace mechane::test {

class FloorServer {
 public:
  FloorServer(double top_m, double stiffness_n_per_m)
      : FloorServer(block(top_m, {.stiffness_n_per_m = stiffness_n_per_m})) {}
  /// The same with the top at 0.
  explicit FloorServer(const state::HapticMaterial& haptic) : FloorServer(block(0, haptic)) {}
  /// The same of any object, where its frame is the world's.
  explicit FloorServer(const std::shared_ptr<const collision::Object>& object, const haptics::ForceConfig& config = {})
      : FloorServer(fixed(object), config) {}

  /// Of one tick, for a hand that was sent just before it.
  const hand::HapticOutput& answer(const hand::HandSample& sample) {
    find_contacts(sample);
    return render();
  }
  /// Its two halves.
  void find_contacts(const hand::HandSample& sample) {
    state::UserState& user = state_.users[0];
    user.present = true;
    user.freshness = 1;
    static_cast<hand::HandSample&>(user.sample) = sample;
    user.X_WH = sample.X_WH;
    user.V_WH = sample.V_WH;
    hand_->place(user.sample, user.X_WH, user.X_WS);
    haptics::find_contacts(world_, *hand_, state_);
    haptics::find_near_surfaces(world_, *hand_, state_);
  }
  const hand::HapticOutput& render() {
    ++state_.tick;
    state_.bodies[0].load_W = Wrench{};
    renderer_.run(world_, *hand_, state_);
    return state_.users[0].output;
  }
  /// From now on the body is there.
  void place(const Pose& X_WB) { state_.bodies[0].X_WB = X_WB; }
  [[nodiscard]] const state::WorldState& state() const { return state_; }
  [[nodiscard]] state::UserState& user() { return state_.users[0]; }
  /// From now on the block feels otherwise.
  void feel(const state::HapticMaterial& haptic) { state_.bodies[0].haptic = haptic; }
  [[nodiscard]] std::size_t segments_that_touch() const {
    std::set<std::uint8_t> segments;
    for (const state::Contact& contact : state_.users[0].contact_span())
      segments.insert(contact.segment);
    return segments.size();
  }

 private:
  explicit FloorServer(state::WorldDescription world, const haptics::ForceConfig& config = {})
      : world_(std::move(world)), state_(world_), renderer_(haptics::ForceRenderer::create(config).value()) {
    renderer_.start(state_);
  }
  static state::WorldDescription fixed(const std::shared_ptr<const collision::Object>& object) {
    state::BodyDescription body;
    body.name = "BODY";
    body.fixed = true;
    body.object = object;
    state::WorldDescription world;
    world.bodies = {body};
    return world;
  }
  static state::WorldDescription block(double top_m, const state::HapticMaterial& haptic) {
    static const Vec3 half_m(0.1, 0.02, 0.1);
    static const auto object = built(box(half_m));
    state::WorldDescription world = fixed(object);
    world.bodies[0].X_WB.p.y() = top_m - half_m.y();
    world.bodies[0].haptic = haptic;
    return world;
  }

  state::WorldDescription world_;
  state::WorldState state_;
  std::shared_ptr<const haptics::HandModel> hand_ = shared_hand();
  haptics::ForceRenderer renderer_;
};

}  // namespace mechane::test
