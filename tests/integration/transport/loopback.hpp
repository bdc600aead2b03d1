// A server's transport and clients in one process, talking over the loopback network: each side in a DDS domain of its own that
// shows the same number and tag on the network, so that samples really travel.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <dds/dds.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "server/realtime/periodic_thread.hpp"
#include "server/realtime/wakeup.hpp"
#include "server/transport/server_transport.hpp"
#include <mechane/client/client.hpp>
#include <mechane/proto/entity.hpp>
#include <mechane/proto/qos.hpp>

namespace mechane::test {

inline constexpr std::uint32_t kServerDomain = 41;
inline constexpr std::uint32_t kClientDomain = 42;
/// How far beside their places the server below shows hands.
inline const Vec3 kShown_W(0, 0.25, 0);

/// Holds the configuration of one domain while it lives.
class LoopbackDomain {
 public:
  LoopbackDomain(std::uint32_t id, int loss_per_mille) {
    const std::string xml = fmt::format(
        "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\" "
        "multicast=\"true\"/></Interfaces>"
        "<AllowMulticast>spdp</AllowMulticast></General><Discovery><Tag>mechane-{}</Tag><ExternalDomainId>{}</"
        "ExternalDomainId>"
        "<LeaseDuration>5s</LeaseDuration><SPDPInterval>100ms</SPDPInterval></Discovery><Internal>"
        "<HeartbeatInterval>5ms</HeartbeatInterval><NackDelay>1ms</NackDelay>"
        "<Test><XmitLossiness>{}</XmitLossiness></Test></Internal></Domain></CycloneDDS>",
        ::getpid(), kServerDomain, loss_per_mille);
    handle_ = dds_create_domain(id, xml.c_str());
  }
  ~LoopbackDomain() {
    if (handle_ > 0) dds_delete(handle_);
  }
  LoopbackDomain(const LoopbackDomain&) = delete;
  LoopbackDomain& operator=(const LoopbackDomain&) = delete;
  [[nodiscard]] bool good() const { return handle_ > 0; }

 private:
  dds_entity_t handle_ = 0;
};

/// A world with some bodies, one step of an activity and a quantity.
[[nodiscard]] inline std::shared_ptr<const state::WorldDescription> small_world(std::size_t bodies = 3) {
  auto world = std::make_shared<state::WorldDescription>();
  world->id = "small";
  world->content_hash = "00ff";
  world->title = {{"el", "Μικρός κόσμος"}, {"en", "A small world"}};
  for (std::size_t i = 0; i < bodies; ++i) {
    state::BodyDescription body;
    body.name = fmt::format("BODY_{}", i);
    body.fixed = i == 0;
    body.X_WB.p = Vec3(static_cast<double>(i), 0, 0);
    body.mesh = {"models/small.glb", "abcd", body.name};
    if (i == 1) body.title = {{"el", "Η μανιβέλα"}, {"en", "The crank"}};
    world->bodies.push_back(body);
  }
  state::QuestionDescription liked;
  liked.name = "liked";
  liked.kind = state::QuestionDescription::Kind::scale;
  liked.question = {{"en", "Did you like it?"}};
  liked.high = {{"en", "much"}};
  world->activities.push_back(
      {.name = "use", .first = StepId(0), .title = {}, .goal = {{"en", "Cranks turn."}}, .questionnaire = {liked}});
  world->languages = {"el", "en"};
  world->viewpoints.push_back({"NEAR", "near", {Vec3(0, 1.5, 2), Quat::Identity()}, 0.7});
  state::EffectDescription spout;
  spout.name = "SPOUT";
  spout.kind = "stream";
  spout.body = BodyId(1);
  spout.p_BE = Vec3(0, 0.25, 0);
  spout.quantity = QuantityId(0);
  spout.full = 2;
  world->effects.push_back(spout);
  state::StepDescription step;
  step.name = "turn";
  step.activity = ActivityId(0);
  step.texts["caption"] = {{"en", "Turn the crank"}};
  step.texts["narration"] = {{"en", "A crank has an arm."}};
  step.detail = "NEAR";
  state::TriggerDescription full, spilt;
  full.quantity = spilt.quantity = QuantityId(0);
  full.value = 15;
  full.more = {{QuantityId(0), state::Comparison::less, 16, 0}};
  spilt.value = 40;
  step.triggers = {full, spilt};
  world->steps.push_back(step);
  world->quantities.push_back(
      {"water", "PUMP.basin_l", "l", {{"en", "Water in the basin"}}, state::GaugeRange{-5, 40}});
  return world;
}

/// A server that gives every kiosk the same world, in which a hand feels its own position as a force: f = p, in newtons.
class EchoServer {
 public:
  explicit EchoServer(const std::shared_ptr<const state::WorldDescription>& world = small_world()) : state_(*world) {
    auto transport = transport::ServerTransport::start({.server = "test", .version = "1.2.3", .domain = kServerDomain});
    if (!transport) {
      ADD_FAILURE() << transport.error().to_string();
      return;
    }
    transport_ = std::move(*transport);
    auto port = transport_->open_world("w1", world);
    if (!port) {
      ADD_FAILURE() << port.error().to_string();
      return;
    }
    port_ = *port;
    state::Coupling rope;
    rope.kind = state::CouplingKind::rope;
    rope.enabled = true;
    rope.node_count = 2;
    rope.nodes[0].body = BodyId(0);
    rope.nodes[1].body = BodyId(2);
    if (world->bodies.size() > 2) state_.couplings.push_back(rope);
    state_.progress.activity = ActivityId(0);
    state_.progress.step = StepId(0);
    main_ = std::thread([this] { run_main(); });
    loop_ = std::thread([this] { run_loop(); });
  }
  ~EchoServer() {
    stop_ = true;
    if (main_.joinable()) main_.join();
    if (loop_.joinable()) loop_.join();
  }
  EchoServer(const EchoServer&) = delete;
  EchoServer& operator=(const EchoServer&) = delete;

