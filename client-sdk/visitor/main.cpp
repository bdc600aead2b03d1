// mechane-visitor: an automated visitor that plays a scenario's visit over the network like a person.
#include <csignal>
#include <cstdio>
#include <fstream>

#include <CLI/CLI.hpp>

#include "client-sdk/visitor/visit_session.hpp"
#include "server/log/log.hpp"

namespace {

using namespace mechane;

volatile std::sig_atomic_t g_stop = 0;  // the one thing that a signal handler may write

struct Arguments {
  visitor::VisitOptions options;
  std::string report_file;
  std::vector<double> offset;
  bool glove = false;
  bool local = false;
  double patience_s = 60;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--kiosk", a.options.client.kiosk, "name of the kiosk");
  app.add_option("--user", a.options.client.user, "which hand of the kiosk, 0..3");
  app.add_option("--join", a.options.client.join_kiosk, "share the world of this kiosk");
  app.add_option("--scenario", a.options.scenario, "X3D file to read the visit from")->required();
  app.add_option("--activity", a.options.activities,
                 "play these activities, in this order; without: all that have a visit");
  app.add_option("--domain", a.options.client.domain, "DDS domain");
  app.add_option("--offset", a.offset, "metres by which the hand misses: x y z")->expected(3);
  app.add_option("--patience", a.patience_s, "seconds that an activity may take after the last move");
  app.add_option("--report", a.report_file, "write a JSON report to this file");
  app.add_flag("--glove", a.glove, "a whole hand instead of one point");
  app.add_flag("--local", a.local, "render forces from the local contact model");
  app.add_flag("--endless", a.options.endless, "begin again when through");
}

int report(const visitor::VisitReport& result, const std::string& file) {
  const std::string json = visitor::to_json(result);
  if (!file.empty()) {
    std::ofstream out(file);
    out << json;
    out.flush();
    if (!out) {
      log::error(Error{"the report could not be written", file, "check the folder and the free space"});
      return 1;
    }
  } else {
    std::fputs(json.c_str(), stdout);
  }
  return result.complete() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{"Plays a scenario's scripted visit over the network like a person."};
  add_options(app, a);
  CLI11_PARSE(app, argc, argv);
  log::start("visitor", log::Level::info);
  a.options.client.role = client::Role::hand;
  a.options.client.program = "mechane-visitor";
  a.options.done_within = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(a.patience_s));
  if (a.offset.size() == 3) a.options.player.offset_W = Vec3(a.offset[0], a.offset[1], a.offset[2]);
  if (a.glove) a.options.player.kind = client::HandKind::glove;
  if (a.local) a.options.render = haptic::RenderMode::local;
  std::signal(SIGINT, [](int) { g_stop = 1; });
  std::signal(SIGTERM, [](int) { g_stop = 1; });
  const auto result = visitor::run_visit(a.options, g_stop);
  if (!result) {
    log::error(result.error());
    return 2;
  }
  return report(*result, a.report_file);
}
