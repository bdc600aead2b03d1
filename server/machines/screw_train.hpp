// The water inside a turning screw: a train of buckets that moves up with the blades.
#pragma once

#include <cstddef>
#include <span>

namespace mechane::machines {

/// What a tick moved, m^3.
struct TrainFlow {
  double poured = 0;  ///< out of the top
  double taken = 0;   ///< in at the bottom; negative where turning back lets it out
};

/// Buckets in slots of memory: `buckets[0]` enters at the bottom, the last pours at the top, those between are whole. `phase` is
/// how far the train has moved towards the next shift, 0..1. A view: it holds nothing itself.
class BucketTrain {
 public:
  BucketTrain(std::span<double> buckets_m3, double& phase, double bucket_volume_m3)
      : buckets_(buckets_m3), phase_(phase), volume_(bucket_volume_m3) {}

  /// Moves the train by `buckets` (> 0 up, < 0 down; at most 1 either way). The bottom stands in the river, so each bucket that enters
  /// is full. Going down, nothing comes back in at the top.
  TrainFlow move(double buckets) noexcept;
  /// Every bucket loses this share; returns what is lost, m^3.
  double leak(double share) noexcept;
  [[nodiscard]] double content_m3() const noexcept;

 private:
  TrainFlow up(double buckets) noexcept;
  TrainFlow down(double buckets) noexcept;

  std::span<double> buckets_;
  double& phase_;
  double volume_;
};

}  // namespace mechane::machines
