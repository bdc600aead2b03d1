#include "server/app/lobby.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "server/app/version.hpp"
#include "server/log/log.hpp"
#include "server/state/snapshot.hpp"

namespace mechane::app {
namespace {

using transport::NewsKind;
using transport::Session;

std::uint64_t wall_ns() {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()).count());
}

std::string step_name(const state::WorldDescription& description, const state::WorldState& state) {
  return state.progress.step ? description.steps[state.progress.step.index()].name : std::string("none");
}

// Long enough to read why the exhibit has gone.
constexpr Duration kSaidFor = std::chrono::seconds(3);

std::string who(const Session& session) {
  return fmt::format("{} of {} (user {}, {} on {})", session.role == transport::Role::hand ? "hand" : "watcher",
                     session.kiosk, session.user, session.program, session.host);
}

}  // namespace

Lobby::Lobby(const Settings& settings, const ScenarioStore& scenarios, transport::ServerTransport& transport,
             record::Recorder* recorder, visits::VisitWriter* visit_writer,
             std::vector<std::unique_ptr<WorldLoop>>& loops)
    : settings_(settings),
      scenarios_(scenarios),
      transport_(transport),
      recorder_(recorder),
      visit_writer_(visit_writer),
      loops_(loops) {
  if (recorder_ == nullptr) return;
  for (const auto& path : record::find_snapshots(settings.records)) {
    auto file = record::read_snapshot_file(path);
    if (file) {
      from_before_.push_back(std::move(*file));
    } else {
      log::warning(file.error().to_string());
    }
  }
  // A new world must not overwrite the snapshot of a kiosk that has not come back yet.
  for (const auto& file : from_before_) {
    std::uint32_t number = 0;
    if (std::sscanf(file.info.world_id.c_str(), "world-%u", &number) == 1)
      next_number_ = std::max(next_number_, number + 1);
  }
}

Lobby::~Lobby() {
  close_all();
}

std::uint32_t Lobby::users() const {
  std::uint32_t count = 0;
  for (const Session& session : transport_.sessions().sessions()) {
    const Session* owner = transport_.sessions().owner(session.kiosk, session.user);
    count += owner != nullptr && owner->id == session.id ? 1 : 0;
  }
  return count;
}

void Lobby::take(const transport::News& news, TimePoint now) {
  switch (news.kind) {
    case NewsKind::kiosk_appeared:
      kiosk_appeared(news.session, now);
      break;
    case NewsKind::session_appeared:
      log::info(who(news.session) + " appeared");
      break;
    case NewsKind::hand_granted:
      hand_granted(news.session);
      break;
    case NewsKind::hand_freed:
      hand_freed(news.session);
      break;
    case NewsKind::session_left:
      log::info(who(news.session) + " left");
      break;
    case NewsKind::kiosk_left:
      kiosk_left(news.session.kiosk, now);
      break;
  }
}

Lobby::Entry* Lobby::world_of(const std::string& kiosk) {
  for (auto& [name, entry] : worlds_) {
    if (std::find(entry->kiosks.begin(), entry->kiosks.end(), kiosk) != entry->kiosks.end()) return entry.get();
  }
  return nullptr;
}

void Lobby::kiosk_appeared(const Session& session, TimePoint now) {
  if (Entry* entry = world_of(session.kiosk)) return enter(session.kiosk, *entry);  // it was only away for a moment
  waiting_.push_back({session, {}, {}});
  serve_waiting(now);
}

void Lobby::serve_waiting(TimePoint now) {
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    std::string why = why_to_wait(*it, now);
    if (why.empty()) {
      const Session session = it->session;
      it = waiting_.erase(it);
      give_world(session);
      continue;
    }
    if (why != it->told) {
      log::warning(fmt::format("{}: {}", it->session.kiosk, why));
      transport_.refuse_kiosk(it->session.kiosk, why);
      it->told = std::move(why);
    }
    ++it;
  }
}

