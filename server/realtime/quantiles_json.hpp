// How reports write a histogram.
#pragma once

#include <nlohmann/json.hpp>

#include "server/realtime/histogram.hpp"

namespace mechane::realtime {

/// Median, p99, p999 and max in microseconds; an empty object where nothing was measured. Any thread.
[[nodiscard]] inline nlohmann::json quantiles_json(const LatencyHistogram& h) {
  if (h.count() == 0) return nlohmann::json::object();
  return {{"median", to_us(h.quantile(0.5))},
          {"p99", to_us(h.quantile(0.99))},
          {"p999", to_us(h.quantile(0.999))},
          {"max", to_us(h.max())}};
}

}  // namespace mechane::realtime
