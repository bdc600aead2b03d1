#include "server/app/visit_journal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "server/base/clock.hpp"
#include "server/record/journal_reader.hpp"

namespace mechane::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMinute_ticks = 60'000;
constexpr std::uint64_t kNear_ticks = 500;          // a record's times and a journal's differ by less
constexpr std::uint64_t kDrift_ticks = 10'000;      // by which a busy server's ticks may lag behind the clock
constexpr std::uint64_t kAfterwards_ticks = 1'500;  // the end of the last movement is seen

std::uint64_t apart(std::uint64_t a, std::uint64_t b) {
  return a > b ? a - b : b - a;
}

std::uint64_t ticks_of(double seconds) {
  return static_cast<std::uint64_t>(std::llround(seconds / kTickSeconds));
}

/// The tick of a moment, as a signed number: it may lie before the journal.
std::int64_t tick_at(const record::JournalHeader& header, std::int64_t minute) {
  const std::int64_t after_ms = minute * 60'000 - static_cast<std::int64_t>(header.start_wall_ns / 1'000'000);
  return static_cast<std::int64_t>(header.first_tick) + after_ms;
}

struct Candidate {
  fs::path path;
  std::uint64_t began_ns = 0;
};

/// The newest journal of the visit's kiosk and scenario that had begun when the visit's minute was over.
Expected<fs::path> journal_of(const fs::path& records, const visits::VisitRecord& visit) {
  std::optional<Candidate> best;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(records, error)) {
    if (entry.path().extension() != ".journal") continue;
    const auto journal = record::JournalReader::open_file(entry.path());
    if (!journal) continue;  // of another version, or just being begun
    const record::JournalHeader& header = journal->header();
    const bool in_time = static_cast<std::int64_t>(header.start_wall_ns / 60'000'000'000U) <= visit.minute;
    if (header.kiosk != visit.kiosk || header.scenario_id != visit.scenario || !in_time) continue;
    if (!best || header.start_wall_ns > best->began_ns) best = {entry.path(), header.start_wall_ns};
  }
  if (best) return best->path;
  return fail(error ? ErrorCode::io_failure : ErrorCode::not_found,
              error ? "the folder of records cannot be read: " + error.message() : "there is no journal of this visit",
              records.string(), "the oldest journals are deleted first: see records_limit_mb in server.toml");
}

}  // namespace

std::uint64_t beginning_of(const visits::VisitRecord& visit, const std::vector<BegunStep>& begun,
                           std::uint64_t earliest, std::uint64_t latest, std::uint64_t expected) {
  std::vector<std::uint64_t> told;  // of each step, how long after the visit's beginning it began
  std::uint64_t after = 0;
  for (const visits::RecordedStep& step : visit.steps) {
    told.push_back(after);
    after += ticks_of(step.duration_s);
  }
  const auto is_there = [&](std::size_t step, std::uint64_t beginning) {
    return std::ranges::any_of(begun, [&](const BegunStep& one) {
      return one.name == visit.steps[step].name && apart(one.tick, beginning + told[step]) <= kNear_ticks;
    });
  };
  std::size_t most = 0;
  std::uint64_t best = expected;
  for (const BegunStep& one : begun) {
    for (std::size_t i = 0; i < told.size(); ++i) {
      if (one.name != visit.steps[i].name || one.tick < told[i]) continue;
      const std::uint64_t beginning = one.tick - told[i];
      if (beginning < earliest || beginning > latest) continue;
      std::size_t fitting = 0;
      for (std::size_t k = 0; k < told.size(); ++k)
        fitting += is_there(k, beginning) ? 1 : 0;
      if (fitting < most || (fitting == most && beginning >= best)) continue;
      most = fitting;
      best = beginning;
    }
  }
  return best;
}

Expected<VisitTicks> find_visit(const fs::path& records, const visits::VisitRecord& visit,
                                const state::WorldDescription& description) {
  const auto path = journal_of(records, visit);
  if (!path) return tl::unexpected(path.error());
  auto journal = record::JournalReader::open_file(*path);
  if (!journal) return tl::unexpected(journal.error());
  const std::uint64_t start = journal->header().first_tick;
  const auto clamped = [start](std::int64_t tick) {
    return static_cast<std::uint64_t>(std::max(tick, static_cast<std::int64_t>(start)));
  };
  const std::uint64_t expected = clamped(tick_at(journal->header(), visit.minute));
  const std::uint64_t earliest = expected > kDrift_ticks + kMinute_ticks ? expected - kDrift_ticks - kMinute_ticks : 0;
  const std::uint64_t latest = expected + kMinute_ticks + kDrift_ticks;
  const std::uint64_t end = latest + ticks_of(visit.duration_s);
  std::vector<BegunStep> begun;
  std::uint64_t newest = start;
  record::JournalTick tick;
  while (newest < end && journal->next(tick) && !tick.after_loss) {
    newest = tick.tick;
    for (const state::Event& event : tick.events)
      if (event.kind == state::EventKind::step_started && event.subject < description.steps.size())
        begun.push_back({description.steps[event.subject].name, tick.tick});
  }
  if (newest < expected) {
    return fail(ErrorCode::not_found, "the journal of this visit ends before it", path->string(),
                "the server wrote no further, or lost ticks: see its log");
  }
  VisitTicks found{*path, beginning_of(visit, begun, earliest, latest, expected), 0};
  found.first = std::max(found.first, start);
  found.last = std::min(found.first + ticks_of(visit.duration_s) + kAfterwards_ticks, newest);
  return found;
}

}  // namespace mechane::app
