// Plays an exhibit's own scripted visit in process: the visitor's player, a simulated device and its haptic loop against world::step, no
// network, as fast as the machine can. The hand has what a networked one has: samples of one user, answers a millisecond later, a command
// that starts the activity, and looks at the scene at the rate of its frames. It has no other way to move things. Another person may play
// in its place: one with a pointer, see pointer_play.hpp.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/virtual_hand.hpp"
#include "client-sdk/visitor/visit_player.hpp"
#include "server/state/world_state.hpp"
#include "server/world/world.hpp"

namespace mechane::test {

/// Who plays a visit with the first hand.
class Person {
 public:
  virtual ~Person() = default;
  /// Puts in what the person gives to this tick. Until `sets_out`, the person has not reacted to the activity's start yet.
  virtual void act(bool sets_out, state::TickInputs& inputs) = 0;
  /// What the tick answered.
  virtual void see(const state::WorldState& state) = 0;
  [[nodiscard]] virtual bool finished() const = 0;
  [[nodiscard]] virtual std::span<const visitor::MoveResult> results() const = 0;
  /// Of the device's loop, where there is one.
  [[nodiscard]] virtual haptic::LoopStats stats() const { return {}; }
};

struct PlayOptions {
  /// Changes a copy of the description before the world is made: a rope cut, a valve turned round, a gear taken away.
  std::function<void(state::WorldDescription&)> change{};
  /// Called before each tick with what it takes in: fed to step() again, it gives the same visit.
  std::function<void(const state::TickInputs&)> record{};
  /// Called after each tick, to look.
  std::function<void(const state::WorldState&)> watch{};
  double patience_s = 5;  ///< world seconds after the last move in which the activity may still be done
  visitor::PlayerConfig player{};
  haptic::VirtualChoice device{};  ///< a stylus of the Phantom's class, held by a hand
  /// Makes another person, who needs no device; what it is given outlives it. Empty: one with the device above.
  std::function<std::unique_ptr<Person>(const state::WorldDescription&, const state::VisitDescription&)> make_person{};
};

struct PlayedStep {
  std::string name;
  double seconds = 0;  ///< of the world's time
  bool done = false;   ///< left by one of its triggers
};

struct PlayedVisit {
  bool done = false;              ///< the activity came to its end
  std::string stopped_at;         ///< the step where it stands; empty when done
  std::vector<PlayedStep> steps;  ///< in the order that they began
  std::vector<visitor::MoveResult> moves;
  std::map<std::string, double> quantities;  ///< at the end
  double seconds = 0;                        ///< of the world's time, from the activity's start to the hand's last move
  double warm_share = 0;  ///< of the ticks, in which the force was lowered to spare the device's motors
  std::uint64_t state_hash = 0;
  double tick_us_median = 0;  ///< of this machine's time; not in the hash
};

/// For a failed test's message: the steps with their times, the moves that went wrong, the quantities.
std::ostream& operator<<(std::ostream& out, const PlayedVisit& visit);

/// One shipped scenario, read once: its parts come from the cache after the first time.
class Exhibit {
 public:
  /// `name` is its folder's and its file's. Throws std::runtime_error where it cannot be read.
  explicit Exhibit(const std::string& name);
  /// One that was read elsewhere.
  Exhibit(std::shared_ptr<const state::WorldDescription> description, world::WorldConfig config);

  /// Plays one visit in a new world. Throws std::runtime_error where there is no such visit, or the world cannot be made.
  [[nodiscard]] PlayedVisit play(const std::string& visit, const PlayOptions& options = {}) const;
  /// The same in a world that was changed: see PlayOptions::change.
  [[nodiscard]] PlayedVisit play_changed(const std::string& visit,
                                         std::function<void(state::WorldDescription&)> change) const;
  /// The same by a glove, where play() has a stylus.
  [[nodiscard]] PlayedVisit play_with_glove(const std::string& visit) const;
  [[nodiscard]] const state::WorldDescription& description() const { return *description_; }
  /// A quantity's value. Throws std::out_of_range where there is none of this name.
  [[nodiscard]] double value(const state::WorldState& state, const std::string& quantity) const;

 private:
  std::shared_ptr<const state::WorldDescription> description_;
  world::WorldConfig config_;
};

/// Changes for PlayOptions::change. Each throws std::runtime_error where the name is not there, so that a test cannot break
/// something that does not exist.

/// The agent stays off in every step: a rope cut, a pawl lifted off, a joint undone.
void switch_off(state::WorldDescription& world, const std::string& agent);
/// Gives an agent or a machine another value of a parameter. One that its type does not know fails when the world is made.
void set_parameter(state::WorldDescription& world, const std::string& component, const std::string& parameter,
                   const state::Parameter& value);
/// Cannot be seen, grasped or touched, nothing moves it, and it lies under the floor: as if it were not there. A joint or tie of its
/// own is switched off apart.
void take_away(state::WorldDescription& world, const std::string& body);
/// take_away, and nothing of what held the part: those agents are switched off.
void lose(state::WorldDescription& world, const std::string& part,
          const std::vector<std::string>& joints_and_ties = {});

/// A grasp that caught nothing, a carry with an empty hand.
[[nodiscard]] inline bool went_wrong(const visitor::MoveResult& move) {
  return !move.ok;
}

}  // namespace mechane::test
