#include "server/transport/exhibit_gate.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "server/transport/scenario_names.hpp"
#include "tests/support/scratch_folder.hpp"
#include <mechane/proto/names.hpp>

namespace mechane::transport {
namespace {

namespace fs = std::filesystem;

class ExhibitGateTest : public testing::Test {
 protected:
  proto::ExhibitKey key(const std::string& name) { return proto::ExhibitKey::read_or_make(folder_ / name).value(); }
  /// As a client with our key would send it.
  proto::ExhibitRequest sealed(std::uint64_t counter, const std::string& exhibit = "odometer",
                               std::uint32_t verb = mechane_exhibit_load) {
    proto::ExhibitRequest wire{};
    proto::set_text(wire.server, "server-1");
    wire.protocol = proto::kProtocol;
    wire.incarnation = 5;
    wire.counter = counter;
    wire.id = 1000 + counter;
    wire.verb = verb;
    proto::set_text(wire.exhibit, exhibit);
    key_.seal(wire);
    return wire;
  }

  const test::ScratchFolder scratch_;
  const fs::path folder_ = scratch_.path();
  proto::ExhibitKey key_ = key("ours.key");
  ExhibitGate gate_{key_, "server-1", 5};
  ExhibitOrder order_;
};

TEST_F(ExhibitGateTest, TakesASealedRequestOnce) {
  auto wire = sealed(1, "odometer", mechane_exhibit_replace);
  ASSERT_EQ(gate_.take(wire, order_), ExhibitFault::none);
  EXPECT_EQ(order_.verb, ExhibitVerb::replace);
  EXPECT_EQ(order_.exhibit, "odometer");
  EXPECT_FALSE(order_.now);
  EXPECT_EQ(gate_.counter(), 1U);
  EXPECT_EQ(gate_.take(wire, order_), ExhibitFault::replayed);
  for (std::uint64_t counter = 2; counter < 80; ++counter)
    ASSERT_EQ(gate_.take(sealed(counter), order_), ExhibitFault::none);
  EXPECT_EQ(gate_.take(wire, order_), ExhibitFault::late) << "its id is forgotten, its counter is not";
}

TEST_F(ExhibitGateTest, RefusesWhatWasForged) {
  auto wire = sealed(1);
  proto::set_text(wire.exhibit, "village");
  EXPECT_EQ(gate_.take(wire, order_), ExhibitFault::forged);
  wire = sealed(1);
  key("theirs.key").seal(wire);
  EXPECT_EQ(gate_.take(wire, order_), ExhibitFault::forged);
  wire = sealed(1);
  wire.counter = 2;
  EXPECT_EQ(gate_.take(wire, order_), ExhibitFault::forged) << "a replay with a new counter";
  EXPECT_EQ(order_.id, 0U) << "what is forged gets no answer";
  EXPECT_EQ(gate_.counter(), 0U);
  EXPECT_EQ(gate_.take(sealed(1), order_), ExhibitFault::none) << "and does not keep others out";
}

TEST_F(ExhibitGateTest, RefusesRequestsToOthersAndToAFormerRun) {
  auto wire = sealed(1);
  wire.protocol = proto::kProtocol - 1;
  EXPECT_EQ(gate_.take(wire, order_), ExhibitFault::not_for_us);
  ExhibitGate next_run(key_, "server-1", 6);
  EXPECT_EQ(next_run.take(sealed(1), order_), ExhibitFault::not_for_us);
  ExhibitGate another(key_, "server-2", 5);
  EXPECT_EQ(another.take(sealed(1), order_), ExhibitFault::not_for_us);
  ExhibitGate shut(std::nullopt, "server-1", 5);
  EXPECT_EQ(shut.take(sealed(1), order_), ExhibitFault::no_key);
  EXPECT_FALSE(shut.is_open());
}

TEST_F(ExhibitGateTest, RefusesBadValuesAndTellsWho) {
  EXPECT_EQ(gate_.take(sealed(1, "../etc/passwd"), order_), ExhibitFault::bad_value);
  EXPECT_EQ(order_.id, 1001U);
  EXPECT_EQ(gate_.take(sealed(2, "odometer", 3), order_), ExhibitFault::bad_value);
  EXPECT_EQ(gate_.counter(), 0U);
}

TEST(ScenarioNames, KeepANumberForEachId) {
  ScenarioNames names;
  EXPECT_FALSE(names.find(""));
  names.set({"home", "screw"});
  EXPECT_EQ(names.find(""), 0U);
  const auto screw = names.find("screw");
  ASSERT_TRUE(screw);
  names.set({"home", "odometer"});
  EXPECT_FALSE(names.find("screw")) << "it was retired";
  EXPECT_EQ(names.name(*screw), "screw") << "what is on its way still means the same";
  EXPECT_EQ(names.name(*names.find("odometer")), "odometer");
  names.set({"home", "odometer", "screw"});
  EXPECT_EQ(names.find("screw"), screw);
  for (std::size_t i = 0; i < ScenarioNames::kMost; ++i)
    names.set({"home", fmt::format("n{}", i)});
  EXPECT_FALSE(names.has_room_for("one-more"));
  EXPECT_TRUE(names.has_room_for("screw"));
}

}  // namespace
}  // namespace mechane::transport