std::string Lobby::why_to_wait(const Waiting& waiting, TimePoint now) {
  if (now < waiting.until) return waiting.told;
  const std::string& shared = waiting.session.join_kiosk;
  if (!shared.empty()) {
    return world_of(shared) != nullptr
               ? std::string()
               : fmt::format("waiting for kiosk {}, to share its world: start that kiosk", shared);
  }
  if (worlds_.size() < settings_.worlds) return {};
  return fmt::format(
      "waiting: all {} worlds of this server are in use. The kiosk gets one as soon as one is free; to run more worlds "
      "at "
      "once, start the server with a larger --worlds",
      settings_.worlds);
}

void Lobby::give_world(const Session& session) {
  Entry* entry = session.join_kiosk.empty() ? nullptr : world_of(session.join_kiosk);
  if (entry != nullptr) {
    entry->kiosks.push_back(session.kiosk);
    log::info(fmt::format("{} shares world {}", session.kiosk, entry->name));
  } else {
    auto opened = open_for(session);
    if (!opened) {
      log::error(opened.error());
      return transport_.refuse_kiosk(session.kiosk, opened.error().what + "; " + opened.error().remedy);
    }
    entry = *opened;
  }
  enter(session.kiosk, *entry);
}

void Lobby::enter(const std::string& kiosk, Entry& entry) {
  entry.idle_since.reset();
  transport_.assign_kiosk(kiosk, *entry.running.port);
  // Hands that were granted while the kiosk was waiting.
  for (const Session& session : transport_.sessions().sessions()) {
    const Session* owner = transport_.sessions().owner(kiosk, session.user);
    if (session.kiosk == kiosk && owner != nullptr && owner->id == session.id) bind_hand(session, entry);
  }
}

Expected<Lobby::Entry*> Lobby::open_for(const Session& session) {
  auto description = session.scenario.empty() ? scenarios_.first() : scenarios_.find(session.scenario);
  if (description == nullptr && session.was_there) {
    log::warning(fmt::format("{} was in '{}', which this server does not have; it begins in '{}'", session.kiosk,
                             session.scenario, scenarios_.first()->id));
    description = scenarios_.first();
  }
  if (description == nullptr) {
    return fail(ErrorCode::unknown_name, fmt::format("this server has no scenario '{}'", session.scenario),
                session.kiosk, "start the server with its file, or ask for another scenario");
  }
  return open({session.kiosk}, std::move(description));
}

Expected<Lobby::Entry*> Lobby::open(std::vector<std::string> kiosks,
                                    std::shared_ptr<const state::WorldDescription> description,
                                    std::vector<std::byte> carried) {
  auto entry = std::make_unique<Entry>();
  entry->name = fmt::format("world-{}", next_number_);
  entry->description = std::move(description);
  entry->kiosks = std::move(kiosks);
  record::JournalHeader header;
  auto world = make_world(*entry, std::move(carried), header);
  if (!world) return tl::unexpected(world.error());
  auto port = transport_.open_world(entry->name, entry->description);
  if (!port) return tl::unexpected(port.error());
  entry->running.step = (*world)->state.progress.step;
  entry->running.world = std::move(*world);
  entry->running.port = *port;
  start_visits(*entry, !header.snapshot.empty());
  start_records(*entry, std::move(header));
  const auto least = std::min_element(loops_.begin(), loops_.end(),
                                      [](const auto& a, const auto& b) { return a->size() < b->size(); });
  entry->loop = least->get();
  if (!entry->loop->add(entry->running)) {
    transport_.close_world(**port);
    return fail(ErrorCode::busy, "the loop has no room for another world", entry->name,
                "start the server with more --loop-threads");
  }
  ++next_number_;
  Entry* result = entry.get();
  worlds_.emplace(entry->name, std::move(entry));
  log::info(fmt::format("world {} opened for {}: {}", result->name, fmt::join(result->kiosks, ", "),
                        result->description->id));
  return result;
}

void Lobby::follow_signs() {
  std::vector<Entry*> entries;  // going on opens and closes worlds
  for (auto& [name, entry] : worlds_)
    entries.push_back(entry.get());
  for (Entry* entry : entries) {
    auto description = next_of(*entry);
    if (description == nullptr) continue;
    if (auto gone = go_on(*entry, std::move(description)); !gone) log::error(gone.error());
  }
}

