// WorldLink: a client's endpoints in one world, and what they have received.
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

/// What is known of the client's world. Listeners fill it; any thread of the client reads it.
struct WorldStore {
  static constexpr std::size_t kEvents = 256;

  /// A frame with the number of its world: the mailbox may still hold a frame of the previous world.
  struct Numbered {
    std::uint64_t world = 0;
    Frame frame;
  };
  realtime::Mailbox<Numbered> newest;  // from the frame listener to newest_frame()

  std::mutex mutex;  // for what follows
  FrameHistory history;
  std::map<std::uint32_t, SceneObject> objects;
  std::optional<WorldStatus> status;
  std::shared_ptr<const WorldPresentation> presentation;
  std::deque<WorldEvent> events;
  FrameTraffic traffic;  ///< of all worlds

  /// Begins another world: forgets the last one, except for events that have not been taken yet.
  void clear();
  /// Id of the scenario of this world; empty where it is not known yet.
  [[nodiscard]] std::string scenario();
};

/// Made and destroyed by the link thread; the destructor waits for the listeners. Each world has its own partition, so
/// another world, or the same one of a restarted server, gets a new link.
class WorldLink {
 public:
  /// `number` tells worlds apart within one client. `store` outlives the link.
  [[nodiscard]] static Expected<std::unique_ptr<WorldLink>> create(const proto::Participant& participant,
                                                                   const std::string& world, std::uint64_t number,
                                                                   WorldStore& store);
  WorldLink(const WorldLink&) = delete;
  WorldLink& operator=(const WorldLink&) = delete;

  /// All endpoints are connected to their peers.
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
  Frame arriving_;  // this and the next are used by the frame listener only
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
