// A scripted visitor whose hand closes where the server lets it hold nothing.
#include <csignal>
#include <filesystem>
#include <regex>

#include <gmock/gmock.h>

#include "client-sdk/visitor/visit_session.hpp"
#include "server/scenario/file_finder.hpp"
#include "tests/integration/transport/loopback.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_files.hpp"

namespace mechane::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class FailedGrasp : public testing::Test {
 protected:
  FailedGrasp() {
    std::filesystem::create_directory(scratch_.path() / "screw");
    std::filesystem::create_directory_symlink(source_folder() / "scenarios/models", scratch_.path() / "models");
    // The moves of a hasty visitor.
    options_.scenario = scratch_.write(
        "screw/screw.x3d", std::regex_replace(text_of(shipped_file()), std::regex("name='seconds' value='[^']*'"),
                                              "name='seconds' value='0.1'"));
    options_.visits = {"assembling"};
    options_.client.domain = kClientDomain;
    options_.player.grasp_patience_s = 0.2;
    options_.player.fetch_again = 0;
    options_.done_within = options_.linger = Duration{0};
    scenario::FileFinder finder;
    x3d::Problems problems(options_.scenario.string());
    auto world = scenario::read_scenario(options_.scenario, finder, problems);
    if (!world) throw std::runtime_error(world.error().to_string());
    world_ = std::make_shared<state::WorldDescription>(std::move(*world));
  }

  /// What the visitor reports of its grasp, and what it printed, where agents are on or off.
  struct Told {
    std::string reason;
    std::string report;
    std::string printed;
  };
  [[nodiscard]] Told visit(bool agents_on) const {
    EchoServer server(world_);
    server.change([&](state::WorldState& state) {
      std::fill(state.agent_enabled.begin(), state.agent_enabled.end(), agents_on ? 1 : 0);
      state.progress.step = world_->activities[state.progress.activity.index()].first;
    });
    volatile std::sig_atomic_t stop = 0;
    testing::internal::CaptureStdout();
    const auto report = visitor::run_visit(options_, stop);
    const std::string printed = testing::internal::GetCapturedStdout();
    if (!report || report->activities.size() != 1 || report->activities[0].moves.size() < 2) {
      ADD_FAILURE() << (report ? printed : report.error().to_string());
      return {};
    }
    return {report->activities[0].moves[1].reason, visitor::to_json(*report), printed};
  }

  LoopbackDomain server_domain_{kServerDomain, 0};
  LoopbackDomain client_domain_{kClientDomain, 0};
  ScratchFolder scratch_;
  visitor::VisitOptions options_;
  std::shared_ptr<const state::WorldDescription> world_;
};

TEST_F(FailedGrasp, IsExplainedByWhatTheServerSaysOfTheStep) {
  const Told told = visit(false);
  const std::string step = world_->steps[world_->activities[0].first.index()].name;
  EXPECT_THAT(told.reason, AllOf(HasSubstr("lets hands take INNER, is disabled"), HasSubstr("in step '" + step + "'")));
  EXPECT_THAT(told.report, HasSubstr(told.reason));
  EXPECT_THAT(told.printed, HasSubstr("visit assembling: grasp INNER failed: " + told.reason));
}

TEST_F(FailedGrasp, IsNotBlamedOnAnAgentThatIsOn) {
  EXPECT_THAT(visit(true).reason, AllOf(HasSubstr("INNER"), Not(HasSubstr("disabled"))));
}

}  // namespace
}  // namespace mechane::test
