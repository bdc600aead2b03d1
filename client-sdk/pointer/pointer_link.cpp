#include "client-sdk/pointer/pointer_link.hpp"

#include <algorithm>
#include <chrono>

#include "client-sdk/pointer/free_hand.hpp"
#include "server/base/thread_setup.hpp"

namespace mechane::pointer {
namespace {

using client::LinkState;

// The server rejects samples older than 10 ms, and a thread without priority may wake late.
constexpr Duration kSendEvery = std::chrono::milliseconds(2);
constexpr int kLookEvery = 4;  // sends; frames come at 60 Hz
constexpr int kStatusEvery = 25;
constexpr Duration kStays = std::chrono::seconds(30);

}  // namespace

HandState state_of(const PointerView& view, picture::PixelSize picture) {
  const bool holds = view.phase == PointerView::Phase::holding;
  const bool busy = holds || view.phase == PointerView::Phase::reaching;
  return {busy, holds && view.drag == PointerView::Drag::carry, picture,
          busy ? std::optional(view.object) : std::nullopt};
}

void fulfil(const HandRequest& request, PointerTouch& hand) {
  switch (request.kind) {
    case HandRequest::Kind::take:
      return;
    case HandRequest::Kind::move:
      return hand.move(request.place);
    case HandRequest::Kind::twist:
      return hand.turn(request.amount);
    case HandRequest::Kind::deepen:
      return hand.deepen(request.amount);
    case HandRequest::Kind::release:
      return hand.release();
  }
}

/// What the link's thread knows of the world.
struct PointerLink::Sensed {
  client::Frame frame;
  std::vector<client::SceneObject> objects;
  std::vector<std::string> enabled;
  std::shared_ptr<const client::WorldPresentation> presentation;
  std::uint64_t looks = 0;
  bool seen = false;  ///< a frame has come: before, poses would be those of the exhibit's file
  bool holding = false;

  [[nodiscard]] std::optional<PointerSenses> of(std::uint32_t object) const {
    if (!seen) return std::nullopt;
    return senses_of({&frame, objects, presentation.get(), enabled}, object, holding);
  }
};

PointerLink::PointerLink(std::string kiosk, std::uint32_t domain)
    : kiosk_(std::move(kiosk)), domain_(domain), thread_([this] { run(); }) {}

PointerLink::~PointerLink() {
  stop_ = true;
  exchange_.wake();
  thread_.join();
}

void PointerLink::press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched) {
  exchange_.act({PointerAct::Kind::press, place, 0, sight, touched});
}

void PointerLink::move(picture::PixelPlace place) {
  exchange_.act({PointerAct::Kind::move, place});
}

void PointerLink::deepen(double notches) {
  exchange_.act({PointerAct::Kind::deepen, {}, notches});
}

void PointerLink::turn(double angle_rad) {
  exchange_.act({PointerAct::Kind::turn, {}, angle_rad});
}

void PointerLink::release() {
  exchange_.act({PointerAct::Kind::release});
}

void PointerLink::show(PointerLinkState state) {
  state_ = state;
  exchange_.publish(state);
}

bool PointerLink::wait_for_touch(Duration longest) {
  SystemClock clock;
  const TimePoint until = clock.now() + longest;
  for (;;) {
    exchange_.take_acts();
    if (stop_) return false;
    if (!exchange_.resting()) return true;
    show(state_);
    const TimePoint now = clock.now();
    if (now >= until) return false;
    exchange_.wait(until - now);
  }
}

void PointerLink::run() {
  set_up_thread("pointer-hand");
  while (!stop_) {
    if (!wait_for_touch(kStays)) continue;
    show(PointerLinkState::waiting);
    const std::unique_ptr<client::Client> client = open();
    if (client) serve(*client);
    if (state_ != PointerLinkState::refused) show(PointerLinkState::none);
  }
}

std::unique_ptr<client::Client> PointerLink::open() {
  auto client = take_last_hand(kiosk_, domain_, "mechane-display", [this] {
    exchange_.take_acts();
    show(PointerLinkState::waiting);
    return !stop_ && !exchange_.resting();
  });
  if (client) return client;
  exchange_.take_acts();
  exchange_.hand() = PointerHand();
  show(PointerLinkState::refused);
  return nullptr;
}

void PointerLink::look(client::Client& client, Sensed& sensed) const {
  if (const auto force = client.newest_force()) sensed.holding = force->holding;
  if (sensed.looks % kLookEvery == 0) sensed.seen = client.newest_frame(sensed.frame) || sensed.seen;
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
  PointerHand& hand = exchange_.hand();
  while (last - touched < kStays) {
    const TimePoint now = clock.now();
    look(client, sensed);
    exchange_.take_acts();
    if (stop_) return;
    const bool joined = client.state() == LinkState::joined;
    state_ = joined ? PointerLinkState::joined : PointerLinkState::waiting;
    // A hand that holds nothing yet can wait for the server; otherwise the server has released everything.
    if (!joined && hand.view().phase != PointerView::Phase::reaching) hand = PointerHand();
    if (client.state() == LinkState::refused) return;
    if (exchange_.resting()) {
      if (!wait_for_touch(kStays)) return;
      last = touched = clock.now();
      sensed.looks = 0;  // earlier frames are out of date
      continue;
    }
    touched = now;
    const auto senses = sensed.of(hand.view().object);
    std::optional<client::HandSample> input;
    // The hand does not move while the server does not receive it.
    if (senses && joined) input = hand.advance(to_seconds(now - last), *senses);
    last = now;
    show(state_);
    if (input) (void)client.send(*input);
    clock.sleep_until(now + kSendEvery);
  }
}

}  // namespace mechane::pointer
