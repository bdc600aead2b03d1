// How often somebody may do something: a bucket that fills steadily, and holds so much.
#pragma once

#include <algorithm>
#include <map>
#include <string>

#include "server/base/clock.hpp"

namespace mechane::gateway {

class RateLimit {
 public:
  RateLimit(double per_s, double at_once) : per_s_(per_s), at_once_(at_once), left_(at_once) {}
  /// False: too often.
  [[nodiscard]] bool take(TimePoint now) {
    left_ = std::min(at_once_, left_ + per_s_ * std::max(0.0, to_seconds(now - last_)));
    last_ = now;
    if (left_ < 1) return false;
    left_ -= 1;
    return true;
  }
  [[nodiscard]] bool full(TimePoint now) const { return left_ + per_s_ * to_seconds(now - last_) >= at_once_; }

 private:
  double per_s_, at_once_, left_;
  TimePoint last_;
};

/// A limit for each name, such as an address. What is full again is forgotten.
class RateLimits {
 public:
  RateLimits(double per_s, double at_once) : fresh_(per_s, at_once) {}
  [[nodiscard]] bool take(const std::string& name, TimePoint now) {
    if (limits_.size() > kMost) std::erase_if(limits_, [now](const auto& entry) { return entry.second.full(now); });
    return limits_.try_emplace(name, fresh_).first->second.take(now);
  }

 private:
  static constexpr std::size_t kMost = 1000;
  RateLimit fresh_;
  std::map<std::string, RateLimit> limits_;
};

}  // namespace mechane::gateway
