#include "server/app/exhibit_desk.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/app/farewell.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::app {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using transport::ExhibitOrder;
using transport::ExhibitVerb;
using namespace std::chrono_literals;

class ExhibitFiles : public testing::Test {
 protected:
  ExhibitFiles() {
    for (const char* name : {"screw", "pump"}) {
      fs::create_directories(folder_ / name);
      std::ofstream(folder_ / name / (std::string(name) + ".x3d")) << "<X3D/>";
    }
    std::ofstream(folder_ / "crane.x3d") << "<X3D/>";
    fs::create_directories(folder_ / "models");
    std::ofstream(root_ / "secret.x3d") << "<X3D/>";
    fs::create_symlink(root_ / "secret.x3d", folder_ / "secret.x3d");
    store_.put(scenario("screw"), folder_ / "screw/screw.x3d");
    store_.put(scenario("pump"), folder_ / "pump/pump.x3d");
  }
  static std::shared_ptr<const state::WorldDescription> scenario(const std::string& id, const std::string& hash = "1") {
    auto made = std::make_shared<state::WorldDescription>();
    made->id = id;
    made->content_hash = hash;
    return made;
  }
  Expected<fs::path> file_of(ExhibitVerb verb, const std::string& name) {
    return file_of_order({.id = 1, .verb = verb, .exhibit = name}, store_, folder_);
  }

  const test::ScratchFolder scratch_;
  const fs::path root_ = scratch_.path();
  fs::path folder_ = root_ / "scenarios";
  ScenarioStore store_;
};

TEST_F(ExhibitFiles, AreFoundByNameAndNowhereElse) {
  EXPECT_EQ(exhibit_file(folder_, "pump"), folder_ / "pump/pump.x3d");
  EXPECT_EQ(exhibit_file(folder_, "crane"), folder_ / "crane.x3d");
  EXPECT_EQ(exhibit_file(folder_, "models").error().code, ErrorCode::not_found);
  EXPECT_EQ(exhibit_file(folder_, "../secret").error().code, ErrorCode::invalid_value);
  EXPECT_EQ(exhibit_file(folder_, "secret").error().code, ErrorCode::conflict) << "a link out of the folder";
  EXPECT_THAT(exhibits_in(folder_), ElementsAre("crane", "pump", "screw"));
  EXPECT_THAT(exhibits_in(root_ / "none"), ElementsAre());
  Settings settings;
  EXPECT_EQ(exhibits_folder(settings, store_), folder_);
  settings.exhibits = "/elsewhere";
  EXPECT_EQ(exhibits_folder(settings, store_), "/elsewhere");
}

TEST_F(ExhibitFiles, OrdersAreCheckedAgainstWhatThereIs) {
  EXPECT_EQ(file_of(ExhibitVerb::load, "crane"), folder_ / "crane.x3d");
  EXPECT_EQ(file_of(ExhibitVerb::load, "pump").error().code, ErrorCode::conflict) << "loaded already";
  EXPECT_EQ(file_of(ExhibitVerb::replace, "screw"), folder_ / "screw/screw.x3d");
  EXPECT_EQ(file_of(ExhibitVerb::replace, "crane").error().code, ErrorCode::unknown_name);
  EXPECT_EQ(file_of(ExhibitVerb::retire, "pump"), fs::path());
  const auto home = file_of(ExhibitVerb::retire, "screw");
  EXPECT_EQ(home.error().code, ErrorCode::conflict);
  EXPECT_FALSE(home.error().remedy.empty());
}

TEST_F(ExhibitFiles, AStoreKeepsItsOrderAndItsHome) {
  const auto former = store_.find("screw");
  store_.put(scenario("screw", "2"), folder_ / "screw/screw.x3d");
  EXPECT_NE(store_.find("screw"), former);
  EXPECT_EQ(store_.first()->content_hash, "2") << "home stays home";
  store_.retire("screw");
  EXPECT_NE(store_.find("screw"), nullptr);
  store_.retire("pump");
  EXPECT_EQ(store_.find("pump"), nullptr);
  EXPECT_EQ(store_.file_of("pump"), fs::path());
  EXPECT_EQ(store_.all().size(), 1U);
}

constexpr FarewellFacts kNobody{.clients = true};
constexpr FarewellFacts kVisit{.clients = true, .visit = true};
constexpr FarewellFacts kStill{.clients = true, .forces_zero = true};

TEST(FarewellTest, WithoutAVisitTheHandsAreLetGoAndItEnds) {
  Farewell farewell;
  const TimePoint t0{};
  EXPECT_EQ(farewell.look(kNobody, t0), FarewellStep::let_go);
  EXPECT_EQ(farewell.look(kNobody, t0 + 20ms), FarewellStep::wait) << "there is still a force";
  EXPECT_EQ(farewell.look(kStill, t0 + 120ms), FarewellStep::leave);
}

TEST(FarewellTest, AVisitFinishesAndItsEndIsRead) {
  Farewell farewell;
  const TimePoint t0{};
  EXPECT_EQ(farewell.look(kVisit, t0), FarewellStep::wait);
  EXPECT_EQ(farewell.look(kVisit, t0 + 600s), FarewellStep::wait);
  EXPECT_EQ(farewell.look(kNobody, t0 + 601s), FarewellStep::wait);
  EXPECT_EQ(farewell.look(kNobody, t0 + 600s + Farewell::kAfterVisit), FarewellStep::let_go);
  Farewell left;
  EXPECT_EQ(left.look({.clients = false, .visit = true}, t0), FarewellStep::leave) << "its programs have ended";
}

TEST(FarewellTest, InAHurryTheForcesGoFirst) {
  Farewell farewell;
  const TimePoint t0{};
  EXPECT_EQ(farewell.look(kVisit, t0), FarewellStep::wait);
  farewell.hurry();
  EXPECT_EQ(farewell.look(kVisit, t0 + 20ms), FarewellStep::let_go);
  EXPECT_EQ(farewell.look(kVisit, t0 + 40ms), FarewellStep::wait);
  EXPECT_EQ(farewell.look({.clients = true, .visit = true, .forces_zero = true}, t0 + 140ms), FarewellStep::leave);
  Farewell stuck;
  stuck.hurry();
  EXPECT_EQ(stuck.look(kVisit, t0), FarewellStep::let_go);
  EXPECT_EQ(stuck.look(kVisit, t0 + Farewell::kForcesZeroBy), FarewellStep::leave) << "its loop has stopped";
}

}  // namespace
}  // namespace mechane::app
