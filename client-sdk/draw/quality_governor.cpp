#include "client-sdk/draw/quality_governor.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace mechane::draw {
namespace {

/// What a full picture of a village takes is about a hundred times a million pixels of sky.
constexpr double kHighMost_ms = 0.5;
constexpr double kMediumMost_ms = 2;
/// The steps of `auto`: where `medium` is too slow, so is `low`.
constexpr std::array<Quality, 3> kSteps{Quality::high, Quality::medium, Quality::cached};

}  // namespace

Quality quality_for(const DrawingSpeed& speed) {
  if (speed.megapixel_ms <= kHighMost_ms) return Quality::high;
  return speed.megapixel_ms <= kMediumMost_ms ? Quality::medium : Quality::cached;
}

void QualityGovernor::step(Quality to) {
  quality_ = to;
  ignored_ = 0;
  ms_.clear();
  short_since_.reset();
}

Quality QualityGovernor::drawn(double ms, TimePoint now) {
  if (ignored_ < kIgnored) {
    ++ignored_;
    return quality_;
  }
  ms_.push_back(ms);
  if (ms_.size() < kJudged) return quality_;
  std::ranges::nth_element(ms_, ms_.begin() + kJudged / 2);
  const double median_ms = ms_[kJudged / 2];
  ms_.clear();
  const auto* at = std::ranges::find(kSteps, quality_);
  if (median_ms > kTooLong * allowed_ms_ && at + 1 < kSteps.end()) {
    if (std::exchange(rose_, false)) wait_ = std::min<Duration>(2 * wait_, kLongestWait);
    step(*(at + 1));
  } else if (median_ms > kShort * allowed_ms_ || at == kSteps.begin()) {
    short_since_.reset();
  } else if (!short_since_) {
    short_since_ = now;
  } else if (now - *short_since_ >= wait_) {
    rose_ = true;
    step(*(at - 1));
  }
  return quality_;
}

}  // namespace mechane::draw
