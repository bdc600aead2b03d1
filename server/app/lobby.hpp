// Decides which kiosk gets which world. A kiosk that appears gets a world, or waits until one is free; it can ask to share the world of
// another kiosk. A world without clients is closed after a while. A visitor who touches a sign goes on to another scenario. After a restart
// of the server, a kiosk continues where it was.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/app/farewell.hpp"
#include "server/app/scenario_store.hpp"
#include "server/app/settings.hpp"
#include "server/app/world_loop.hpp"
#include "server/app/world_visits.hpp"
#include "server/record/recorder.hpp"
#include "server/record/snapshot_file.hpp"
#include "server/transport/server_transport.hpp"

namespace mechane::app {

/// Main thread only.
class Lobby {
 public:
  /// All arguments outlive the lobby. `recorder` and `visit_writer` may be null: then nothing is recorded.
  Lobby(const Settings& settings, const ScenarioStore& scenarios, transport::ServerTransport& transport,
        record::Recorder* recorder, visits::VisitWriter* visit_writer, std::vector<std::unique_ptr<WorldLoop>>& loops);
  ~Lobby();

  void take(const transport::News& news, TimePoint now);
  /// Lets kiosks go on to another scenario, where a step says so or a client asks for it. Call it after the news of a poll.
  void follow_signs();
  /// Puts visitors' answers into the records of their visits. Where visits are not recorded, the answers are dropped.
  void take_answers();
  /// Closes worlds that have been idle long enough, and gives worlds to kiosks that wait.
  void tidy(TimePoint now);
  /// Also ends visits that are still running on a former content of this exhibit. Those whose visits may finish need no call:
  /// tidy() finds the worlds whose exhibit the store does not have any more.
  void hurry(const std::string& exhibit);
  /// Worlds that run a former content of this exhibit go on with it as the store has it now, from where they are: once their hands are
  /// without force. See world::obstacle_between(); where their state does not fit all the same, they begin anew.
  void carry_on(const std::string& exhibit);
  /// How many worlds run this exhibit as the store has it, and how many a former content of it.
  struct WorldCount {
    std::uint32_t current = 0;
    std::uint32_t former = 0;
  };
  [[nodiscard]] WorldCount worlds_of(const std::string& exhibit) const;
  /// Takes all worlds from their loops and closes their journals. Snapshots stay for a restart.
  void close_all();

  [[nodiscard]] std::size_t worlds() const { return worlds_.size(); }
  [[nodiscard]] std::uint32_t users() const;

 private:
  struct Entry {
    std::string name;
    std::shared_ptr<const state::WorldDescription> description;
    RunningWorld running;
    std::unique_ptr<WorldVisits> visits;
    bool carries_on = false;    ///< its state goes to the world that follows
    Farewell farewell;          ///< used once the store has its exhibit no more, or another content of it
    WorldLoop* loop = nullptr;  ///< null: it has given the world back
    std::vector<std::string> kiosks;
    std::optional<TimePoint> idle_since;
  };

  /// A kiosk that waits for a world: all are in use, or the kiosk whose world it shares has none yet.
  struct Waiting {
    transport::Session session;
    std::string told;   ///< why it waits, as it was last told
    TimePoint until{};  ///< it gets no world before, so that its visitor can read why: see send_away()
  };

  void kiosk_appeared(const transport::Session& session, TimePoint now);
  /// Gives worlds to waiting kiosks, in the order in which they came. The others are told why they have to wait.
  void serve_waiting(TimePoint now);
  /// Empty where it need not wait any more.
  [[nodiscard]] std::string why_to_wait(const Waiting& waiting, TimePoint now);
  [[nodiscard]] bool is_current(const Entry& entry) const;
  void leave_former_exhibits(TimePoint now);
  void leave_former(Entry& entry, TimePoint now);
  /// Closes the entry, and tells its kiosks why for a while before they get another world.
  void send_away(Entry& entry, TimePoint now);
  void give_world(const transport::Session& session);
  void enter(const std::string& kiosk, Entry& entry);
  void kiosk_left(const std::string& kiosk, TimePoint now);
  void hand_granted(const transport::Session& session);
  void hand_freed(const transport::Session& session);
  void bind_hand(const transport::Session& session, Entry& entry);
  [[nodiscard]] Entry* world_of(const std::string& kiosk);
  [[nodiscard]] Expected<Entry*> open_for(const transport::Session& session);
  /// The scenario that an entry's visitors go on to now; null: none.
  [[nodiscard]] std::shared_ptr<const state::WorldDescription> next_of(Entry& entry) const;
  /// Moves the entry's kiosks and hands to a new world, with its state where that carries on, and closes the entry. Errors: as open().
  [[nodiscard]] Expected<void> go_on(Entry& entry, std::shared_ptr<const state::WorldDescription> description);
  /// Makes a world and gives it to a loop.
  /// `carried`: a snapshot that it goes on from; empty: see make_world().
  [[nodiscard]] Expected<Entry*> open(std::vector<std::string> kiosks,
                                      std::shared_ptr<const state::WorldDescription> description,
                                      std::vector<std::byte> carried = {});
  [[nodiscard]] Expected<std::unique_ptr<world::World>> make_world(Entry& entry, std::vector<std::byte> carried,
                                                                   record::JournalHeader& header);
  /// The newest snapshot that the kiosk can continue from; null: none.
  [[nodiscard]] const record::SnapshotFile* snapshot_of(const std::string& kiosk,
                                                        const state::WorldDescription& description) const;
  /// Takes the kiosk's snapshots of the former server from the list. Returns their files, which stay until the new world's own snapshot is
  /// on the disk.
  [[nodiscard]] std::vector<std::filesystem::path> take_snapshots_of(const std::string& kiosk);
  void start_records(Entry& entry, record::JournalHeader header);
  void start_visits(Entry& entry, bool resumed);
  /// `went_on_to`: the scenario that its visitors go on to; empty: none.
  void close(Entry& entry, record::WorldRecorder::Snapshot snapshot, const std::string& went_on_to = {});
  void wait_until_left(Entry& entry) const;

  const Settings& settings_;
  const ScenarioStore& scenarios_;
  transport::ServerTransport& transport_;
  record::Recorder* recorder_;
  visits::VisitWriter* visit_writer_;
  std::vector<std::unique_ptr<WorldLoop>>& loops_;
  std::map<std::string, std::unique_ptr<Entry>> worlds_;
  std::vector<Waiting> waiting_;                   // in the order in which they came
  std::vector<record::SnapshotFile> from_before_;  // of the former server
  std::uint32_t next_number_ = 1;
};

}  // namespace mechane::app
