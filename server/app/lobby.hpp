// Who gets which world: the main thread's policy. A kiosk that appears gets its world, or waits for one; one that asks to join another's
// shares it; a world without clients is closed after a while; a visitor who touches a sign goes on to another scenario; after a restart a
// kiosk is put back where it was.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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
  /// All arguments outlive the lobby. `recorder` and `sheets` may be null: nothing is kept.
  Lobby(const Settings& settings, const ScenarioStore& scenarios, transport::ServerTransport& transport,
        record::Recorder* recorder, visits::VisitSheets* sheets, std::vector<std::unique_ptr<WorldLoop>>& loops);
  ~Lobby();

  void take(const transport::News& news, TimePoint now);
  /// Lets kiosks go on to another scenario: where a step says so, or somebody asks for it. After the news of a poll.
  void follow_signs();
  /// Visitors' answers go to the sheets of their visits. Without sheets they are taken, and not kept.
  void take_answers();
  /// Closes what has been idle long enough, takes apart what its loop has given back.
  void tidy(TimePoint now);
  /// Takes all worlds off their loops and closes their journals. Snapshots stay, for a restart.
  void close_all();

  [[nodiscard]] std::size_t worlds() const { return worlds_.size(); }
  [[nodiscard]] std::uint32_t users() const;

 private:
  struct Entry {
    std::string name;
    std::shared_ptr<const state::WorldDescription> description;
    RunningWorld running;
    std::unique_ptr<WorldVisits> visits;  ///< null: no sheets are kept
    WorldLoop* loop = nullptr;
    std::vector<std::string> kiosks;
    std::optional<TimePoint> idle_since;
  };

  /// A kiosk without a world: while all are in use, or the kiosk whose world it is to share has none.
  struct Waiting {
    transport::Session session;
    std::string told;  ///< why it waits, as it was told last
  };

  void kiosk_appeared(const transport::Session& session);
  /// Worlds for those whose waiting is over, first come first; the others are told why they wait.
  void serve_waiting();
  /// Empty: it need not wait.
  [[nodiscard]] std::string why_to_wait(const Waiting& waiting);
  void give_world(const transport::Session& session);
  void enter(const std::string& kiosk, Entry& entry);
  void kiosk_left(const std::string& kiosk, TimePoint now);
  void hand_granted(const transport::Session& session);
  void hand_freed(const transport::Session& session);
  void bind_hand(const transport::Session& session, Entry& entry);
  [[nodiscard]] Entry* world_of(const std::string& kiosk);
  [[nodiscard]] Expected<Entry*> open_for(const transport::Session& session);
  /// Where an entry's visitors are to go now; null: nowhere.
  [[nodiscard]] std::shared_ptr<const state::WorldDescription> next_of(Entry& entry) const;
  /// A new world for the entry's kiosks and hands; then the entry is closed. Errors: as open().
  [[nodiscard]] Expected<void> go_on(Entry& entry, std::shared_ptr<const state::WorldDescription> description);
  /// Makes a world and hands it to a loop.
  [[nodiscard]] Expected<Entry*> open(std::vector<std::string> kiosks,
                                      std::shared_ptr<const state::WorldDescription> description);
  [[nodiscard]] Expected<std::unique_ptr<world::World>> make_world(Entry& entry, record::JournalHeader& header);
  /// The newest snapshot that the kiosk can be put back to; null: none.
  [[nodiscard]] const record::SnapshotFile* snapshot_of(const std::string& kiosk,
                                                        const state::WorldDescription& description) const;
  /// Forgets the kiosk's snapshots from before. Their files, which stay until the new world's own snapshot is on the disk.
  [[nodiscard]] std::vector<std::filesystem::path> take_snapshots_of(const std::string& kiosk);
  void start_records(Entry& entry, record::JournalHeader header);
  void start_visits(Entry& entry, bool resumed);
  /// `went_on_to`: the scenario that its visitors go on to; empty: none.
  void close(Entry& entry, record::WorldRecorder::Snapshot snapshot, const std::string& went_on_to = {});
  void wait_until_left(Entry& entry);

  const Settings& settings_;
  const ScenarioStore& scenarios_;
  transport::ServerTransport& transport_;
  record::Recorder* recorder_;
  visits::VisitSheets* sheets_;
  std::vector<std::unique_ptr<WorldLoop>>& loops_;
  std::map<std::string, std::unique_ptr<Entry>> worlds_;
  std::vector<Waiting> waiting_;                   // in the order in which they came
  std::vector<record::SnapshotFile> from_before_;  // of the run before this one
  std::uint32_t next_number_ = 1;
};

}  // namespace mechane::app
