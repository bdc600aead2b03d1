#include "client-sdk/client/world_link.hpp"

#include <chrono>

#include "client-sdk/client/parse.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::client {
namespace {

/// A larger gap does not count as lost frames: it comes from another writer's numbers, or from wrong ones.
constexpr std::uint64_t kMostLostAtOnce = 3600;

}  // namespace

void WorldStore::clear() {
  const std::lock_guard lock(mutex);
  history.clear();
  objects.clear();
  status.reset();
  presentation.reset();
}

std::string WorldStore::scenario() {
  const std::lock_guard lock(mutex);
  return status ? status->scenario : std::string();
}

WorldLink::WorldLink(std::string world, std::uint64_t number, WorldStore& store)
    : world_(std::move(world)), number_(number), store_(store) {}

Expected<std::unique_ptr<WorldLink>> WorldLink::create(const proto::Participant& participant, const std::string& world,
                                                       std::uint64_t number, WorldStore& store) {
  std::unique_ptr<WorldLink> made(new WorldLink(world, number, store));
  WorldLink* const raw = made.get();
  const std::string partition = proto::world_partition(world);
  std::optional<Error> fault;
  const auto open = [&](auto& endpoint, auto created) {
    if (created) {
      endpoint = std::move(*created);
    } else if (!fault) {
      fault = created.error();
    }
  };
  open(raw->commands_, proto::Writer<proto::Command>::create(participant, partition));
  open(raw->frames_,
       proto::Reader<proto::SceneFrame>::create(participant, partition, [raw](auto v) { raw->take_frames(v); }));
  open(raw->objects_,
       proto::Reader<proto::SceneObject>::create(participant, partition, [raw](auto v) { raw->take_objects(v); }));
  open(raw->status_,
       proto::Reader<proto::WorldStatus>::create(participant, partition, [raw](auto v) { raw->take_status(v); }));
  open(raw->presentation_, proto::Reader<proto::WorldPresentation>::create(
                               participant, partition, [raw](auto v) { raw->take_presentation(v); }));
  open(raw->events_,
       proto::Reader<proto::Event>::create(participant, partition, [raw](auto v) { raw->take_events(v); }));
  if (fault) return tl::unexpected<Error>(*fault);
  return made;
}

bool WorldLink::matched() const {
  return commands_.matched() > 0 && frames_.matched() > 0 && objects_.matched() > 0 && status_.matched() > 0 &&
         presentation_.matched() > 0 && events_.matched() > 0;
}

bool WorldLink::send_command(std::uint64_t session, std::uint64_t id, proto::CommandKind kind,
                             const std::string& argument) {
  proto::Command wire{};
  proto::set_text(wire.scope, proto::world_partition(world_));
  wire.protocol = proto::kProtocol;
  wire.seq = ++command_sequence_;
  wire.sent_ns = to_ns(std::chrono::steady_clock::now());
  wire.session = session;
  wire.id = id;
  wire.kind = kind;
  wire.argument = proto::look_into(argument);
  return commands_.write(wire);
}

void WorldLink::take_frames(proto::ReaderView<proto::SceneFrame> view) {
  view.take_each([this](const proto::SceneFrame& wire, const proto::SampleInfo& info) {
    if (!info.valid || !parse(wire, arriving_)) return;
    arriving_.received = std::chrono::steady_clock::now();
    store_.newest.publish({number_, arriving_});
    const std::lock_guard lock(store_.mutex);
    ++store_.traffic.received;
    const bool gap = last_frame_ != 0 && wire.seq > last_frame_ && wire.seq - last_frame_ <= kMostLostAtOnce;
    if (gap) store_.traffic.lost += wire.seq - last_frame_ - 1;
    last_frame_ = wire.seq;
    store_.history.add(arriving_, wire.sent_ns);
  });
}

void WorldLink::take_objects(proto::ReaderView<proto::SceneObject> view) {
  view.take_each([this](const proto::SceneObject& wire, const proto::SampleInfo& info) {
    SceneObject object;
    if (!info.valid || !parse(wire, object)) return;
    const std::lock_guard lock(store_.mutex);
    store_.objects[object.index] = std::move(object);
  });
}

void WorldLink::take_status(proto::ReaderView<proto::WorldStatus> view) {
  view.take_each([this](const proto::WorldStatus& wire, const proto::SampleInfo& info) {
    WorldStatus status;
    if (!info.valid || !parse(wire, status)) return;
    const std::lock_guard lock(store_.mutex);
    store_.status = std::move(status);
  });
}

void WorldLink::take_presentation(proto::ReaderView<proto::WorldPresentation> view) {
  view.take_each([this](const proto::WorldPresentation& wire, const proto::SampleInfo& info) {
    auto presentation = std::make_shared<WorldPresentation>();
    if (!info.valid || !parse(wire, *presentation)) return;
    const std::lock_guard lock(store_.mutex);
    store_.presentation = std::move(presentation);
  });
}

void WorldLink::take_events(proto::ReaderView<proto::Event> view) {
  view.take_each([this](const proto::Event& wire, const proto::SampleInfo& info) {
    WorldEvent event;
    if (!info.valid || !parse(wire, event)) return;
    const std::lock_guard lock(store_.mutex);
    store_.events.push_back(std::move(event));
    if (store_.events.size() > WorldStore::kEvents) store_.events.pop_front();
  });
}

}  // namespace mechane::client