  [[nodiscard]] const transport::ServerTransport& transport() const { return *transport_; }
  /// Changes the world between two ticks. What a hand is answered stays as it is set here, but for f and the echo.
  void change(const std::function<void(state::WorldState&)>& how) {
    const std::lock_guard lock(state_mutex_);
    how(state_);
  }
  /// How many programs it knows.
  [[nodiscard]] std::size_t sessions() const { return sessions_; }
  /// As if no client had been heard for longer than a session lives. Reports that wait are taken first: on a busy machine one waits at
  /// each look, and the client's session would live on.
  void forget_sessions() { forget_ = true; }
  /// Every sample that the loop saw, newest last (the first 100 000).
  [[nodiscard]] std::vector<hand::SentSample> samples() const {
    const std::lock_guard lock(mutex_);
    return samples_;
  }
  /// What visitors have answered.
  [[nodiscard]] std::vector<state::VisitAnswer> answers() const {
    const std::lock_guard lock(mutex_);
    return answers_;
  }
  /// What displays have told, by its place in the description.
  [[nodiscard]] std::vector<std::uint32_t> languages() const {
    const std::lock_guard lock(mutex_);
    return languages_;
  }
  [[nodiscard]] std::vector<transport::NewsKind> news() const {
    const std::lock_guard lock(mutex_);
    return news_;
  }

 private:
  void run_main() {
    realtime::Wakeup never;
    while (!stop_) {
      for (const transport::News& n : transport_->poll(std::chrono::steady_clock::now()))
        handle(n);
      if (forget_) {
        const TimePoint later = std::chrono::steady_clock::now() + proto::kKioskLiveliness + std::chrono::seconds(1);
        for (const transport::News& n : transport_->poll(later)) {
          if (n.kind == transport::NewsKind::session_left) forget_ = false;
          handle(n);
        }
      }
      sessions_ = transport_->sessions().sessions().size();
      while (const auto answer = port_->take_answer()) {
        const std::lock_guard lock(mutex_);
        answers_.push_back(*answer);
      }
      if (const auto language = port_->take_language()) {
        const std::lock_guard lock(mutex_);
        languages_.push_back(*language);
      }
      never.wait(std::chrono::milliseconds(10));
    }
  }

  void handle(const transport::News& n) {
    const std::lock_guard lock(mutex_);
    news_.push_back(n.kind);
    switch (n.kind) {
      case transport::NewsKind::kiosk_appeared:
        transport_->assign_kiosk(n.session.kiosk, *port_);
        break;
      case transport::NewsKind::hand_granted:
        EXPECT_TRUE(port_->bind_user(port_->free_slot(), n.session.kiosk, n.session.user, n.session.id));
        break;
      case transport::NewsKind::hand_freed:
        port_->unbind_user(port_->slot_of(n.session.id));
        break;
      default:
        break;
    }
  }