std::shared_ptr<const state::WorldDescription> Lobby::next_of(Entry& entry) const {
  std::shared_ptr<const state::WorldDescription> next;
  if (const StepId id = entry.running.sends_on.exchange(StepId::none())) {
    const state::StepDescription& step = entry.description->steps[id.index()];
    next = scenarios_.find(step.opens);
    if (next == nullptr) {
      log::warning(
          fmt::format("{}: step {} opens '{}', which this server does not have; the visitors stay where they are",
                      entry.description->id, step.name, step.opens));
    }
  }
  if (const auto request = entry.running.port->take_request()) {
    next = scenarios_.find(transport_.scenario(*request));
    if (next == nullptr)
      log::warning(fmt::format("{} was retired before a kiosk could open it", transport_.scenario(*request)));
  }
  return next;
}

Expected<void> Lobby::go_on(Entry& entry, std::shared_ptr<const state::WorldDescription> description) {
  std::vector<std::byte> carried;
  if (entry.carries_on) {
    wait_until_left(entry);
    state::write_snapshot(entry.running.world->state, carried);
  }
  auto opened = open(entry.kiosks, std::move(description), std::move(carried));
  if (!opened) return tl::unexpected(opened.error());
  Entry& next = **opened;
  const std::string went_on_to = next.description->id;
  next.idle_since = entry.idle_since;
  for (const std::string& kiosk : std::exchange(entry.kiosks, {}))
    transport_.assign_kiosk(kiosk, *next.running.port);
  for (const Session& session : transport_.sessions().sessions()) {
    const std::size_t slot = entry.running.port->slot_of(session.id);
    if (slot >= hand::kMaxUsers) continue;
    entry.running.port->unbind_user(slot);
    bind_hand(session, next);
  }
  close(entry, record::WorldRecorder::Snapshot::remove, went_on_to);
  worlds_.erase(worlds_.find(entry.name));
  return {};
}

/// A world that goes on from what is carried, or continues where the kiosk was before a restart, or else the scenario's beginning.
Expected<std::unique_ptr<world::World>> Lobby::make_world(Entry& entry, std::vector<std::byte> carried,
                                                          record::JournalHeader& header) {
  const std::string& kiosk = entry.kiosks.front();
  if (carried.empty())
    if (const record::SnapshotFile* snapshot = snapshot_of(kiosk, *entry.description)) carried = snapshot->state;
  if (!carried.empty()) {
    auto resumed = world::World::resume(entry.description, scenarios_.world_config(), carried);
    if (resumed) {
      log::info(fmt::format("resumed {} where it was: step {}, tick {}", kiosk,
                            step_name(*entry.description, (*resumed)->state), (*resumed)->state.tick));
      header.snapshot = std::move(carried);
      header.first_tick = (*resumed)->state.tick + 1;
      return resumed;
    }
    log::warning(resumed.error().to_string());
  }
  header.first_tick = 1;
  return world::World::create(entry.description, scenarios_.world_config());
}

const record::SnapshotFile* Lobby::snapshot_of(const std::string& kiosk,
                                               const state::WorldDescription& description) const {
  const record::SnapshotFile* found = nullptr;
  for (const record::SnapshotFile& file : from_before_) {
    if (file.info.kiosk != kiosk || file.info.scenario_hash != description.content_hash) continue;
    const double age_s = 1e-9 * static_cast<double>(wall_ns() - std::min(wall_ns(), file.info.wall_ns));
    if (age_s > settings_.resume_within_s) continue;
    if (found == nullptr || file.info.wall_ns > found->info.wall_ns) found = &file;
  }
  return found;
}

std::vector<std::filesystem::path> Lobby::take_snapshots_of(const std::string& kiosk) {
  std::vector<std::filesystem::path> paths;
  std::erase_if(from_before_, [&](const record::SnapshotFile& file) {
    if (file.info.kiosk != kiosk) return false;
    paths.push_back(record::snapshot_path(settings_.records, file.info.world_id));
    return true;
  });
  return paths;
}

