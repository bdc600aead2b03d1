#include "client-sdk/pointer/pointer_link.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include <pthread.h>

#include "server/log/log.hpp"
#include "server/realtime/priority.hpp"

namespace mechane::pointer {
namespace {

using client::LinkState;

// A sample older than 10 ms is stale to the server, and a thread of no priority wakes late.
constexpr Duration kSendEvery = std::chrono::milliseconds(2);
constexpr int kFifoPriority = 60;  // under the devices' loops
constexpr int kLookEvery = 4;      // sends; frames come at 60 Hz
constexpr int kStatusEvery = 25;
constexpr Duration kStays = std::chrono::seconds(30);
constexpr std::array<std::uint32_t, 3> kUsers{3, 2, 1};

/// While it lives, drawing on the processor makes this thread no later: a hand that is silent for 50 ms lets go. A refusal does no harm.
/// Threads that the network's library starts before or after stay ordinary.
class Hurry {
 public:
  Hurry() { (void)realtime::take_fifo(kFifoPriority); }
  Hurry(const Hurry&) = delete;
  Hurry& operator=(const Hurry&) = delete;
  ~Hurry() {
    const sched_param ordinary{0};
    (void)pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
  }
};

}  // namespace

/// What the link's thread knows of the world.
struct PointerLink::Sensed {
  client::Frame frame;
  std::vector<client::SceneObject> objects;
  std::vector<std::string> enabled;
  std::shared_ptr<const client::WorldPresentation> presentation;
  std::uint64_t looks = 0;
  bool holding = false;

  [[nodiscard]] std::optional<Pose> pose_of(std::uint32_t object) const {
    const auto body = std::ranges::find(frame.bodies, object, &client::BodyPose::object);
    if (body != frame.bodies.end()) return body->X_WB;
    const auto known = std::ranges::find(objects, object, &client::SceneObject::index);
    return known == objects.end() ? std::nullopt : std::optional(known->X_WB);
  }
  [[nodiscard]] std::optional<PointerSenses> of(std::uint32_t object) const {
    const std::optional<Pose> X_WB = pose_of(object);
    if (!X_WB || !presentation) return {};
    return PointerSenses{
        *X_WB,
        leeway_of(presentation->affordances, enabled, object, [this](std::uint32_t other) { return pose_of(other); }),
        holding, laid_out(object)};
  }
  [[nodiscard]] std::optional<Quat> laid_out(std::uint32_t object) const {
    const auto known = std::ranges::find(objects, object, &client::SceneObject::index);
    return known == objects.end() ? std::nullopt : std::optional(known->X_WB.R);
  }
};

PointerLink::PointerLink(std::string kiosk, std::uint32_t domain)
    : kiosk_(std::move(kiosk)), domain_(domain), thread_([this] { run(); }) {}

PointerLink::~PointerLink() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wanted_.notify_all();
  thread_.join();
}

void PointerLink::press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched) {
  {
    const std::lock_guard lock(mutex_);
    hand_.press(sight, place, touched);
  }
  wanted_.notify_all();
}

void PointerLink::move(picture::PixelPlace place) {
  const std::lock_guard lock(mutex_);
  hand_.move(place);
}

void PointerLink::deepen(double notches) {
  const std::lock_guard lock(mutex_);
  hand_.deepen(notches);
}

void PointerLink::turn(double angle_rad) {
  const std::lock_guard lock(mutex_);
  hand_.turn(angle_rad);
}

void PointerLink::release() {
  const std::lock_guard lock(mutex_);
  hand_.release();
}

PointerView PointerLink::view() const {
  const std::lock_guard lock(mutex_);
  return hand_.view();
}

PointerLinkState PointerLink::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

bool PointerLink::resting() const {
  return hand_.view().phase == PointerView::Phase::resting;
}

void PointerLink::run() {
  pthread_setname_np(pthread_self(), "pointer-hand");
  for (;;) {
    {
      Lock lock(mutex_);
      wanted_.wait(lock, [this] { return stop_ || !resting(); });
      if (stop_) return;
      state_ = PointerLinkState::waiting;
    }
    const std::unique_ptr<client::Client> client = open();
    if (client) serve(*client);
    const std::lock_guard lock(mutex_);
    if (state_ != PointerLinkState::refused) state_ = PointerLinkState::none;
  }
}

/// The last hand that nobody owns.
std::unique_ptr<client::Client> PointerLink::open() {
  for (const std::uint32_t user : kUsers) {
    client::ClientConfig config;
    config.kiosk = kiosk_;
    config.user = user;
    config.role = client::Role::hand;
    config.program = "mechane-display";
    config.domain = domain_;
    config.fifo_priority = kFifoPriority;
    auto client = client::Client::connect(config);
    if (!client) {
      log::error(client.error());
      break;
    }
    const auto look_again = std::chrono::milliseconds(20);
    while ((*client)->state() != LinkState::refused) {
      if ((*client)->wait_for(LinkState::joined, look_again)) return std::move(*client);
      const std::lock_guard lock(mutex_);
      if (stop_ || resting()) return std::move(*client);
    }
  }
  const std::lock_guard lock(mutex_);
  state_ = PointerLinkState::refused;
  hand_ = PointerHand();
  return nullptr;
}

void PointerLink::look(client::Client& client, Sensed& sensed) const {
  if (const auto force = client.newest_force()) sensed.holding = force->holding;
  if (sensed.looks % kLookEvery == 0) (void)client.newest_frame(sensed.frame);
  if (sensed.looks % kStatusEvery == 0) {
    sensed.presentation = client.presentation();
    if (auto status = client.world_status()) sensed.enabled = std::move(status->enabled_agents);
    if (std::vector<client::SceneObject> objects = client.objects(); objects.size() != sensed.objects.size())
      sensed.objects = std::move(objects);
  }
  ++sensed.looks;
}

void PointerLink::serve(client::Client& client) {
  const Hurry hurry;
  Sensed sensed;
  SystemClock clock;
  TimePoint last = clock.now();
  TimePoint touched = last;
  while (last - touched < kStays) {
    const TimePoint now = clock.now();
    look(client, sensed);
    Lock lock(mutex_);
    if (stop_) return;
    state_ = client.state() == LinkState::joined ? PointerLinkState::joined : PointerLinkState::waiting;
    const bool joined = state_ == PointerLinkState::joined;
    // Who holds nothing yet may wait for the server; else the server has let go of everything.
    if (!joined && hand_.view().phase != PointerView::Phase::reaching) hand_ = PointerHand();
    if (client.state() == LinkState::refused) return;
    if (resting()) {
      wanted_.wait_for(lock, kStays, [this] { return stop_ || !resting(); });
      last = clock.now();
      if (resting()) return;
      touched = last;
      sensed.looks = 0;  // what was seen before is old
      continue;
    }
    touched = now;
    const auto senses = sensed.of(hand_.view().object);
    std::optional<client::HandSample> input;
    // A hand that nobody hears does not move on.
    if (senses && joined) input = hand_.advance(to_seconds(now - last), *senses);
    last = now;
    lock.unlock();
    if (input) (void)client.send(*input);
    clock.sleep_until(now + kSendEvery);
  }
}

}  // namespace mechane::pointer
