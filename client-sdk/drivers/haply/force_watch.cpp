#include "client-sdk/drivers/haply/force_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "client-sdk/drivers/vectors.hpp"

namespace mechane::drivers {
namespace {

constexpr double kMeanOver = 100;  // answers: a second session's force comes and goes with its own ticks
constexpr double kForeignN = 0.5;
constexpr double kAskedN = 0.5;
constexpr double kNothingN = 0.02;
constexpr int kPersists = 250;

/// How much of what is rendered no part of the command explains. Less than the command is normal: the service's force
/// gate and torque scaling weaken it.
double unexplained_n(const HaplyVector& rendered, const HaplyVector& command) {
  const double squared = dot(command, command);
  const double share = squared > 0 ? std::clamp(dot(rendered, command) / squared, 0.0, 1.0) : 0.0;
  HaplyVector rest = rendered;
  for (std::size_t i = 0; i < rest.size(); ++i)
    rest[i] -= share * command[i];
  return std::sqrt(dot(rest, rest));
}

}  // namespace

void HaplyForceWatch::asked(const HaplyVector& force_n) {
  commands_[next_] = force_n;
  next_ = (next_ + 1) % kCommands;
  mean_asked_n_ += (std::sqrt(dot(force_n, force_n)) - mean_asked_n_) / kMeanOver;
}

HaplyForceWatch::Verdict HaplyForceWatch::rendered(const HaplyVector& force_n) {
  double foreign = std::numeric_limits<double>::infinity();
  for (const HaplyVector& command : commands_)
    foreign = std::min(foreign, unexplained_n(force_n, command));
  mean_foreign_n_ += (foreign - mean_foreign_n_) / kMeanOver;
  foreign_for_ = mean_foreign_n_ > kForeignN ? foreign_for_ + 1 : 0;
  rendered_any_ = rendered_any_ || dot(force_n, force_n) > kNothingN * kNothingN;
  ignored_for_ = !rendered_any_ && mean_asked_n_ > kAskedN ? ignored_for_ + 1 : 0;
  if (foreign_for_ >= kPersists) return Verdict::added;
  return ignored_for_ >= kPersists ? Verdict::ignored : Verdict::fine;
}

}  // namespace mechane::drivers