void Lobby::start_records(Entry& entry, record::JournalHeader header) {
  if (recorder_ == nullptr) return;
  header.world_id = entry.name;
  header.kiosk = entry.kiosks.front();
  header.scenario_id = entry.description->id;
  header.scenario_hash = entry.description->content_hash;
  header.build_id = kVersion;
  std::vector<std::byte> sample;
  state::write_snapshot(entry.running.world->state, sample);
  auto replaced = take_snapshots_of(header.kiosk);
  entry.running.recorder.emplace(recorder_->open(std::move(header), sample.size() + 4096, std::move(replaced)));
  entry.running.keep_snapshot();
}

void Lobby::start_visits(Entry& entry, bool resumed) {
  entry.visits = std::make_unique<WorldVisits>(visit_writer_, entry.description, entry.kiosks.front(),
                                               entry.running.world->state, resumed);
  entry.running.visits = &entry.visits->feed();
}

void Lobby::take_answers() {
  for (auto& [name, entry] : worlds_) {
    const auto language = entry->running.port->take_language();
    if (language) entry->visits->set_language(entry->description->languages[*language]);
    while (const auto given = entry->running.port->take_answer()) {
      if (auto kept = entry->visits->answer(*given); !kept) log::warning(kept.error().to_string());
    }
  }
}

void Lobby::hand_granted(const Session& session) {
  Entry* entry = world_of(session.kiosk);
  if (entry != nullptr) bind_hand(session, *entry);  // else when the kiosk gets a world
}

void Lobby::bind_hand(const Session& session, Entry& entry) {
  transport::WorldPort& port = *entry.running.port;
  if (port.slot_of(session.id) < hand::kMaxUsers) return;
  const std::size_t slot = port.free_slot();
  if (slot >= hand::kMaxUsers || !port.bind_user(slot, session.kiosk, session.user, session.id)) {
    log::warning(fmt::format("{}: world {} has no room for this hand: {} hands are its limit", who(session), entry.name,
                             hand::kMaxUsers));
    return;
  }
  log::info(fmt::format("{} is in world {}", who(session), entry.name));
}

void Lobby::hand_freed(const Session& session) {
  Entry* entry = world_of(session.kiosk);
  if (entry == nullptr) return;
  const std::size_t slot = entry->running.port->slot_of(session.id);
  if (slot < hand::kMaxUsers) entry->running.port->unbind_user(slot);
}

void Lobby::kiosk_left(const std::string& kiosk, TimePoint now) {
  std::erase_if(waiting_, [&](const Waiting& waiting) { return waiting.session.kiosk == kiosk; });
  Entry* entry = world_of(kiosk);
  if (entry == nullptr) return;
  // Where kiosks share the world, this one just leaves it. The last one may come back to it for a while.
  if (entry->kiosks.size() > 1) {
    std::erase(entry->kiosks, kiosk);
    return;
  }
  entry->idle_since = now;
}

void Lobby::tidy(TimePoint now) {
  const auto limit = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(settings_.world_idle_s));
  leave_former_exhibits(now);
  for (auto it = worlds_.begin(); it != worlds_.end();) {
    Entry& entry = *it->second;
    entry.visits->look();
    if (!entry.idle_since || (now - *entry.idle_since < limit && is_current(entry))) {
      ++it;
      continue;
    }
    close(entry, record::WorldRecorder::Snapshot::remove);
    it = worlds_.erase(it);
  }
  serve_waiting(now);
}

bool Lobby::is_current(const Entry& entry) const {
  return scenarios_.find(entry.description->id) == entry.description;
}

Lobby::WorldCount Lobby::worlds_of(const std::string& exhibit) const {
  WorldCount count;
  for (const auto& [name, entry] : worlds_)
    if (entry->description->id == exhibit) ++(is_current(*entry) ? count.current : count.former);
  return count;
}

void Lobby::hurry(const std::string& exhibit) {
  for (auto& [name, entry] : worlds_)
    if (entry->description->id == exhibit && !is_current(*entry)) entry->farewell.hurry();
}

