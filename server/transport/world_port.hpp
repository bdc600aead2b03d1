// WorldPort: connects one world's loop with the network. What the loop calls is wait-free and does not call DDS.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "server/realtime/mailbox.hpp"
#include "server/realtime/ring.hpp"
#include "server/state/description.hpp"
#include "server/state/input.hpp"
#include "server/state/visit_answer.hpp"
#include "server/state/world_state.hpp"

namespace mechane::transport {

class HapticPublisher;
struct HandChannel;

/// Whose hand is in a slot of a world, for displays.
struct SlotName {
  std::array<char, 32> kiosk{};
  std::uint32_t user = 0;
  std::uint64_t session = 0;
};

/// One hand, as a frame shows it.
struct HandSnapshot {
  bool present = false;
  bool stale = false;
  bool holding = false;
  hand::HandKind kind = hand::HandKind::one_point;
  SlotName name;
  std::array<Pose, hand::kHandSegments> X_WS{};
  Vec3 f_W = Vec3::Zero();
};

/// What displays and status need from one tick. Its vectors are sized once.
struct SceneSnapshot {
  std::uint64_t tick = 0;
  std::uint64_t sampled_ns = 0;
  std::vector<Pose> bodies;
  std::vector<std::uint8_t> visible;
  std::vector<double> quantities;
  std::vector<std::uint8_t> agent_enabled;
  state::Progress progress;
  std::array<HandSnapshot, hand::kMaxUsers> hands{};
  std::array<state::Coupling, state::kMaxShownRopes> ropes{};  ///< the first ropes of the world
  std::size_t rope_count = 0;
};

/// Made and owned by ServerTransport. The main thread binds users; one loop thread gathers and publishes.
class WorldPort {
 public:
  /// Ticks between two frames: 62.5 frames a second.
  static constexpr std::uint64_t kTicksPerFrame = 16;
  static constexpr std::size_t kEventCapacity = 1024;
  static constexpr std::size_t kCommandCapacity = 64;

  /// Makes a channel for a hand, and gives it to the kiosk's listener and to the publisher. Null when the kiosk is gone.
  using OpenChannel =
      std::function<std::shared_ptr<HandChannel>(const std::string& kiosk, std::uint32_t user, std::uint64_t session)>;
  /// Takes a channel from the listener and the publisher.
  using CloseChannel = std::function<void(const std::shared_ptr<HandChannel>&)>;

  WorldPort(std::string world, std::shared_ptr<const state::WorldDescription> description, HapticPublisher& haptic,
            OpenChannel open_channel, CloseChannel close_channel);
  /// The loop must not use the port any more.
  ~WorldPort();
  WorldPort(const WorldPort&) = delete;
  WorldPort& operator=(const WorldPort&) = delete;

  // Main thread.
  [[nodiscard]] const std::string& world() const { return world_; }
  [[nodiscard]] const state::WorldDescription& description() const { return *description_; }
  /// Gives a slot (0 .. kMaxUsers - 1) to a session's hand; the loop sees it in its next gather(). A slot in use is freed first.
  /// False when the kiosk is gone.
  bool bind_user(std::size_t slot, const std::string& kiosk, std::uint32_t user, std::uint64_t session);
  void unbind_user(std::size_t slot);
  /// The slot of this session's hand; kMaxUsers when it has none.
  [[nodiscard]] std::size_t slot_of(std::uint64_t session) const;
  /// A free slot; kMaxUsers when all are taken.
  [[nodiscard]] std::size_t free_slot() const;
  /// The newest request from a kiosk of this world: the scenario to go on to, as its number in ServerTransport::scenario().
  [[nodiscard]] std::optional<std::uint32_t> take_request();
  /// The next answer of a visitor, in the order in which they came.
  [[nodiscard]] std::optional<state::VisitAnswer> take_answer();
  /// The newest language that a display has reported, as its index in the description's languages.
  [[nodiscard]] std::optional<std::uint32_t> take_language();
  /// From now on no hand is in the world, for good: the loop sends the hands that were there their way to no force.
  void retreat() noexcept { retreating_.store(true, std::memory_order_release); }
  /// Whether hands are gone, by retreat() or let_through(), and the last forces that were sent are zero. Also for the loop.
  [[nodiscard]] bool forces_are_zero() const noexcept { return at_rest_.load(std::memory_order_acquire); }
  /// Releases channels that the loop has stopped using. ServerTransport::poll() calls it.
  void collect();

