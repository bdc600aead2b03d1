// The hand with which a session's visits are played over the network: in a simulated device, or a mouse before a display's picture.
#pragma once

#include <memory>
#include <span>

#include "client-sdk/visitor/visit_session.hpp"

namespace mechane::visitor {

/// What a visitor sees of the world, as often as frames come. Borrowed for the call.
struct SeenWorld {
  const client::Frame& frame;
  const client::WorldStatus* status;  ///< null while it is not known
  std::span<const Pose> X_WB;         ///< in the order of the description
};

/// On the session's thread.
class SessionHand {
 public:
  virtual ~SessionHand() = default;
  /// Another visit, which must outlive it: the hand goes to where it begins, and waits.
  virtual void begin(const state::VisitDescription& visit) = 0;
  /// What the visitor does in a millisecond of the visit; then tick().
  virtual void act(const SeenWorld& seen) = 0;
  /// Call it every millisecond.
  virtual void tick(TimePoint now) = 0;
  /// The visitor is shown another step.
  virtual void note_step() = 0;
  /// After the visit's last move: makes those of this step again.
  virtual void try_step_again() = 0;
  /// The visit's moves have all been made.
  [[nodiscard]] virtual bool finished() const = 0;
  /// Of the visit's moves so far.
  [[nodiscard]] virtual std::span<const MoveResult> results() const = 0;
  /// Call it every millisecond at the end, until it returns true: then no force is rendered.
  [[nodiscard]] virtual bool release(TimePoint now) = 0;
  /// Of the device's loop, where there is one.
  [[nodiscard]] virtual haptic::LoopStats stats() const { return {}; }
  [[nodiscard]] virtual realtime::LatencyHistogram round_trip() const { return {}; }
};

/// What is given must outlive the hand. Errors: of a device.
[[nodiscard]] Expected<std::unique_ptr<SessionHand>> make_session_hand(const VisitOptions& options,
                                                                       const state::WorldDescription& world,
                                                                       client::Client& client);

}  // namespace mechane::visitor
