// Whether the Haply service renders the force that it was asked for. It adds up the forces of all its clients, so
// another program can put a force on the visitor's hand that Mechane never limited.
#pragma once

#include <array>
#include <cstddef>

#include "client-sdk/drivers/haply/protocol.hpp"

namespace mechane::drivers {

/// Counts in answers, of which there are 1000 a second. Allocates nothing. One thread.
class HaplyForceWatch {
 public:
  enum class Verdict {
    fine,
    added,   ///< for a quarter of a second a force is rendered that was not asked for
    ignored  ///< forces were asked for, and none was ever rendered: the service does not understand the command
  };

  /// A force that was sent (N).
  void asked(const HaplyVector& force_n);
  /// What the service then says that it renders (N).
  [[nodiscard]] Verdict rendered(const HaplyVector& force_n);

 private:
  // The service is a tick or two behind, and its force gate smooths: any of the last commands explains what it renders.
  static constexpr std::size_t kCommands = 4;

  std::array<HaplyVector, kCommands> commands_{};
  std::size_t next_ = 0;
  double mean_foreign_n_ = 0;
  double mean_asked_n_ = 0;
  int foreign_for_ = 0;
  int ignored_for_ = 0;
  bool rendered_any_ = false;
};

}  // namespace mechane::drivers
