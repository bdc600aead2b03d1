#include "server/transport/world_port.hpp"

#include <algorithm>

#include "server/base/assert.hpp"
#include "server/transport/hand_channel.hpp"
#include "server/transport/haptic_publisher.hpp"
#include <mechane/proto/names.hpp>

namespace mechane::transport {
namespace {

// The age of a hand that never sent: beyond every limit, and far from an overflow.
constexpr Duration kNeverHeard = std::chrono::hours(24);

SceneSnapshot sized_for(const state::WorldDescription& world) {
  SceneSnapshot s;
  s.bodies.resize(world.bodies.size());
  s.visible.resize(world.bodies.size());
  s.quantities.resize(world.quantities.size());
  s.agent_enabled.resize(world.agents.size());
  return s;
}

template <class T>
void copy_all(const std::vector<T>& from, std::vector<T>& to) noexcept {
  std::copy_n(from.begin(), std::min(from.size(), to.size()), to.begin());
}

HandSnapshot snapshot_of(const state::UserState& user, const SlotName& name) noexcept {
  HandSnapshot hand;
  hand.name = name;
  hand.present = user.present;
  if (!user.present) return hand;
  hand.stale = user.stale;
  hand.holding = user.output.holding;
  hand.kind = user.sample.kind;
  hand.X_WS = user.X_WS;
  hand.f_W = user.output.force_W.f;
  return hand;
}

bool is_zero(const hand::HandForce& force) noexcept {
  return force.force_W.f.isZero(0) && force.force_W.t.isZero(0) &&
         std::ranges::all_of(force.finger_force_n, [](double n) { return n == 0; });
}

/// What a hand is told that is to feel nothing: whether it holds something, and that its newest sample has come. Its clicks are counted on,
/// so that none is late.
hand::HapticOutput without_force(const hand::HapticOutput& output, const hand::SentSample& newest) noexcept {
  hand::HapticOutput quiet;
  quiet.echo_sequence = newest.sequence;
  quiet.echo_sent_ns = newest.sent_ns;
  quiet.holding = output.holding;
  quiet.clicks.count = output.clicks.count;
  return quiet;
}

}  // namespace

WorldPort::WorldPort(std::string world, std::shared_ptr<const state::WorldDescription> description,
                     HapticPublisher& haptic, OpenChannel open_channel, CloseChannel close_channel)
    : world_(std::move(world)),
      description_(std::move(description)),
      open_channel_(std::move(open_channel)),
      close_channel_(std::move(close_channel)),
      haptic_(haptic),
      snapshots_([this] { return sized_for(*description_); }) {}

WorldPort::~WorldPort() {
  for (const auto& channel : channels_) {
    if (channel) close_channel_(channel);
  }
}

bool WorldPort::bind_user(std::size_t slot, const std::string& kiosk, std::uint32_t user, std::uint64_t session) {
  MECHANE_ASSERT(slot < channels_.size());
  if (channels_[slot]) unbind_user(slot);
  channels_[slot] = open_channel_(kiosk, user, session);
  if (!channels_[slot]) return false;
  wanted_.channels[slot] = channels_[slot].get();
  SlotName& name = wanted_.names[slot];
  name = SlotName{};
  std::copy_n(kiosk.begin(), std::min(kiosk.size(), name.kiosk.size() - 1), name.kiosk.begin());
  name.user = user;
  name.session = session;
  hand_over_bindings();
  return true;
}

void WorldPort::unbind_user(std::size_t slot) {
  MECHANE_ASSERT(slot < channels_.size());
  if (!channels_[slot]) return;
  close_channel_(channels_[slot]);
  wanted_.channels[slot] = nullptr;
  wanted_.names[slot] = SlotName{};
  hand_over_bindings();
  retired_.push_back({wanted_.generation, std::move(channels_[slot])});
}

void WorldPort::hand_over_bindings() {
  ++wanted_.generation;
  bindings_.publish(wanted_);
}

std::size_t WorldPort::slot_of(std::uint64_t session) const {
  const auto it =
      std::find_if(channels_.begin(), channels_.end(), [&](const auto& c) { return c && c->session == session; });
  return static_cast<std::size_t>(it - channels_.begin());
}

std::size_t WorldPort::free_slot() const {
  return static_cast<std::size_t>(std::find(channels_.begin(), channels_.end(), nullptr) - channels_.begin());
}

std::optional<std::uint32_t> WorldPort::take_request() {
  std::optional<std::uint32_t> newest;
  for (std::uint32_t scenario = 0; requests_.pop(scenario);)
    newest = scenario;
  return newest;
}

std::optional<std::uint32_t> WorldPort::take_language() {
  std::optional<std::uint32_t> newest;
  for (std::uint32_t language = 0; languages_.pop(language);)
    newest = language;
  return newest;
}

std::optional<state::VisitAnswer> WorldPort::take_answer() {
  state::VisitAnswer answer;
  return answers_.pop(answer) ? std::optional(answer) : std::nullopt;
}

void WorldPort::collect() {
  const std::uint64_t in_use = generation_in_use_.load(std::memory_order_acquire);
  std::erase_if(retired_, [&](const Retired& r) { return r.generation <= in_use; });
}

void WorldPort::take_bindings() noexcept {
  const Bindings* fresh = bindings_.take();
  if (fresh == nullptr) return;
  for (std::size_t i = 0; i < users_.size(); ++i) {
    if (fresh->channels[i] == current_.channels[i]) continue;
    users_[i] = state::UserInput{};
    users_[i].present = fresh->channels[i] != nullptr;
    users_[i].age = kNeverHeard;
    arrived_[i] = now_ - kNeverHeard;
  }
  current_ = *fresh;
  generation_in_use_.store(current_.generation, std::memory_order_release);
}

void WorldPort::take_samples(TimePoint now) noexcept {
  now_ = now;
  retreats_ = retreating_.load(std::memory_order_acquire) || !passage_.hands;
  take_bindings();
  bool any_fresh = false;
  for (std::size_t i = 0; i < users_.size(); ++i) {
    if (current_.channels[i] == nullptr) continue;
    state::UserInput& user = users_[i];
    if (const ArrivedSample* sample = current_.channels[i]->inputs.take()) {
      user.fresh = any_fresh = true;
      user.sample = sample->sample;
      arrived_[i] = sample->arrived;
    }
    user.age = std::max(now - arrived_[i], Duration{0});
  }
  if (any_fresh) haptic_.expect_forces();
}

void WorldPort::gather(state::TickInputs& inputs, TimePoint now) noexcept {
  take_samples(now);
  for (std::size_t i = 0; i < users_.size(); ++i) {
    inputs.users[i] = users_[i];
    users_[i].fresh = false;
    // The journal has it so, too: a hand that leaves, which the governor ramps down.
    if (retreats_) inputs.users[i].present = inputs.users[i].fresh = false;
  }
  inputs.command_count = 0;
  while (inputs.command_count < inputs.commands.size() && commands_.pop(inputs.commands[inputs.command_count])) {
    ++inputs.command_count;
  }
}

void WorldPort::publish_forces(const state::WorldState& state) noexcept {
  bool any_force = false;
  bool all_zero = true;
  for (std::size_t i = 0; i < current_.channels.size(); ++i) {
    const state::UserState& user = state.users[i];
    if (current_.channels[i] == nullptr || (!user.present && !retreats_)) continue;
    OutgoingForce& out = current_.channels[i]->forces.writable();
    out.output = passage_.forces ? user.output : without_force(user.output, users_[i].sample);
    out.p_WH = user.present ? user.X_WH.p : users_[i].sample.X_WH.p;
    out.tick = state.tick;
    out.waited = user.present ? user.age : users_[i].age;
    all_zero = all_zero && is_zero(user.output);
    current_.channels[i]->forces.commit();
    any_force = true;
  }
  if (any_force) haptic_.forces_are_ready();
  at_rest_.store(retreats_ && all_zero, std::memory_order_release);
}

void WorldPort::publish(const state::WorldState& state, std::span<const Vec3> shown_W) noexcept {
  for (const state::Event& event : state.event_span()) {
    if (!events_.push(event)) events_lost_.fetch_add(1, std::memory_order_relaxed);
  }
  if (shows(state.tick)) publish_snapshot(state, shown_W);
}

void WorldPort::hold(const state::WorldState& state, TimePoint now, std::span<const Vec3> shown_W) noexcept {
  take_samples(now);
  publish_forces(state);
  if (++unseen_held_ >= kTicksPerFrame) publish_snapshot(state, shown_W);
}

void WorldPort::publish_snapshot(const state::WorldState& state, std::span<const Vec3> shown_W) noexcept {
  unseen_held_ = 0;
  SceneSnapshot& s = snapshots_.writable();
  s.tick = state.tick;
  s.sampled_ns = to_ns(now_);
  const std::size_t bodies = std::min(s.bodies.size(), state.bodies.size());
  for (std::size_t i = 0; i < bodies; ++i) {
    s.bodies[i] = state.bodies[i].X_WB;
    s.visible[i] = state.bodies[i].visible ? 1 : 0;
  }
  copy_all(state.quantities, s.quantities);
  copy_all(state.agent_enabled, s.agent_enabled);
  s.progress = state.progress;
  for (std::size_t i = 0; i < s.hands.size(); ++i) {
    s.hands[i] = snapshot_of(state.users[i], current_.names[i]);
    for (Pose& X_WS : s.hands[i].X_WS)
      X_WS.p += i < shown_W.size() ? shown_W[i] : Vec3(Vec3::Zero());
  }
  s.rope_count = 0;
  for (const state::Coupling& coupling : state.couplings) {
    if (coupling.kind == state::CouplingKind::rope && s.rope_count < s.ropes.size()) s.ropes[s.rope_count++] = coupling;
  }
  snapshots_.commit();
}

}  // namespace mechane::transport
