#include "server/realtime/quantiles_json.hpp"

#include <gtest/gtest.h>

namespace mechane::realtime {
namespace {

TEST(QuantilesJson, AreInMicrosecondsAndMissingWhereNothingWasMeasured) {
  LatencyHistogram h;
  EXPECT_EQ(quantiles_json(h).dump(), "{}");
  h.record(std::chrono::microseconds(64));
  EXPECT_EQ(quantiles_json(h).dump(), R"({"max":64.0,"median":64.0,"p99":64.0,"p999":64.0})");
}

}  // namespace
}  // namespace mechane::realtime
