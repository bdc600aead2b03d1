// mechane-replay: runs a journal again, as fast as possible or in real time, and says whether it ends as the live world did.
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "server/app/replay.hpp"
#include "server/app/scenario_store.hpp"
#include "server/app/version.hpp"
#include "server/log/command_line.hpp"
#include "server/log/log.hpp"

namespace {

using namespace mechane;

struct Arguments {
  std::filesystem::path journal;
  app::Settings settings;
  app::ReplayOptions options;
};

void print_result(const record::JournalHeader& header, const app::ReplayResult& r) {
  fmt::print("world {}, kiosk {}, scenario {}\n", header.world_id, header.kiosk, header.scenario_id);
  fmt::print("ticks            {} ({:.1f} s of visit in {:.1f} s)\n", r.ticks,
             static_cast<double>(r.ticks) * kTickSeconds, r.seconds);
  fmt::print("hashes compared  {}\n", r.hashes_compared);
  fmt::print("final hash       {:016x}\n", r.final_hash);
  if (!r.whole()) fmt::print("the journal ends early: {}\n", r.end.message);
  if (r.older_physics) {
    fmt::print("recorded by an older physics: replayed, not compared\n");
  } else if (r.first_difference) {
    fmt::print("DIFFERENT from tick {} at the latest\n", *r.first_difference);
  } else if (r.hashes_compared == 0) {
    fmt::print("nothing to compare with\n");
  } else {
    fmt::print("the same, bit for bit{}\n", r.whole() ? "" : ", as far as it goes");
  }
}

int run(const Arguments& a) {
  auto journal = record::JournalReader::open_file(a.journal);
  if (!journal) {
    log::error(journal.error());
    return 2;
  }
  auto store = app::ScenarioStore::load(a.settings);
  if (!store) {
    log::error(store.error());
    return 2;
  }
  const auto description = store->find(journal->header().scenario_id);
  if (description == nullptr) {
    log::error(Error{ErrorCode::conflict,
                     fmt::format("the journal was recorded with scenario '{}'", journal->header().scenario_id),
                     a.journal.string(), "name the X3D file of that scenario with --scenario"});
    return 2;
  }
  const auto result = app::replay(*journal, description, store->world_config(), a.options);
  if (!result) {
    log::error(result.error());
    return 2;
  }
  print_result(journal->header(), *result);
  return result->same() || (result->older_physics && result->whole()) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{
      "Runs a journal again and compares its state hashes. Exit status: 0 the same (or of an older "
      "physics, not compared), 1 different or cut off, 2 an error.",
      "mechane replay"};
  app.set_version_flag("--version", std::string("mechane ") + app::kVersion);
  app.add_option("journal", a.journal, "journal file of a server's records")->required();
  app.add_option("--scenario", a.settings.scenarios, "X3D file that the journal's world ran")->required();
  app.add_option("--stiffness-scale", a.settings.stiffness_scale, "as the server was told");
  app.add_option("--cache", a.settings.cache, "folder of built collision parts");
  app.add_flag("--real-time", a.options.real_time, "at the pace of the visit");
  app.add_flag("--events", a.options.show_events, "print every event");
  if (const std::optional<int> status = parse_command_line(app, argc, argv)) return *status;
  log::start("replay", log::Level::info);
  return run(a);
}
