#include "client-sdk/gateway/browsers/tracked_hands.hpp"

#include <chrono>
#include <utility>

#include <nlohmann/json.hpp>

#include "client-sdk/gateway/browsers/browser_text.hpp"
#include "client-sdk/pointer/free_hand.hpp"
#include "server/base/thread_setup.hpp"

namespace mechane::gateway {
namespace {

using pointer::PointerLinkState;

constexpr Duration kSampleEvery = std::chrono::milliseconds(2);  // the server rejects samples older than 10 ms
constexpr Duration kUnseenStays = std::chrono::seconds(10);
constexpr Duration kLookForHand = std::chrono::milliseconds(500);

}  // namespace

TrackedLink::TrackedLink(std::string kiosk, std::uint32_t domain)
    : kiosk_(std::move(kiosk)), domain_(domain), thread_([this] { run(); }) {}

TrackedLink::~TrackedLink() {
  stop_ = true;
  wakeup_.signal();
  thread_.join();
}

void TrackedLink::take(const TrackedHand& seen) {
  // An untracked picture would only cover a tracked one that the thread has not read yet.
  if (!seen.tracked) return;
  pictures_.publish({seen, SystemClock().now()});
  wakeup_.signal();
}

void TrackedLink::look(TrackedMotion& motion) {
  if (const Picture* const picture = pictures_.take()) motion.take(picture->hand, picture->at);
}

bool TrackedLink::is_wanted(TrackedMotion& motion) {
  look(motion);
  return !stop_ && motion.is_seen(SystemClock().now());
}

void TrackedLink::run() {
  set_up_thread("tracked-hand");
  TrackedMotion motion;
  while (!stop_) {
    if (is_wanted(motion)) serve(motion);
    (void)wakeup_.wait(kLookForHand);
  }
}

void TrackedLink::serve(TrackedMotion& motion) {
  state_ = PointerLinkState::waiting;
  const auto client = pointer::take_last_hand(kiosk_, domain_, "mechane-gateway", [&] { return is_wanted(motion); });
  if (!client) {
    state_ = PointerLinkState::refused;
    return;
  }
  const pointer::Hurry hurry;
  SystemClock clock;
  for (TimePoint now = clock.now(), seen = now; !stop_ && now - seen < kUnseenStays; now = clock.now()) {
    look(motion);
    if (motion.is_seen(now)) seen = now;
    if (client->state() == client::LinkState::refused) break;
    state_ = client->state() == client::LinkState::joined ? PointerLinkState::joined : PointerLinkState::waiting;
    if (const auto force = client->newest_force()) holds_ = force->holding;
    if (const auto sample = motion.at(now)) (void)client->send(*sample);
    clock.sleep_until(now + kSampleEvery);
  }
  holds_ = false;
  state_ = PointerLinkState::none;
}

void TrackedHands::take(std::span<const TrackedHand> hands) {
  if (hands.empty()) return release();
  for (const TrackedHand& hand : hands) {
    auto& link = links_[static_cast<std::size_t>(hand.side)];
    if (!link && hand.tracked) link = make_();
    if (link) link->take(hand);
    used_ = used_ || link;
  }
}

void TrackedHands::release() {
  for (auto& link : links_)
    if (link) end_(std::exchange(link, nullptr));
}

std::string TrackedHands::text() const {
  if (!used_) return {};
  nlohmann::json out{{"type", "tracked"}, {"hands", nlohmann::json::array()}};
  for (const auto& link : links_)
    out["hands"].push_back(
        {{"link", link_word(link ? link->state() : PointerLinkState::none)}, {"holding", link && link->holds()}});
  return out.dump();
}

}  // namespace mechane::gateway
