#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client-sdk/visitor/visit_session.hpp"

namespace mechane::visitor {
namespace {

using Json = nlohmann::json;

TEST(VisitReport, holds_no_figure_that_was_not_measured) {
  VisitReport report;
  Json json = Json::parse(to_json(report));
  EXPECT_FALSE(json.contains("water_l"));
  EXPECT_EQ(json["force_n"], Json::object({{"ticks", 0}}));
  EXPECT_TRUE(json["rtt_us"].empty());
  report.water_l = 0;
  report.loop.ticks = 10;
  report.round_trip.record(std::chrono::milliseconds(2));
  json = Json::parse(to_json(report));
  EXPECT_EQ(json["water_l"], 0);
  EXPECT_EQ(json["force_n"], Json::object({{"max", 0}, {"ticks", 0}}));
  EXPECT_NEAR(json["rtt_us"]["median"].get<double>(), 2000, 20);
  report.loop.ticks_with_force = 2;
  report.loop.force_sum_n = 3;
  EXPECT_EQ(Json::parse(to_json(report))["force_n"]["mean"], 1.5);
}

TEST(VisitReport, tells_how_long_the_motors_were_spared) {
  VisitReport report;
  report.activities.emplace_back().warm_share = 0.25;
  EXPECT_EQ(Json::parse(to_json(report))["activities"][0]["warm_share"], 0.25);
}

}  // namespace
}  // namespace mechane::visitor
