#include "client-sdk/visitor/session_hand.hpp"

#include <algorithm>
#include <utility>

#include "client-sdk/pointer/pointer_link.hpp"
#include "client-sdk/visitor/pointer_player.hpp"

namespace mechane::visitor {
namespace {

using state::VisitDescription;
using state::WorldDescription;

class DeviceHand final : public SessionHand {
 public:
  DeviceHand(const VisitOptions& options, const WorldDescription& world)
      : options_(options),
        world_(world),
        device_(haptic::make_virtual_device(options.device, options.player.X_WH_rest.p)) {}

  Expected<void> start(client::Client& client) {
    auto loop = haptic::HapticLoop::create(client, *device_, options_.render);
    if (!loop) return tl::unexpected(loop.error());
    loop_ = std::move(*loop);
    return {};
  }

  void begin(const VisitDescription& visit) override {
    player_ = std::make_unique<VisitPlayer>(world_, visit, options_.player);
    device_->intend(player_->intent());
  }
  void act(const SeenWorld& seen) override {
    player_->advance(kTickSeconds, seen.X_WB, sense_hand(*device_, *loop_));
    device_->intend(player_->intent());
  }
  void tick(TimePoint now) override { loop_->tick(now, kTickPeriod); }
  void note_step() override { player_->note_step(); }
  void try_step_again() override { player_->try_step_again(); }
  [[nodiscard]] bool finished() const override { return player_->finished(); }
  [[nodiscard]] std::span<const MoveResult> results() const override { return player_->results(); }
  [[nodiscard]] bool release(TimePoint now) override { return loop_->release(now, kTickPeriod); }
  [[nodiscard]] haptic::LoopStats stats() const override { return loop_->stats(); }
  [[nodiscard]] realtime::LatencyHistogram round_trip() const override { return loop_->round_trip(); }

 private:
  const VisitOptions& options_;
  const WorldDescription& world_;
  std::unique_ptr<haptic::SimulatedDevice> device_;
  std::unique_ptr<haptic::HapticLoop> loop_;
  std::unique_ptr<VisitPlayer> player_;
};

/// The mouse moves the hand that a display has: a session and a thread of its own, see PointerLink.
class MouseHand final : public SessionHand {
 public:
  MouseHand(const VisitOptions& options, const WorldDescription& world, client::Client& client)
      : options_(options), world_(world), client_(client) {}

  void begin(const VisitDescription& visit) override {
    player_.reset();
    visit_ = &visit;
    ticks_ = 0;
  }
  void act(const SeenWorld& seen) override {
    if (ticks_++ % PointerPlayer::kTicksPerPicture != 0) return;
    if (seen.status == nullptr || (!player_ && !sit_down())) return;
    const bool holding = std::ranges::any_of(seen.frame.hands, [&](const client::HandPose& hand) {
      return hand.kiosk == options_.client.kiosk && hand.holding;
    });
    player_->look({seen.frame, *seen.status, seen.X_WB, holding});
    if (const auto clicked = player_->take_click()) (void)client_.click(shown_->objects()[*clicked].name);
  }
  void tick(TimePoint /*now*/) override {}
  void note_step() override {
    if (player_) player_->note_step();
  }
  void try_step_again() override {
    if (player_) player_->try_step_again();
  }
  [[nodiscard]] bool finished() const override { return player_ ? player_->finished() : ticks_ > kManifestComes; }
  [[nodiscard]] std::span<const MoveResult> results() const override {
    return player_ ? player_->results() : std::span<const MoveResult>();
  }
  [[nodiscard]] bool release(TimePoint /*now*/) override {
    player_.reset();
    return true;
  }

 private:
  static constexpr int kManifestComes = 10'000;  // ticks; a server with another version of the scenario has another one

  /// False while the manifest is still arriving.
  bool sit_down() {
    if (!shown_) {
      std::vector<client::SceneObject> objects = client_.objects();
      auto presentation = client_.presentation();
      const bool whole =
          std::ranges::equal(objects, world_.bodies, {}, &client::SceneObject::name, &state::BodyDescription::name);
      if (!whole || !presentation) return false;
      shown_ = std::make_unique<ShownExhibit>(world_.folder, std::move(objects), std::move(presentation));
    }
    player_ = std::make_unique<PointerPlayer>(
        *shown_, world_, *visit_,
        std::make_unique<pointer::PointerLink>(options_.client.kiosk, options_.client.domain));
    return true;
  }

  const VisitOptions& options_;
  const WorldDescription& world_;
  client::Client& client_;
  const VisitDescription* visit_ = nullptr;
  std::unique_ptr<ShownExhibit> shown_;  // once for all visits
  std::unique_ptr<PointerPlayer> player_;
  int ticks_ = 0;  // of the visit
};

}  // namespace

Expected<std::unique_ptr<SessionHand>> make_session_hand(const VisitOptions& options, const WorldDescription& world,
                                                         client::Client& client) {
  if (options.pointer) return std::make_unique<MouseHand>(options, world, client);
  auto hand = std::make_unique<DeviceHand>(options, world);
  if (auto started = hand->start(client); !started) return tl::unexpected(started.error());
  return hand;
}

}  // namespace mechane::visitor
