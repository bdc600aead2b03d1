#include "server/machines/screw_train.hpp"

#include <algorithm>
#include <numeric>

namespace mechane::machines {

TrainFlow BucketTrain::move(double buckets) noexcept {
  buckets = std::clamp(buckets, -1.0, 1.0);
  return buckets >= 0 ? up(buckets) : down(-buckets);
}

TrainFlow BucketTrain::up(double buckets) noexcept {
  TrainFlow flow;
  while (buckets > 0) {
    const double left = 1 - phase_;  // up to the next shift
    const bool shifts = buckets >= left;
    const double part = shifts ? left : buckets;
    const double poured = shifts ? buckets_.back() : buckets_.back() * part / left;
    const double filled = volume_ * (phase_ + part);  // a bucket fills as it comes round into the river
    const double taken = std::max(0.0, filled - buckets_.front());
    buckets_.back() -= poured;
    buckets_.front() += taken;
    flow.poured += poured;
    flow.taken += taken;
    buckets -= part;
    phase_ = shifts ? 0 : phase_ + part;
    if (!shifts) break;
    std::shift_right(buckets_.begin(), buckets_.end(), 1);
    buckets_.front() = 0;
  }
  return flow;
}

TrainFlow BucketTrain::down(double buckets) noexcept {
  TrainFlow flow;
  while (buckets > 0) {
    if (phase_ <= 0) {
      std::shift_left(buckets_.begin(), buckets_.end(), 1);
      buckets_.back() = 0;
      phase_ = 1;
    }
    const double part = std::min(buckets, phase_);
    const double out = part < phase_ ? buckets_.front() * part / phase_ : buckets_.front();
    buckets_.front() -= out;
    flow.taken -= out;
    phase_ -= part;
    buckets -= part;
  }
  return flow;
}

double BucketTrain::leak(double share) noexcept {
  double leaked = 0;
  for (double& bucket : buckets_) {
    const double lost = bucket * share;
    bucket -= lost;
    leaked += lost;
  }
  return leaked;
}

double BucketTrain::content_m3() const noexcept {
  return std::accumulate(buckets_.begin(), buckets_.end(), 0.0);
}

}  // namespace mechane::machines