void Lobby::carry_on(const std::string& exhibit) {
  for (auto& [name, entry] : worlds_)
    if (entry->description->id == exhibit && !is_current(*entry)) entry->carries_on = true;
  hurry(exhibit);
}

void Lobby::leave_former_exhibits(TimePoint now) {
  std::vector<Entry*> leaving;  // leaving closes worlds, and may open others
  for (auto& [name, entry] : worlds_) {
    if (is_current(*entry) || entry->idle_since) continue;  // tidy() closes those without clients
    const FarewellFacts facts{
        .clients = true, .visit = entry->visits->visit_runs(), .forces_zero = entry->running.port->forces_are_zero()};
    const FarewellStep step = entry->farewell.look(facts, now);
    if (step == FarewellStep::let_go) entry->running.port->retreat();
    if (step == FarewellStep::leave) leaving.push_back(entry.get());
  }
  for (Entry* entry : leaving)
    entry->farewell.hurried() && !entry->carries_on ? send_away(*entry, now) : leave_former(*entry, now);
}

/// The kiosks go on to the exhibit as it is now, or home where it was retired.
void Lobby::leave_former(Entry& entry, TimePoint now) {
  auto next = scenarios_.find(entry.description->id);
  const auto gone = go_on(entry, next != nullptr ? std::move(next) : scenarios_.first());
  if (gone) return;
  log::error(gone.error());
  if (entry.carries_on) send_away(entry, now);  // its loop has given it back already
}

void Lobby::send_away(Entry& entry, TimePoint now) {
  const bool stays = scenarios_.find(entry.description->id) != nullptr;
  const std::string why = stays ? "this exhibit has just been changed; it begins anew in a moment"
                                : "this exhibit has just been taken out of the museum; another one opens in a moment";
  const std::vector<std::string> kiosks = std::exchange(entry.kiosks, {});
  const std::string next = stays ? entry.description->id : std::string();
  close(entry, record::WorldRecorder::Snapshot::remove);
  worlds_.erase(worlds_.find(entry.name));
  for (const std::string& kiosk : kiosks) {
    Waiting waiting;
    waiting.session.kiosk = kiosk;
    waiting.session.scenario = next;
    waiting.session.was_there = true;
    if (kiosk != kiosks.front()) waiting.session.join_kiosk = kiosks.front();
    waiting.told = why;
    waiting.until = now + kSaidFor;
    log::info(fmt::format("{}: {}", kiosk, why));
    transport_.refuse_kiosk(kiosk, why);
    waiting_.push_back(std::move(waiting));
  }
}

void Lobby::close_all() {
  for (auto& [name, entry] : worlds_)
    close(*entry, record::WorldRecorder::Snapshot::keep);
  worlds_.clear();
}

void Lobby::wait_until_left(Entry& entry) const {
  if (entry.loop == nullptr) return;
  entry.running.leave.store(true, std::memory_order_release);
  SystemClock clock;
  // The loop gives the world back at the end of its next tick. A loop that has stopped does not use it any more.
  while (!entry.running.left.load(std::memory_order_acquire) && entry.loop->thread().report().running) {
    clock.sleep_until(clock.now() + kTickPeriod);
  }
  entry.loop->forget_one();
  entry.loop = nullptr;
}

void Lobby::close(Entry& entry, record::WorldRecorder::Snapshot snapshot, const std::string& went_on_to) {
  wait_until_left(entry);
  const bool stops = snapshot == record::WorldRecorder::Snapshot::keep;
  entry.visits->close(stops ? visits::VisitEnding::cut : visits::VisitEnding::left, went_on_to);
  const state::WorldState& state = entry.running.world->state;
  if (entry.running.recorder) {
    // The state of now: the last snapshot is up to a second old.
    if (snapshot == record::WorldRecorder::Snapshot::keep) entry.running.keep_snapshot();
    entry.running.recorder->close(state::state_hash(state), snapshot);
  }
  transport_.close_world(*entry.running.port);
  log::info(fmt::format("world {} closed after {} ticks, at step {}", entry.name, state.tick,
                        step_name(*entry.description, state)));
}

}  // namespace mechane::app
