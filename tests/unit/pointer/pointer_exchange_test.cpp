#include "client-sdk/pointer/pointer_exchange.hpp"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace mechane::pointer {
namespace {

using Phase = PointerView::Phase;

picture::Sight sight_on_origin() {
  picture::Camera camera;
  camera.p_WC = Vec3(0, 0, 2);
  camera.p_WT = Vec3::Zero();
  return {picture::eye_view(camera, picture::Eye::middle, 16.0 / 9), {1280, 720}};
}

PointerAct press_on(std::uint32_t object) {
  picture::Touched touched;
  touched.object = object;
  return {PointerAct::Kind::press, {640, 360}, 0, sight_on_origin(), touched};
}

PointerAct move_to(double x) {
  return {PointerAct::Kind::move, {x, 360}};
}

TEST(PointerExchange, the_display_sees_at_once_what_it_did_and_the_hand_follows) {
  PointerExchange exchange;
  EXPECT_EQ(exchange.view().phase, Phase::resting);
  EXPECT_EQ(exchange.state(), PointerLinkState::none);
  exchange.act(press_on(7));
  EXPECT_EQ(exchange.view().phase, Phase::reaching) << "nobody has taken it yet";
  EXPECT_EQ(exchange.view().object, 7U);
  EXPECT_TRUE(exchange.resting());
  exchange.take_acts();
  EXPECT_FALSE(exchange.resting());
  exchange.publish(PointerLinkState::waiting);
  EXPECT_EQ(exchange.state(), PointerLinkState::waiting);
  exchange.act(move_to(700));
  EXPECT_EQ(exchange.view().pointer.x, 700) << "on top of what was published";
  exchange.take_acts();
  exchange.publish(PointerLinkState::joined);
  EXPECT_EQ(exchange.view().pointer.x, 700);
  exchange.hand() = PointerHand();  // the server let go of everything
  exchange.publish(PointerLinkState::refused);
  EXPECT_EQ(exchange.view().phase, Phase::resting) << "an act counts once";
  EXPECT_EQ(exchange.state(), PointerLinkState::refused);
}

TEST(PointerExchange, nothing_is_lost_while_the_hand_sleeps_long) {
  PointerExchange exchange;
  exchange.act(press_on(3));
  for (int i = 0; i < 2000; ++i)
    exchange.act(move_to(i % 1000));
  exchange.act(move_to(321));
  EXPECT_EQ(exchange.view().pointer.x, 321);
  for (int rounds = 0; rounds < 20; ++rounds) {
    exchange.take_acts();
    exchange.publish(PointerLinkState::joined);
    (void)exchange.view();  // once a picture
  }
  EXPECT_EQ(exchange.hand().view().object, 3U);
  EXPECT_EQ(exchange.hand().view().pointer.x, 321);
}

TEST(PointerExchange, two_threads_agree_in_the_end) {
  PointerExchange exchange;
  std::atomic<bool> stop{false};
  std::jthread hand([&] {
    while (!stop) {
      exchange.take_acts();
      exchange.publish(PointerLinkState::joined);
      exchange.wait(std::chrono::milliseconds(1));
    }
  });
  exchange.act(press_on(5));
  for (int i = 1; i <= 20'000; ++i) {
    exchange.act(move_to(i % 1280));
    const PointerView seen = exchange.view();
    ASSERT_EQ(seen.pointer.x, i % 1280) << "never an older place";
    ASSERT_EQ(seen.object, 5U);
  }
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (exchange.state() != PointerLinkState::joined) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    std::this_thread::yield();
  }
  stop = true;
  exchange.wake();
  hand.join();
  // On a busy machine the hand's thread may have taken nothing yet, and the ring is full.
  for (int rounds = 0; rounds < 100; ++rounds) {
    exchange.take_acts();
    (void)exchange.view();
  }
  EXPECT_EQ(exchange.hand().view().pointer.x, 20'000 % 1280);
}

}  // namespace
}  // namespace mechane::pointer