  void run_loop() {
    SystemClock clock;
    state::TickInputs inputs;
    TimePoint next = clock.now();
    while (!stop_) {
      next += kTickPeriod;
      clock.sleep_until(next);  // sleeps: the pace
      const std::lock_guard lock(state_mutex_);
      port_->gather(inputs, clock.now());
      tick(inputs);
    }
  }

  void tick(const state::TickInputs& inputs) {
    ++state_.tick;
    state_.event_count = 0;
    state_.bodies[1].X_WB.p.x() = static_cast<double>(state_.tick) * 1e-3;  // 1 m/s
    for (std::size_t i = 0; i < inputs.users.size(); ++i) {
      const state::UserInput& input = inputs.users[i];
      state::UserState& user = state_.users[i];
      if (!input.present) user.present = false;
      user.age = input.age;
      if (!input.fresh) continue;
      user.present = true;
      user.sample = input.sample;
      user.X_WS[0] = input.sample.X_WH;
      user.output.echo_sequence = input.sample.sequence;
      user.output.echo_sent_ns = input.sample.sent_ns;
      user.output.force_W.f = input.sample.X_WH.p;
      const std::lock_guard lock(mutex_);
      if (samples_.size() < 100'000) samples_.push_back(input.sample);
    }
    for (std::uint32_t i = 0; i < inputs.command_count; ++i) {
      state_.emit(state::EventKind::command_done, 0xffffffffu, 0xffffffffu, static_cast<double>(inputs.commands[i].id));
    }
    port_->publish_forces(state_);
    std::array<Vec3, hand::kMaxUsers> shown_W;
    shown_W.fill(kShown_W);
    port_->publish(state_, shown_W);
  }

  std::unique_ptr<transport::ServerTransport> transport_;
  transport::WorldPort* port_ = nullptr;
  std::mutex state_mutex_;
  state::WorldState state_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> forget_{false};
  std::atomic<std::size_t> sessions_{0};
  mutable std::mutex mutex_;
  std::vector<hand::SentSample> samples_;
  std::vector<transport::NewsKind> news_;
  std::vector<state::VisitAnswer> answers_;
  std::vector<std::uint32_t> languages_;
  std::thread main_;
  std::thread loop_;
};

/// Looks for `wanted` until it is there, at most `timeout`; `between` is done before each look.
inline bool eventually(const std::function<bool()>& wanted, Duration timeout = std::chrono::seconds(10),
                       const std::function<void()>& between = {}) {
  realtime::Wakeup never;
  const TimePoint deadline = std::chrono::steady_clock::now() + timeout;
  while (std::chrono::steady_clock::now() < deadline) {
    if (between) between();
    if (wanted()) return true;
    never.wait(std::chrono::milliseconds(1));
  }
  return false;
}

[[nodiscard]] inline std::unique_ptr<client::Client> connect(client::Role role, const std::string& program = "tester",
                                                             std::uint32_t user = 0,
                                                             const std::string& kiosk = "kiosk-1",
                                                             double deadband = 0) {
  auto made = client::Client::connect(
      {.kiosk = kiosk, .user = user, .role = role, .program = program, .domain = kClientDomain, .deadband = deadband});
  if (!made) {
    ADD_FAILURE() << made.error().to_string();
    return nullptr;
  }
  return std::move(*made);
}

/// Both domains without loss.
class Loopback : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(server_domain_.good());
    ASSERT_TRUE(client_domain_.good());
  }
  LoopbackDomain server_domain_{kServerDomain, 0};
  LoopbackDomain client_domain_{kClientDomain, 0};
};

[[nodiscard]] inline client::HandSample hand_at(const Vec3& p) {
  client::HandSample input;
  input.X_WH.p = p;
  return input;
}

/// Sends until a force answers a sample sent now.
[[nodiscard]] inline bool feels(client::Client& client, const Vec3& p) {
  return eventually([&] {
    client.send(hand_at(p));
    const auto force = client.wait_force(std::chrono::milliseconds(50));
    return force && (force->force_W.f - p).norm() < 1e-6;
  });
}

}  // namespace mechane::test
