#include "tests/support/pointer_play.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "client-sdk/client/parse.hpp"
#include "client-sdk/pointer/pointer_exchange.hpp"
#include "client-sdk/visitor/pointer_player.hpp"
#include "server/transport/presentation.hpp"

namespace mechane::test {
namespace {

using pointer::PointerView;
using visitor::PointerPlayer;

constexpr std::uint64_t kTicksPerSample = 2;  // as PointerLink sends

std::vector<client::SceneObject> objects_of(const state::WorldDescription& world) {
  std::vector<client::SceneObject> out;
  for (const state::BodyDescription& body : world.bodies) {
    client::SceneObject& object = out.emplace_back();
    object.index = static_cast<std::uint32_t>(out.size() - 1);
    object.name = body.name;
    object.mesh_uri = body.mesh.uri;
    object.mesh_node = body.mesh.node;
    object.X_WB = body.X_WB;
    object.movable = !body.fixed;
  }
  return out;
}

std::shared_ptr<const client::WorldPresentation> presentation_of(const state::WorldDescription& world) {
  auto out = std::make_shared<client::WorldPresentation>();
  if (!client::parse(transport::Presentation("w1", world).wire(), *out)) throw std::runtime_error("no presentation");
  return out;
}

/// The display's own hand, without threads.
class Touch final : public pointer::PointerTouch {
 public:
  explicit Touch(pointer::PointerExchange& hand) : hand_(hand) {}
  void press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched) override {
    hand_.act({pointer::PointerAct::Kind::press, place, 0, sight, touched});
  }
  void move(picture::PixelPlace place) override { hand_.act({pointer::PointerAct::Kind::move, place}); }
  void deepen(double amount) override { hand_.act({pointer::PointerAct::Kind::deepen, {}, amount}); }
  void turn(double angle_rad) override { hand_.act({pointer::PointerAct::Kind::turn, {}, angle_rad}); }
  void release() override { hand_.act({pointer::PointerAct::Kind::release}); }
  [[nodiscard]] PointerView view() override { return hand_.view(); }
  [[nodiscard]] pointer::PointerLinkState state() override { return pointer::PointerLinkState::joined; }

 private:
  pointer::PointerExchange& hand_;
};

class PointerPerson final : public Person {
 public:
  PointerPerson(visitor::ShownExhibit& shown, const state::WorldDescription& description,
                const state::VisitDescription& visit)
      : shown_(shown),
        description_(description),
        player_(shown, description, visit, std::make_unique<Touch>(hand_)),
        X_WB_(description.bodies.size()) {}

  void act(bool sets_out, state::TickInputs& inputs) override {
    if (sets_out && ticks_ % PointerPlayer::kTicksPerPicture == 1) player_.look({frame_, status_, X_WB_, holding_});
    if (const auto clicked = player_.take_click())
      inputs.commands[inputs.command_count++] = {++commands_, state::CommandKind::click, *clicked};
    user_.fresh = false;
    user_.age += kTickPeriod;
    if (ticks_ % kTicksPerSample == 0) move_hand();
    inputs.users[0] = user_;
    ++ticks_;
  }

  void see(const state::WorldState& state) override {
    holding_ = state.users[0].output.holding;
    if (ticks_ % PointerPlayer::kTicksPerPicture != 1) return;
    show(state, description_, frame_, status_);
    for (std::size_t i = 0; i < state.bodies.size(); ++i)
      X_WB_[i] = state.bodies[i].X_WB;
  }

  [[nodiscard]] bool finished() const override { return player_.finished(); }
  [[nodiscard]] std::span<const visitor::MoveResult> results() const override { return player_.results(); }

 private:
  /// What the display's own thread for its hand does, see PointerLink.
  void move_hand() {
    hand_.take_acts();
    if (hand_.resting()) return hand_.publish(pointer::PointerLinkState::joined);
    pointer::PointerHand& hand = hand_.hand();
    const auto senses = pointer::senses_of({&frame_, shown_.objects(), &shown_.presentation(), status_.enabled_agents},
                                           hand.view().object, holding_);
    const auto sample = senses ? hand.advance(kTicksPerSample * kTickSeconds, *senses) : std::nullopt;
    hand_.publish(pointer::PointerLinkState::joined);
    if (!sample) return;
    user_.present = user_.fresh = true;
    user_.age = Duration{0};
    user_.sample = {*sample, 1, user_.sample.sequence + 1, 0};
  }

  visitor::ShownExhibit& shown_;
  const state::WorldDescription& description_;
  pointer::PointerExchange hand_;
  PointerPlayer player_;
  // As last seen.
  client::Frame frame_;
  client::WorldStatus status_;
  std::vector<Pose> X_WB_;
  bool holding_ = false;
  // What the server knows of the hand.
  state::UserInput user_;
  std::uint64_t ticks_ = 0;
  std::uint64_t commands_ = 1;  // the first began the activity
};

}  // namespace

std::unique_ptr<visitor::ShownExhibit> show_exhibit(const state::WorldDescription& description) {
  return std::make_unique<visitor::ShownExhibit>(description.folder, objects_of(description),
                                                 presentation_of(description));
}

void show(const state::WorldState& state, const state::WorldDescription& description, client::Frame& frame,
          client::WorldStatus& status) {
  frame.tick = state.tick;
  frame.bodies.clear();
  frame.visible.clear();
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    frame.visible.push_back(state.bodies[i].visible ? 1 : 0);
    if (!description.bodies[i].fixed) frame.bodies.push_back({static_cast<std::uint32_t>(i), state.bodies[i].X_WB});
  }
  frame.quantities = state.quantities;
  frame.hands.clear();
  for (const state::UserState& user : state.users) {
    if (!user.present) continue;
    client::HandPose& hand = frame.hands.emplace_back();
    hand.kind = user.sample.kind;
    hand.stale = user.stale;
    hand.X_WS = user.X_WS;
    hand.holding = user.output.holding;
  }
  status.enabled_agents.clear();
  for (std::size_t i = 0; i < state.agent_enabled.size(); ++i) {
    if (state.agent_enabled[i] != 0) status.enabled_agents.push_back(description.agents[i].name);
  }
  status.done = state.progress.done;
}

std::unique_ptr<Person> make_pointer_person(visitor::ShownExhibit& shown, const state::WorldDescription& description,
                                            const state::VisitDescription& visit) {
  return std::make_unique<PointerPerson>(shown, description, visit);
}

}  // namespace mechane::test
