// mechane-replay: runs a journal again, as fast as possible or in real time, and says whether it ends as the live world did.
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "server/app/replay.hpp"
#include "server/app/scenario_store.hpp"
#include "server/app/version.hpp"
#include "server/app/visit_show.hpp"
#include "server/log/command_line.hpp"
#include "server/log/log.hpp"
#include "server/visits/visit_file.hpp"

namespace {

using namespace mechane;

struct Arguments {
  std::filesystem::path journal;
  app::Settings settings;
  app::ReplayOptions options;
  std::string visit;  ///< its number; empty: the whole journal
  app::ShowOptions show;
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

/// Shows one visit of a folder of records. An error is also on stdout, in one line, for the program that started this one.
Expected<void> show(const Arguments& a) {
  const auto file = visits::VisitFile::open(a.journal / visits::kVisitFileName, visits::VisitFile::Access::read);
  if (!file) return tl::unexpected(file.error());
  const auto records = file->records({.number = a.visit});
  if (!records) return tl::unexpected(records.error());
  if (records->size() != 1)
    return fail(ErrorCode::unknown_name, "there is no visit with this number", a.visit,
                "'mechane visits list' shows the numbers");
  const visits::VisitRecord& visit = records->front();
  auto store = app::ScenarioStore::load(a.settings);
  if (!store) return tl::unexpected(store.error());
  const auto description = store->find(visit.scenario);
  if (description == nullptr)
    return fail(ErrorCode::conflict, "the visit was to the scenario '" + visit.scenario + "'", a.visit,
                "name the X3D file of that scenario with --scenario");
  const auto found = app::find_visit(a.journal, visit, *description);
  if (!found) return tl::unexpected(found.error());
  return app::show_visit(*found, description, store->world_config(), a.show);
}

int run_show(const Arguments& a) {
  const auto shown = show(a);
  if (shown) return 0;
  log::error(shown.error());
  fmt::print("{}\n", shown.error().to_string());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{
      "Runs a journal again and compares its state hashes. Exit status: 0 the same (or of an older "
      "physics, not compared), 1 different or cut off, 2 an error.",
      "mechane replay"};
  app.set_version_flag("--version", std::string("mechane ") + app::kVersion);
  app.add_option("journal", a.journal, "journal file of a server's records; with --visit the folder of records")
      ->required();
  app.add_option("--scenario", a.settings.scenarios, "X3D file that the journal's world ran")->required();
  app.add_option("--stiffness-scale", a.settings.stiffness_scale, "as the server was told");
  app.add_option("--cache", a.settings.cache, "folder of built collision parts");
  app.add_flag("--real-time", a.options.real_time, "at the pace of the visit");
  app.add_flag("--events", a.options.show_events, "print every event");
  auto* visit = app.add_option("--visit", a.visit, "show this visit as a world on the network, compare nothing");
  app.add_option("--show-in", a.show.domain, "DDS domain to show it in, in which no server is")->needs(visit);
  auto* kiosk = app.add_option("--show-to", a.show.kiosk, "the kiosk whose displays see it")->needs(visit);
  app.add_option("--speed", a.show.speed, "1: as it was")->check(CLI::Range(0.1, 50.0))->needs(visit);
  visit->needs(kiosk);
  if (const std::optional<int> status = parse_command_line(app, argc, argv)) return *status;
  log::start("replay", log::Level::info);
  return a.visit.empty() ? run(a) : run_show(a);
}
