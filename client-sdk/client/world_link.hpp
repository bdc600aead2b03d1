// WorldLink: a client's endpoints in one world, and what came through them.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "client-sdk/client/frame_history.hpp"
#include "server/realtime/mailbox.hpp"
#include <mechane/client/displays.hpp>
#include <mechane/client/types.hpp>
#include <mechane/proto/entity.hpp>

namespace mechane::client {

/// What is known of the world that the client is in. Listeners fill it; any thread of the client's reads it.
struct WorldStore {
  static constexpr std::size_t kEvents = 256;

  /// A frame with the world that it belongs to: a mailbox may still hold one of the world before.
  struct Numbered {
    std::uint64_t world = 0;
    Frame frame;
  };
  realtime::Mailbox<Numbered> newest;  // frame listener to the reader of newest_frame()

  std::mutex mutex;  // for what follows
  FrameHistory history;
  std::map<std::uint32_t, SceneObject> objects;
  std::optional<WorldStatus> status;
  std::shared_ptr<const WorldPresentation> presentation;
  std::deque<WorldEvent> events;
  FrameTraffic traffic;  ///< of all worlds

  /// Another world: what was known of the last one goes, but for events that nobody has taken.
  void clear();
  /// Id of the scenario of this world; empty where it is not known yet.
  [[nodiscard]] std::string scenario();
};

/// The link thread makes and destroys it; the end waits for listeners. A world's partition cannot change: another world, or the same
/// one of a restarted server, gets a new link.
class WorldLink {
 public:
  /// `number` tells worlds apart within one client. `store` outlives the link.
  [[nodiscard]] static Expected<std::unique_ptr<WorldLink>> create(const proto::Participant& participant,
                                                                   const std::string& world, std::uint64_t number,
                                                                   WorldStore& store);
  WorldLink(const WorldLink&) = delete;
  WorldLink& operator=(const WorldLink&) = delete;

  /// All endpoints have found their peers.
  [[nodiscard]] bool matched() const;
  bool send_command(std::uint64_t session, std::uint64_t id, proto::CommandKind kind, const std::string& argument);

 private:
  WorldLink(std::string world, std::uint64_t number, WorldStore& store);
  void take_frames(proto::ReaderView<proto::SceneFrame> view);
  void take_objects(proto::ReaderView<proto::SceneObject> view);
  void take_status(proto::ReaderView<proto::WorldStatus> view);
  void take_presentation(proto::ReaderView<proto::WorldPresentation> view);
  void take_events(proto::ReaderView<proto::Event> view);

  std::string world_;
  std::uint64_t number_;
  WorldStore& store_;
  Frame arriving_;  // the frame listener's, as the next
  std::uint64_t last_frame_ = 0;
  std::uint64_t command_sequence_ = 0;
  proto::Writer<proto::Command> commands_;
  proto::Reader<proto::SceneFrame> frames_;
  proto::Reader<proto::SceneObject> objects_;
  proto::Reader<proto::WorldStatus> status_;
  proto::Reader<proto::WorldPresentation> presentation_;
  proto::Reader<proto::Event> events_;
};

}  // namespace mechane::client
