// The report of every benchmark about its samples: median, p99, p99.9, max, and the curve of quantiles for a plot.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "server/base/clock.hpp"

namespace mechane::benchmark {

/// Durations, kept one by one: room is made before the run, so that adding one allocates nothing.
class Samples {
 public:
  explicit Samples(std::size_t room) { us_.reserve(room); }

  /// Left out when the room is used up.
  void add(Duration took) {
    if (us_.size() == us_.capacity()) return;
    us_.push_back(to_us(took));
    sorted_ = false;
  }
  [[nodiscard]] std::size_t size() const { return us_.size(); }

  /// The sample of rank ceil(share * n), microseconds; 0 when there is none.
  [[nodiscard]] double quantile_us(double share) {
    if (us_.empty()) return 0;
    if (!sorted_) std::sort(us_.begin(), us_.end());
    sorted_ = true;
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(us_.size())));
    return us_[std::clamp<std::size_t>(rank, 1, us_.size()) - 1];
  }

 private:
  std::vector<double> us_;
  bool sorted_ = true;
};

/// What a program prints: {"metrics": {...}, "curves": {...}, "notes": [...]}.
class Report {
 public:
  Report()
      : json_{{"metrics", nlohmann::json::object()},
              {"curves", nlohmann::json::object()},
              {"notes", nlohmann::json::array()}} {}

  void metric(const std::string& name, double value) { json_["metrics"][name] = value; }
  void note(const std::string& text) { json_["notes"].push_back(text); }

  /// `name`.median, .p99, .p999, .max and .count; and its curve: pairs of (share that is slower, microseconds), as far
  /// out as there are samples.
  /// For anything with quantile_us(share) and size().
  template <class Quantiles>
  void distribution(const std::string& name, Quantiles& samples) {
    metric(name + ".median", samples.quantile_us(0.5));
    metric(name + ".p99", samples.quantile_us(0.99));
    metric(name + ".p999", samples.quantile_us(0.999));
    metric(name + ".max", samples.quantile_us(1));
    metric(name + ".count", static_cast<double>(samples.size()));
    auto& curve = json_["curves"][name];
    for (const double beyond : kShareBeyond)
      if (beyond * static_cast<double>(samples.size()) >= 1) curve.push_back({beyond, samples.quantile_us(1 - beyond)});
  }

  /// Any other line for a plot: pairs of (x, y).
  void curve(const std::string& name, const std::vector<std::array<double, 2>>& points) {
    json_["curves"][name] = points;
  }

  /// A picture: values row by row, top first; NaN where there is none. It lies among the curves.
  void rows(const std::string& name, const std::vector<std::vector<double>>& values) { json_["curves"][name] = values; }

  [[nodiscard]] std::string text() const { return json_.dump(); }

 private:
  /// From the fastest to one in ten thousand, evenly on a logarithmic scale of what lies beyond.
  static constexpr std::array<double, 17> kShareBeyond{0.999, 0.99, 0.9,  0.75,  0.5,   0.3,   0.2,   0.1,   0.05,
                                                       0.03,  0.02, 0.01, 0.005, 0.003, 0.002, 0.001, 0.0001};

  nlohmann::json json_;
};

}  // namespace mechane::benchmark
