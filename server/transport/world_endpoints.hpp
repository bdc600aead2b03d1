// WorldEndpoints: one world's endpoints, except those of hands. Turns the world's state into samples.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/realtime/ring.hpp"
#include "server/transport/scenario_names.hpp"
#include "server/transport/validate.hpp"
#include "server/transport/world_port.hpp"
#include <mechane/proto/entity.hpp>

namespace mechane::transport {

/// Made by the main thread. write() is for the museum publisher's thread. Commands are checked on a thread of Cyclone's.
class WorldEndpoints {
 public:
  /// `scenarios`: what a kiosk may ask for. What the references refer to outlives it. Errors: io_failure (DDS).
  [[nodiscard]] static Expected<std::unique_ptr<WorldEndpoints>> create(const proto::Participant& participant,
                                                                        WorldPort& port, RejectCounters& rejects,
                                                                        const ScenarioNames& scenarios);
  WorldEndpoints(const WorldEndpoints&) = delete;
  WorldEndpoints& operator=(const WorldEndpoints&) = delete;

  [[nodiscard]] WorldPort& port() const { return port_; }
  /// Publishes the manifest and a first status. Once, before write().
  void write_manifest();
  /// Publishes what the loop has put out since the last call.
  void write();
  [[nodiscard]] std::uint64_t writes_failed() const { return failed_; }

 private:
  WorldEndpoints(WorldPort& port, RejectCounters& rejects, const ScenarioNames& scenarios);
  void take_request(const std::string& scenario, std::uint64_t id);
  void take_commands(proto::ReaderView<proto::Command> view);
  /// For commands that a tick carries out.
  void take_for_tick(const proto::Command& wire);
  /// False for a command that came before: a link that was interrupted brings those of the last seconds twice.
  [[nodiscard]] bool is_new(std::uint64_t session, std::uint64_t id);
  void take_answer(const std::string& argument, std::uint64_t id);
  void take_language(const std::string& language, std::uint64_t id);
  void refuse(std::uint64_t id);
  void reply(std::uint64_t id, state::EventKind kind);
  void set_ropes(const SceneSnapshot& snapshot);
  void write_frame(const SceneSnapshot& snapshot);
  void write_status(const SceneSnapshot& snapshot);
  void write_event(const state::Event& event);
  [[nodiscard]] bool moved(const SceneSnapshot& snapshot) const;
  void count(bool written) { failed_ += written ? 0 : 1; }

  WorldPort& port_;
  RejectCounters& rejects_;
  const ScenarioNames& scenarios_;

  /// The reply to a command that no tick carries out.
  struct Reply {
    std::uint64_t id = 0;
    state::EventKind kind = state::EventKind::command_refused;
  };
  realtime::Ring<Reply> replies_{64};  // command listener to publisher

  struct Heard {
    std::uint64_t session = 0;  // of a client; 0: free
    std::uint64_t id = 0;       // of its newest command; a client counts upwards
  };
  std::array<Heard, 64> heard_{};  // for the listener
  std::size_t next_heard_ = 0;
  std::uint64_t failed_ = 0;
  std::uint64_t frame_sequence_ = 0;
  std::uint64_t status_sequence_ = 0;
  std::uint64_t event_sequence_ = 0;
  std::optional<SceneSnapshot> last_;  // as written
  bool skipped_last_ = false;
  std::vector<std::uint32_t> movable_;  // bodies that are in every frame
  std::vector<proto::WireBodyPose> bodies_;
  std::vector<proto::WireHandPose> hands_;
  std::array<std::array<proto::WirePose, hand::kHandSegments>, hand::kMaxUsers> segments_;
  std::vector<proto::WireRope> ropes_;
  std::vector<std::vector<float>> rope_points_;
  proto::Writer<proto::SceneFrame> frames_;
  proto::Writer<proto::SceneObject> objects_;
  proto::Writer<proto::WorldStatus> status_;
  proto::Writer<proto::WorldPresentation> presentation_;
  proto::Writer<proto::Event> events_;
  proto::Reader<proto::Command> commands_;  // last: its listener ends first
};

}  // namespace mechane::transport
