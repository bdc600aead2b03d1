// Farewell: how a world ends whose exhibit was replaced or retired.
#pragma once

#include <optional>

#include "server/base/clock.hpp"

namespace mechane::app {

/// What is seen of such a world.
struct FarewellFacts {
  bool clients = false;      ///< a program of one of its kiosks is connected
  bool visit = false;        ///< a visit is in progress
  bool forces_zero = false;  ///< after let_go: the last forces that were sent are zero
};

enum class FarewellStep {
  wait,
  let_go,  ///< its hands' forces go to zero from now on
  leave    ///< its kiosks go on, and it closes
};

/// Nobody there: it ends at once. A visit finishes, and whoever made it has time to read its end and to answer its questions. Where
/// somebody is in a hurry, the visit ends. In any case the hands are let go first. One thread.
class Farewell {
 public:
  static constexpr Duration kAfterVisit = std::chrono::seconds(20);
  /// The governor's ramp takes a tenth of this; a loop that has stopped sends no forces at all.
  static constexpr Duration kForcesZeroBy = std::chrono::seconds(1);

  /// Visits in progress end, too.
  void hurry() { hurried_ = true; }
  [[nodiscard]] bool hurried() const { return hurried_; }
  /// What to do now. Call it regularly.
  [[nodiscard]] FarewellStep look(const FarewellFacts& facts, TimePoint now) {
    if (!facts.clients) return FarewellStep::leave;
    if (let_go_at_) {
      const bool over = facts.forces_zero || now - *let_go_at_ >= kForcesZeroBy;
      return over ? FarewellStep::leave : FarewellStep::wait;
    }
    if (facts.visit) last_visit_ = now;
    if (!hurried_ && last_visit_ && now - *last_visit_ < kAfterVisit) return FarewellStep::wait;
    let_go_at_ = now;
    return FarewellStep::let_go;
  }

 private:
  bool hurried_ = false;
  std::optional<TimePoint> last_visit_;
  std::optional<TimePoint> let_go_at_;
};

}  // namespace mechane::app