  /// What a loop lets through between its worlds and their hands.
  struct Passage {
    bool hands = true;   ///< false: hands are seen as gone
    bool forces = true;  ///< false: devices get no force and no contacts, whatever their hands do
    friend bool operator==(const Passage&, const Passage&) = default;
  };

  // Loop thread: wait-free, no allocation, no DDS.
  /// From now on.
  void let_through(const Passage& passage) noexcept { passage_ = passage; }
  /// Fills all of `inputs`: for each slot the newest sample with its age on our clock, and the commands that came (at most
  /// kMaxCommandsPerTick in a tick; the rest wait for the next one). A fresh sample wakes the haptic publisher, so that it is ready when
  /// the forces are.
  void gather(state::TickInputs& inputs, TimePoint now) noexcept;
  /// Sends the forces to their devices at once. At most one futex wake, together with gather()'s.
  void publish_forces(const state::WorldState& state) noexcept;
  /// Whether publish() makes a snapshot of such a tick.
  [[nodiscard]] static bool shows(std::uint64_t tick) noexcept { return tick % kTicksPerFrame == 1; }
  /// Publishes all events, and every 16th tick a snapshot for displays. `shown_W`: in W, by user, how far beside its place a hand is shown.
  void publish(const state::WorldState& state, std::span<const Vec3> shown_W = {}) noexcept;
  /// Instead of a tick, in a period in which the world stands still: hands are answered as in a tick, and displays are shown the scene as
  /// it is as often as otherwise. Samples that come are fresh for the next tick; commands wait for it.
  void hold(const state::WorldState& state, TimePoint now, std::span<const Vec3> shown_W = {}) noexcept;

  // For other threads of the transport, each function for the one named.
  bool offer_command(const state::Command& command) noexcept { return commands_.push(command); }  ///< command listener
  bool offer_request(std::uint32_t scenario) noexcept { return requests_.push(scenario); }        ///< command listener
  bool offer_answer(const state::VisitAnswer& answer) noexcept { return answers_.push(answer); }  ///< command listener
  bool offer_language(std::uint32_t language) noexcept { return languages_.push(language); }      ///< command listener
  [[nodiscard]] const SceneSnapshot* take_snapshot() noexcept { return snapshots_.take(); }       ///< scene publisher
  bool take_event(state::Event& out) noexcept { return events_.pop(out); }                        ///< scene publisher
  [[nodiscard]] std::uint64_t events_lost() const noexcept { return events_lost_.load(std::memory_order_relaxed); }

 private:
  /// What the loop knows about the slots; replaced as a whole.
  struct Bindings {
    std::uint64_t generation = 0;
    std::array<HandChannel*, hand::kMaxUsers> channels{};
    std::array<SlotName, hand::kMaxUsers> names{};
  };
  struct Retired {
    std::uint64_t generation = 0;  // of the first bindings without the channel
    std::shared_ptr<HandChannel> channel;
  };

  void hand_over_bindings();
  void take_bindings() noexcept;
  void take_samples(TimePoint now) noexcept;
  void publish_snapshot(const state::WorldState& state, std::span<const Vec3> shown_W) noexcept;

  // For the main thread.
  std::string world_;
  std::shared_ptr<const state::WorldDescription> description_;
  OpenChannel open_channel_;
  CloseChannel close_channel_;
  std::array<std::shared_ptr<HandChannel>, hand::kMaxUsers> channels_;
  Bindings wanted_;
  std::vector<Retired> retired_;

  // Between threads.
  HapticPublisher& haptic_;
  realtime::Mailbox<Bindings> bindings_;
  std::atomic<std::uint64_t> generation_in_use_{0};
  realtime::Mailbox<SceneSnapshot> snapshots_;
  realtime::Ring<state::Event> events_{kEventCapacity};
  realtime::Ring<state::Command> commands_{kCommandCapacity};
  realtime::Ring<std::uint32_t> requests_{8};
  realtime::Ring<state::VisitAnswer> answers_{64};
  realtime::Ring<std::uint32_t> languages_{8};
  std::atomic<std::uint64_t> events_lost_{0};
  std::atomic<bool> retreating_{false};
  std::atomic<bool> at_rest_{false};

  // For the loop thread.
  Bindings current_;
  std::array<state::UserInput, hand::kMaxUsers> users_{};
  std::array<TimePoint, hand::kMaxUsers> arrived_{};
  TimePoint now_{};
  Passage passage_;
  bool retreats_ = false;          ///< in this tick
  std::uint64_t unseen_held_ = 0;  ///< periods held since the last snapshot
};

}  // namespace mechane::transport
