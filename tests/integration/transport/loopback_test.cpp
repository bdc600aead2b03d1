#include "tests/integration/transport/loopback.hpp"

#include <algorithm>
#include <limits>

#include <mechane/proto/convert.hpp>

namespace mechane::test {
namespace {

using client::HandSample;
using client::LinkState;
using client::Role;
using namespace std::chrono_literals;

TEST_F(Loopback, AHandArrivesToTheBitAndItsForceComesBackWithItsEcho) {
  EchoServer server;
  auto client = connect(Role::hand);
  ASSERT_TRUE(client->wait_for(LinkState::joined, 10s));
  ASSERT_TRUE(feels(*client, Vec3(0, 0, 0.5)));

  HandSample input;
  input.kind = client::HandKind::glove;
  input.X_WH.p = Vec3(0.25, -1.5, 3.125);
  input.X_WH.R = Quat(0.5, 0.5, -0.5, 0.5);
  input.V_WH = {Vec3(1, 2, 3), Vec3(-4, 5, -6)};
  for (std::size_t i = 0; i < input.joints.size(); ++i)
    input.joints[i] = 0.0625 * static_cast<double>(i);
  input.side = client::HandSide::left;
  input.hand_scale = 1.25;
  input.finger_scale = {0.75, 0.875, 1, 1.125, 1.25};
  input.buttons = 0xa5a5a5a5u;
  input.grasp_intent = 0.75;
  ASSERT_TRUE(eventually([&] {
    client->send(input);
    const auto force = client->wait_force(50ms);
    return force && force->force_W.f == input.X_WH.p && force->echo_sequence <= client->sent_sequence() &&
           force->received >= force->echo_sent() && force->received - force->echo_sent() < 1s;
  }));
  const auto samples = server.samples();
  ASSERT_FALSE(samples.empty());
  const hand::SentSample& s = samples.back();
  EXPECT_EQ(s.session, client->session());
  EXPECT_EQ(s.kind, hand::HandKind::glove);
  EXPECT_EQ(s.X_WH.p, input.X_WH.p);
  EXPECT_EQ(s.X_WH.R.coeffs(), input.X_WH.R.coeffs());
  EXPECT_EQ(s.V_WH.v, input.V_WH.v);
  EXPECT_EQ(s.V_WH.w, input.V_WH.w);
  EXPECT_EQ(s.joints, input.joints);
  EXPECT_EQ(static_cast<const hand::HandBuild&>(s), static_cast<const hand::HandBuild&>(input));
  EXPECT_EQ(s.buttons, 0xa5a5a5a5u);
  EXPECT_EQ(s.grasp_intent, 0.75);
}

TEST_F(Loopback, AWatcherLearnsManifestStatusFramesAndCommandsAreAnswered) {
  EchoServer server;
  auto hand = connect(Role::hand, "hand", 2);
  auto watcher = connect(Role::watcher, "watcher");
  ASSERT_TRUE(watcher->wait_for(LinkState::joined, 10s));
  ASSERT_TRUE(hand->wait_for(LinkState::joined, 10s));
  ASSERT_TRUE(eventually([&] { return watcher->objects().size() == 3 && watcher->world_status(); }));
  EXPECT_EQ(watcher->objects()[1].name, "BODY_1");
  EXPECT_EQ(watcher->objects()[1].mesh_uri, "models/small.glb");
  EXPECT_FALSE(watcher->objects()[0].movable);
  EXPECT_TRUE(eventually([&] { return watcher->world_status()->step == "turn"; }));
  EXPECT_EQ(watcher->world_status()->title.at("el"), "Μικρός κόσμος");
  EXPECT_EQ(watcher->world_status()->caption.at("en"), "Turn the crank");
  EXPECT_EQ(watcher->world_status()->steps_total, 1u);
  const std::vector<client::QuantityInfo> quantities = watcher->world_status()->quantities;
  ASSERT_EQ(quantities.size(), 1u);
  ASSERT_TRUE(quantities[0].goal) << "what the step's first trigger says first";
  EXPECT_EQ(quantities[0].goal->value, 15);
  EXPECT_FALSE(quantities[0].goal->from_above);
  EXPECT_EQ(quantities[0].label, (client::Texts{{"en", "Water in the basin"}}));
  ASSERT_TRUE(quantities[0].range);
  EXPECT_EQ(quantities[0].range->least, -5);
  EXPECT_EQ(quantities[0].range->greatest, 40);
  EXPECT_TRUE(eventually([&] { return watcher->server_status() && watcher->server_status()->version == "1.2.3"; }));

  client::Frame frame;
  EXPECT_TRUE(eventually(
      [&] {
        return watcher->newest_frame(frame) && frame.hands.size() == 1 && frame.hands[0].user == 2 &&
               frame.hands[0].X_WS[0].p == Vec3(0, 0, 1) + test::kShown_W;
      },
      10s, [&] { hand->send(hand_at(Vec3(0, 0, 1))); }));
  EXPECT_EQ(frame.bodies.size(), 2u);  // the fixed one is in the manifest only
  EXPECT_EQ(frame.quantities.size(), 1u);
  EXPECT_TRUE(watcher->interpolated_frame(std::chrono::steady_clock::now(), 32ms, frame));

  const std::uint64_t good = watcher->start_activity("use");
  const std::uint64_t bad = watcher->start_activity("no such activity");
  ASSERT_NE(good, 0u);
  bool done = false;
  bool refused = false;
  EXPECT_TRUE(eventually([&] {
    for (const client::WorldEvent& event : watcher->take_events()) {
      done = done || (event.kind == "command_done" && event.value == static_cast<double>(good));
      refused = refused || (event.kind == "command_refused" && event.value == static_cast<double>(bad));
    }
    return done && refused;
  }));
}

TEST_F(Loopback, AWatcherLearnsWhatToShowAndItsVisitorAnswers) {
  EchoServer server;
  auto watcher = connect(Role::watcher, "watcher");
  ASSERT_TRUE(watcher->wait_for(LinkState::joined, 10s));
  ASSERT_TRUE(eventually([&] { return watcher->presentation() && watcher->world_status(); }));
  const client::WorldPresentation shown = *watcher->presentation();
  EXPECT_EQ(shown.languages, (std::vector<std::string>{"el", "en"}));
  ASSERT_EQ(shown.views.size(), 1U);
  EXPECT_EQ(shown.views[0].name, "NEAR");
  EXPECT_EQ(shown.views[0].X_WV.p, Vec3(0, 1.5, 2));
  ASSERT_EQ(shown.effects.size(), 1U);
  EXPECT_EQ(shown.effects[0].object, 1U);
  EXPECT_EQ(shown.effects[0].p_BE, Vec3(0, 0.25, 0));
  EXPECT_EQ(shown.effects[0].full, 2);
  ASSERT_EQ(shown.activities.size(), 1U);
  EXPECT_EQ(shown.activities[0].goal.at("en"), "Cranks turn.");
  ASSERT_EQ(shown.activities[0].questions.size(), 1U);
  EXPECT_EQ(shown.activities[0].questions[0].marks, 5U);
  EXPECT_EQ(shown.activities[0].questions[0].high.at("en"), "much");
  EXPECT_TRUE(eventually([&] { return watcher->world_status()->detail == "NEAR"; }));
  EXPECT_EQ(watcher->world_status()->narration.at("en"), "A crank has an arm.");
  ASSERT_TRUE(eventually([&] { return watcher->objects().size() == 3; }));
  EXPECT_EQ(watcher->objects()[1].title, (client::Texts{{"el", "Η μανιβέλα"}, {"en", "The crank"}}));
  EXPECT_TRUE(watcher->objects()[2].title.empty());

  client::Frame frame;
  ASSERT_TRUE(eventually([&] { return watcher->newest_frame(frame) && frame.ropes.size() == 1; }));
  EXPECT_NEAR(frame.ropes[0].diameter_m, 0.02, 1e-6);
  EXPECT_EQ(frame.ropes[0].points_W.front(), Vec3(0, 0, 0));
  EXPECT_EQ(frame.ropes[0].points_W.back(), Vec3(2, 0, 0));

  const std::uint64_t good = watcher->answer({client::AnswerTime::after, "use", "liked", "4"});
  const std::uint64_t bad = watcher->answer({client::AnswerTime::after, "use", "liked", "6"});
  bool done = false, refused = false;
  EXPECT_TRUE(eventually([&] {
    for (const client::WorldEvent& event : watcher->take_events()) {
      done = done || (event.kind == "command_done" && event.value == static_cast<double>(good));
      refused = refused || (event.kind == "command_refused" && event.value == static_cast<double>(bad));
    }
    return done && refused && server.answers().size() == 1;
  }));
  EXPECT_EQ(server.answers().at(0).answer, 4U);
  EXPECT_EQ(server.answers().at(0).when, state::AnswerTime::after);

  const std::uint64_t spoken = watcher->tell_language(shown.languages.at(0));
  const std::uint64_t foreign = watcher->tell_language("tlh");
  done = refused = false;
  EXPECT_TRUE(eventually([&] {
    for (const client::WorldEvent& event : watcher->take_events()) {
      done = done || (event.kind == "command_done" && event.value == static_cast<double>(spoken));
      refused = refused || (event.kind == "command_refused" && event.value == static_cast<double>(foreign));
    }
    return done && refused && server.languages().size() == 1;
  }));
  EXPECT_EQ(server.languages().at(0), 0U);
}

TEST_F(Loopback, ACommandOfNoKindIsRefused) {
  EchoServer server;
  auto watcher = connect(Role::watcher, "watcher");
  ASSERT_TRUE(watcher->wait_for(LinkState::joined, 10s));
  auto participant = proto::Participant::create(kClientDomain);
  ASSERT_TRUE(participant);
  auto writer = proto::Writer<proto::Command>::create(*participant, proto::world_partition("w1"));
  ASSERT_TRUE(writer);
  ASSERT_TRUE(eventually([&] { return writer->matched() > 0; }));
  proto::Command command{};
  proto::set_text(command.scope, proto::world_partition("w1"));
  command.protocol = proto::kProtocol;
  command.session = 77;
  const std::string nothing;
  command.argument = proto::look_into(nothing);
  command.id = 1;
  command.kind = mechane_command_none;
  ASSERT_TRUE(writer->write(command));
  bool refused = false;
  EXPECT_TRUE(eventually([&] {
    for (const client::WorldEvent& event : watcher->take_events())
      refused = refused || (event.kind == "command_refused" && event.value == 1);
    return refused;
  }));
}

TEST_F(Loopback, TheFirstSessionKeepsTheHandAndTheNextHasItWhenTheFirstIsGone) {
  EchoServer server;
  auto first = connect(Role::hand, "first-program");
  ASSERT_TRUE(first->wait_for(LinkState::joined, 10s));
  auto second = connect(Role::hand, "second-program");
  // The first goes on sending while the second asks.
  ASSERT_TRUE(eventually([&] { return second->state() == LinkState::refused; }, 10s,
                         [&] { first->send(hand_at(Vec3(1, 0, 0))); }));
  EXPECT_NE(second->refusal().find("first-program"), std::string::npos) << second->refusal();
  EXPECT_FALSE(second->send(hand_at(Vec3(2, 0, 0))));
  EXPECT_TRUE(feels(*first, Vec3(3, 0, 0)));

  first.reset();
  ASSERT_TRUE(second->wait_for(LinkState::joined, 10s));
  EXPECT_TRUE(second->refusal().empty());
  EXPECT_TRUE(feels(*second, Vec3(4, 0, 0)));
}

TEST_F(Loopback, ASilentHandIsTakenOverByOneThatWaits) {
  EchoServer server;
  auto silent = connect(Role::hand, "silent");
  ASSERT_TRUE(silent->wait_for(LinkState::joined, 10s));
  ASSERT_TRUE(feels(*silent, Vec3(1, 0, 0)));
  auto eager = connect(Role::hand, "eager");
  ASSERT_TRUE(eager->wait_for(LinkState::joined, 10s));
  EXPECT_TRUE(feels(*eager, Vec3(2, 0, 0)));
  EXPECT_TRUE(silent->wait_for(LinkState::refused, 10s));

  // Back again, though the server has sent hundreds of forces meanwhile that this hand never saw.
  for (int i = 0; i < 300; ++i)
    ASSERT_TRUE(feels(*eager, Vec3(2 + 0.01 * i, 0, 0)));
  eager.reset();
  ASSERT_TRUE(silent->wait_for(LinkState::joined, 10s));
  EXPECT_TRUE(feels(*silent, Vec3(3, 0, 0)));
}

TEST_F(Loopback, AClientComesBackByItselfAfterTheServerDid) {
  auto server = std::make_unique<EchoServer>();
  auto hand = connect(Role::hand);
  ASSERT_TRUE(hand->wait_for(LinkState::joined, 10s));
  ASSERT_TRUE(feels(*hand, Vec3(1, 0, 0)));
  std::uint64_t last = 0;
  ASSERT_TRUE(eventually([&] {
    hand->send(hand_at(Vec3(1, 0, 0)));
    const auto force = hand->wait_force(50ms);
    if (force) last = force->sequence;
    return last > 20;
  }));

  server.reset();
  ASSERT_TRUE(hand->wait_for(LinkState::lost, 10s));
  EXPECT_FALSE(hand->send(hand_at(Vec3(2, 0, 0))));

  server = std::make_unique<EchoServer>();
  ASSERT_TRUE(hand->wait_for(LinkState::joined, 10s));
  bool rose = true;
  EXPECT_TRUE(eventually([&] {
    hand->send(hand_at(Vec3(5, 0, 0)));
    const auto force = hand->wait_force(50ms);
    if (force) rose = rose && force->sequence > last;
    return force && force->force_W.f == Vec3(5, 0, 0);
  }));
  EXPECT_TRUE(rose);  // though the server counts from 1 again
  EXPECT_TRUE(eventually([&] { return hand->objects().size() == 3; }));
}

TEST_F(Loopback, AHandThatWasSilentFeelsAgainHoweverLongItHadBeenInUse) {
  EchoServer server;
  auto hand = connect(Role::hand);
  ASSERT_TRUE(hand->wait_for(LinkState::joined, 10s));
  std::uint64_t last = 0;
  const auto newest = [&](const Vec3& p) {
    hand->send(hand_at(p));
    const auto force = hand->wait_force(1ms);
    if (force) last = force->sequence;
    return force;
  };
  ASSERT_TRUE(eventually([&] { return newest(Vec3(1, 0, 0)) && last > 2000; }, 30s));

  const std::size_t news_before = server.news().size();
  server.forget_sessions();
  // The server's news, and not the client's state: that may be lost for so short a time that nobody sees it.
  ASSERT_TRUE(eventually([&] {
    const auto news = server.news();
    const auto since = news.begin() + static_cast<std::ptrdiff_t>(news_before);
    const auto freed = std::find(since, news.end(), transport::NewsKind::hand_freed);
    return std::find(freed, news.end(), transport::NewsKind::hand_granted) != news.end();
  }));
  ASSERT_TRUE(hand->wait_for(LinkState::joined, 10s));
  const std::uint64_t before = last;
  const std::size_t arrived_before = server.samples().size();
  ASSERT_TRUE(eventually([&] {
    const auto force = newest(Vec3(5, 0, 0));
    return force && force->force_W.f == Vec3(5, 0, 0);
  }));
  EXPECT_GT(last, before);
  EXPECT_LT(server.samples().size() - arrived_before, 1000u) << "as many answers were thrown away as had come before";
}

TEST_F(Loopback, PausesOfAHandAreCountedButNotThoseBetweenTaps) {
  EchoServer server;
  auto hand = connect(Role::hand);
  ASSERT_TRUE(hand->wait_for(LinkState::joined, 10s));
  ASSERT_TRUE(feels(*hand, Vec3(1, 0, 0)));
  const auto gaps = [&] { return server.transport().input_gaps(); };
  realtime::Wakeup never;
  const std::uint64_t before_taps = gaps();
  for (int tap = 0; tap < 4; ++tap) {
    never.wait(400ms);
    hand->send(hand_at(Vec3(2, 0, 0)));
  }
  EXPECT_EQ(gaps(), before_taps);
  const std::uint64_t before = gaps();
  EXPECT_TRUE(eventually([&] { return gaps() >= before + 5; }, 10s,
                         [&] {
                           never.wait(30ms);
                           hand->send(hand_at(Vec3(3, 0, 0)));
                         }));
}

TEST_F(Loopback, LyingSamplesAreCountedAndNeverReachTheLoop) {
  EchoServer server;
  auto hand = connect(Role::hand);
  ASSERT_TRUE(hand->wait_for(LinkState::joined, 10s));
  ASSERT_TRUE(feels(*hand, Vec3(1, 0, 0)));

  auto participant = proto::Participant::create(kClientDomain);
  ASSERT_TRUE(participant);
  auto liar = proto::Writer<proto::HapticInput>::create(*participant, proto::kiosk_partition("kiosk-1"));
  ASSERT_TRUE(liar);
  ASSERT_TRUE(eventually([&] { return liar->matched() > 0; }));
  std::atomic<std::uint64_t> epoch{0};
  auto outputs = proto::Reader<proto::HapticOutput>::create(*participant, proto::kiosk_partition("kiosk-1"),
                                                            [&](proto::ReaderView<proto::HapticOutput> view) {
                                                              proto::HapticOutput output;
                                                              proto::SampleInfo info;
                                                              while (view.take_into(output, info))
                                                                epoch.store(output.epoch);
                                                            });
  ASSERT_TRUE(outputs);
  ASSERT_TRUE(eventually([&] { return feels(*hand, Vec3(1.5, 0, 0)) && epoch.load() != 0; }));
  proto::HapticInput honest{};
  proto::set_text(honest.kiosk, "kiosk-1");
  honest.protocol = proto::kProtocol;
  honest.session = hand->session();
  honest.seq = 1'000'000;
  honest.hand_scale = 1;
  std::ranges::fill(honest.finger_scale, 1.0F);
  honest.X_WH.q[0] = 1;
  honest.X_WH.p[0] = -7;

  using transport::Reject;
  const auto lie = [&](Reject expected, const std::function<void(proto::HapticInput&)>& change) {
    proto::HapticInput sample = honest;
    change(sample);
    const std::uint64_t before = server.transport().rejected().count(expected);
    EXPECT_TRUE(eventually([&] { return server.transport().rejected().count(expected) > before; }, 10s,
                           [&] { liar->write(sample); }))
        << transport::to_string(expected);
  };
  lie(Reject::wrong_protocol, [](auto& s) { s.protocol = proto::kProtocol + 1; });
  lie(Reject::not_finite, [](auto& s) { s.v_WH[1] = std::numeric_limits<float>::quiet_NaN(); });
  lie(Reject::too_far, [](auto& s) { s.X_WH.p[2] = 1e9f; });
  lie(Reject::too_fast, [](auto& s) { s.v_WH[0] = 1e3f; });
  lie(Reject::bad_rotation, [](auto& s) { s.X_WH.q[0] = 2; });
  lie(Reject::bad_size, [](auto& s) { s.hand_scale = 40; });
  lie(Reject::bad_value, [](auto& s) { s.kind = 9; });
  lie(Reject::wrong_kiosk, [](auto& s) { proto::set_text(s.kiosk, "kiosk-2"); });
  lie(Reject::wrong_session, [](auto& s) { s.session += 2; });
  EXPECT_TRUE(feels(*hand, Vec3(2, 0, 0)));
  lie(Reject::old_sequence, [](auto& s) { s.seq = 1; });
  lie(Reject::high_sequence, [](auto& s) { s.seq = std::numeric_limits<std::uint64_t>::max(); });
  lie(Reject::bad_value, [&](auto& s) {
    s.echo_epoch = epoch.load();
    s.echo_seq = std::numeric_limits<std::uint64_t>::max();
  });
  lie(Reject::too_late, [&](auto& s) {
    s.echo_epoch = epoch.load();
    s.echo_seq = 1;
    s.echo_held_us = 0;
  });
  EXPECT_TRUE(feels(*hand, Vec3(3, 0, 0))) << "one sample with a false number must not block the hand";
  for (const hand::SentSample& sample : server.samples())
    EXPECT_NE(sample.X_WH.p.x(), -7);
}

TEST(LossyLoopback, FivePercentLossIsSurvived) {
  LoopbackDomain server_domain(kServerDomain, 50);
  LoopbackDomain client_domain(kClientDomain, 50);
  ASSERT_TRUE(server_domain.good() && client_domain.good());
  EchoServer server(small_world(60));
  auto hand = connect(Role::hand);
  ASSERT_TRUE(hand->wait_for(LinkState::joined, 20s));
  // Reliable topics arrive in full.
  EXPECT_TRUE(eventually([&] { return hand->objects().size() == 60; }));
  std::size_t answered = 0;
  for (int i = 0; i < 20; ++i) {
    const std::uint64_t id = hand->next_step();
    answered += eventually([&] {
      for (const client::WorldEvent& event : hand->take_events()) {
        if (event.value == static_cast<double>(id)) return true;
      }
      return false;
    });
  }
  EXPECT_EQ(answered, 20u);
  // Of the 1 kHz streams most arrive: both ways lose 5 %.
  int forces = 0;
  for (int i = 0; i < 500; ++i) {
    hand->send(hand_at(Vec3(1, 0, 0)));
    forces += hand->wait_force(20ms).has_value();
  }
  EXPECT_GT(forces, 400);
}

}  // namespace
}  // namespace mechane::test
