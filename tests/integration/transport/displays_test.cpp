// Displays and technicians over the loopback: a status goes out, requests come in, invalid samples are refused.
#include <cstring>

#include <gmock/gmock.h>

#include "client-sdk/display/kiosk_desk.hpp"
#include "tests/integration/transport/loopback.hpp"
#include <mechane/client/displays.hpp>
#include <mechane/proto/convert.hpp>

namespace mechane::test {
namespace {

using client::DisplayStatus;
using client::RequestAnswer;
using display::KioskDesk;
using namespace std::chrono_literals;
using testing::HasSubstr;

/// A display without a picture: its client, and its desk.
struct Desk {
  explicit Desk(const std::string& name, bool has_folder = false) {
    auto made =
        client::Client::connect({.kiosk = "kiosk-1", .program = "tester", .domain = kClientDomain, .display = name});
    if (!made) {
      ADD_FAILURE() << made.error().to_string();
      return;
    }
    client = std::move(*made);
    display::DisplayIdentity identity;
    identity.kiosk = "kiosk-1";
    identity.name = name;
    identity.renderer = "none";
    identity.has_folder = has_folder;
    desk = std::make_unique<display::KioskDesk>(*client, identity, client::DisplaySettings{}, now());
  }
  static TimePoint now() { return std::chrono::steady_clock::now(); }
  /// As a display does in each turn of its loop.
  void turn() {
    if (desk->take_requests(style)) ++changes;
    display::DisplayFacts facts;
    facts.size = {640, 360};
    if (desk->report_due(now())) desk->report(facts, now());
  }

  std::unique_ptr<client::Client> client;
  std::unique_ptr<display::KioskDesk> desk;
  picture::OverlayStyle style;
  int changes = 0;
};

class Displays : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(museum_domain_.good());
    ASSERT_TRUE(client_domain_.good());
    auto opened = client::DisplayWatch::open(kServerDomain);
    ASSERT_TRUE(opened.has_value()) << opened.error().to_string();
    watch_ = std::move(*opened);
  }
  /// The status of one of the desks, once it fulfils a request.
  std::optional<DisplayStatus> told(const std::vector<Desk*>& desks, const std::string& name,
                                    const std::function<bool(const DisplayStatus&)>& wanted) {
    std::optional<DisplayStatus> found;
    eventually(
        [&] {
          for (const DisplayStatus& status : watch_->displays()) {
            if (status.display == name && wanted(status)) found = status;
          }
          return found.has_value();
        },
        10s,
        [&] {
          for (Desk* desk : desks)
            desk->turn();
        });
    return found;
  }
  static bool answers(const DisplayStatus& status, std::uint64_t id) {
    return std::ranges::find(status.answers, id, &RequestAnswer::id) != status.answers.end();
  }

  LoopbackDomain museum_domain_{kServerDomain, 0};
  LoopbackDomain client_domain_{kClientDomain, 0};
  std::unique_ptr<client::DisplayWatch> watch_;
};

TEST_F(Displays, ARequestReachesTheDisplaysThatItNamesAndIsAnsweredInTheirStatus) {
  Desk wall("wall"), bystanders("bystanders");
  const std::vector<Desk*> both{&wall, &bystanders};
  ASSERT_TRUE(told(both, "wall", [](const DisplayStatus& s) { return s.width == 640; }));
  ASSERT_TRUE(told(both, "bystanders", [](const DisplayStatus&) { return true; }));
  const auto one = watch_->request("kiosk-1", "wall", {.settings = {{"volume", "0.5"}}});
  ASSERT_TRUE(one.has_value());
  const auto all = watch_->request("kiosk-1", "", {.settings = {{"language", "en"}}});
  ASSERT_TRUE(all.has_value());
  const auto elsewhere = watch_->request("kiosk-2", "", {.settings = {{"mute", "on"}}});
  ASSERT_TRUE(elsewhere.has_value());
  const auto at_wall = told(both, "wall", [&](const DisplayStatus& s) { return answers(s, *one) && answers(s, *all); });
  const auto beside = told(both, "bystanders", [&](const DisplayStatus& s) { return answers(s, *all); });
  ASSERT_TRUE(at_wall && beside);
  EXPECT_EQ(at_wall->answers[0].refusal, "");
  EXPECT_EQ(beside->answers.size(), 1U);
  EXPECT_EQ(wall.desk->settings().volume, 0.5);
  EXPECT_EQ(bystanders.desk->settings().volume, client::DisplaySettings{}.volume);
  EXPECT_FALSE(wall.desk->settings().muted);
  EXPECT_EQ(at_wall->settings, client::settings_of(wall.desk->settings()));
  EXPECT_EQ(at_wall->link, 0U);
}

TEST_F(Displays, WhatALyingClientRequestsIsRefusedAndChangesNothing) {
  Desk wall("wall");
  ASSERT_TRUE(told({&wall}, "wall", [](const DisplayStatus&) { return true; }));
  EXPECT_FALSE(watch_->request("kiosk-1", "", {.settings = {{"volume", "2"}}}).has_value())
      << "the honest one asks first";
  auto participant = proto::Participant::create(kServerDomain);
  ASSERT_TRUE(participant.has_value());
  auto liar = proto::Writer<proto::DisplayRequest>::create(*participant, "");
  ASSERT_TRUE(liar.has_value());
  std::vector<proto::WireSetting> lies(2);
  proto::set_text(lies[0].name, "large-text");
  proto::set_text(lies[0].value, "on");
  std::memset(&lies[1], 0xff, sizeof(lies[1]));
  lies[1].name[sizeof(lies[1].name) - 1] = lies[1].value[sizeof(lies[1].value) - 1] = '\0';
  proto::DisplayRequest wire{};
  proto::set_text(wire.kiosk, "kiosk-1");
  wire.protocol = proto::kProtocol;
  wire.id = 77;
  wire.picture = true;
  proto::look_into(wire.settings, lies);
  ASSERT_TRUE(liar->write(wire));
  wire.id = 78;
  wire.picture = false;
  ASSERT_TRUE(liar->write(wire));
  const auto status = told({&wall}, "wall", [](const DisplayStatus& s) { return answers(s, 77) && answers(s, 78); });
  ASSERT_TRUE(status);
  EXPECT_THAT(status->answers[0].refusal, HasSubstr("--out"));
  EXPECT_THAT(status->answers[1].refusal, HasSubstr("a display has no setting"));
  EXPECT_EQ(wall.desk->settings(), client::DisplaySettings{});
  EXPECT_EQ(wall.changes, 0);
}

TEST_F(Displays, APictureIsAnsweredWhenItIsWrittenAndKeysOfVisitorsAreTold) {
  Desk wall("wall", true);
  ASSERT_TRUE(told({&wall}, "wall", [](const DisplayStatus&) { return true; }));
  const auto requested = watch_->request("kiosk-1", "wall", {.picture = true});
  ASSERT_TRUE(requested.has_value());
  ASSERT_TRUE(eventually([&] { return wall.desk->picture_wanted(); }, 10s, [&] { wall.turn(); }));
  wall.style.high_contrast = true;
  const std::vector<std::uint64_t> requests = wall.desk->take_picture_requests();
  EXPECT_FALSE(wall.desk->picture_wanted()) << "one is enough, while it is being written";
  wall.desk->picture_taken(requests, "out/one.png");
  const auto status = told({&wall}, "wall", [&](const DisplayStatus& s) { return answers(s, *requested); });
  ASSERT_TRUE(status);
  EXPECT_EQ(status->answers[0].picture, "out/one.png");
  EXPECT_EQ(status->answers[0].refusal, "");
  EXPECT_EQ(wall.changes, 0) << "a key of a visitor is not a request";
  EXPECT_TRUE(told({&wall}, "wall", [](const DisplayStatus& s) {
    return std::ranges::count(s.settings, client::DisplaySetting{"high-contrast", "on"}) == 1;
  }));
}

TEST_F(Displays, ARestartIsAnsweredBeforeTheDisplayEnds) {
  Desk wall("wall"), bystanders("bystanders");
  const std::vector<Desk*> both{&wall, &bystanders};
  ASSERT_TRUE(told(both, "wall", [](const DisplayStatus&) { return true; }));
  const auto requested = watch_->request("kiosk-1", "wall", {.restart = true});
  ASSERT_TRUE(requested.has_value());
  const auto status = told(both, "wall", [&](const DisplayStatus& s) { return answers(s, *requested); });
  ASSERT_TRUE(status);
  EXPECT_EQ(status->answers[0].refusal, "");
  EXPECT_TRUE(wall.desk->restart_wanted());
  EXPECT_FALSE(bystanders.desk->restart_wanted());
}

TEST_F(Displays, ATrackersHeadComesToTheScreensThatItIsBefore) {
  Desk wall("wall");
  Desk bystanders("bystanders");
  const auto beside = client::HeadTracker::open("kiosk-1", "bystanders", kServerDomain);
  ASSERT_TRUE(beside.has_value());
  const Pose X_SV{Vec3(0.25, -0.5, 1.5), Quat(Eigen::AngleAxisd(0.2, Vec3::UnitZ()))};
  const auto hears = [&](Desk& desk, const Vec3& p_SV) {
    const auto head = desk.client->viewer_head();
    return head && head->seen && head->X_SV.p == p_SV;
  };
  ASSERT_TRUE(eventually([&] { return hears(bystanders, X_SV.p); }, 10s, [&] { (void)(*beside)->tell(X_SV); }));
  EXPECT_FALSE(wall.client->viewer_head().has_value());
  EXPECT_LT(bystanders.client->viewer_head()->X_SV.R.angularDistance(X_SV.R), 1e-6);
  const auto all = client::HeadTracker::open("kiosk-1", "", kServerDomain);
  ASSERT_TRUE(all.has_value());
  const Pose other{Vec3(0, 0, 2), Quat::Identity()};
  ASSERT_TRUE(eventually([&] { return hears(wall, other.p) && hears(bystanders, other.p); }, 10s,
                         [&] { (void)(*all)->tell(other); }));
  EXPECT_FALSE((*all)->tell({Vec3(0, 0, std::nan("")), Quat::Identity()}));
  EXPECT_FALSE((*all)->tell({Vec3::Zero(), Quat(0, 0, 0, 0)}));
  EXPECT_TRUE(hears(wall, other.p)) << "what is not a pose is not sent";
  ASSERT_TRUE(eventually([&] { return !wall.client->viewer_head()->seen; }, 10s, [&] { (void)(*all)->tell_nobody(); }));
  EXPECT_FALSE(client::HeadTracker::open("kiosk 1", "", kServerDomain).has_value());
}

TEST_F(Displays, AreToldAtOnceWhatTheStateOfTheirKiosksDeviceIsUntilItsProgramEnds) {
  using client::DeviceReport;
  using client::DeviceState;
  Desk wall("wall");
  const auto hand = [](const std::string& kiosk, std::uint32_t user) {
    return *client::Client::connect(
        {.kiosk = kiosk, .user = user, .role = client::Role::hand, .program = "tester", .domain = kServerDomain});
  };
  auto haptic = hand("kiosk-1", 1), elsewhere = hand("kiosk-2", 0);
  elsewhere->tell_device({.state = DeviceState::hot});
  const auto hears = [&](const DeviceReport& report) {
    return wall.client->devices() == std::vector<DeviceReport>{report};
  };
  const DeviceReport glove{1, DeviceState::preparing, client::HandKind::glove, client::HandSide::left, "Glove"};
  haptic->tell_device(glove);
  ASSERT_TRUE(eventually([&] { return hears(glove); }, 10s));
  const auto museum = [&] {
    std::vector<std::pair<std::string, DeviceReport>> all;
    for (const client::KioskDevice& device : watch_->devices())
      all.emplace_back(device.kiosk, device.report);
    return all;
  };
  const DeviceReport hot{.user = 0, .state = DeviceState::hot};
  EXPECT_TRUE(eventually([&] { return museum() == decltype(museum()){{"kiosk-1", glove}, {"kiosk-2", hot}}; }, 10s));
  Duration fastest = 10s;
  for (const DeviceState state : {DeviceState::ready, DeviceState::lost, DeviceState::ready, DeviceState::warm}) {
    const TimePoint told = Desk::now();
    haptic->tell_device({.state = state});
    ASSERT_TRUE(eventually([&] { return hears({.user = 1, .state = state}); }, 10s));
    fastest = std::min(fastest, Desk::now() - told);
  }
  EXPECT_LT(fastest, 200ms) << "not only once a second";
  haptic.reset();
  EXPECT_TRUE(eventually([&] { return wall.client->devices().empty() && museum().size() == 1; }, 10s));
}

TEST_F(Displays, AreListedUpToALimit) {
  constexpr std::size_t kMost = client::DisplayWatch::kMostDisplays;
  auto participant = proto::Participant::create(kServerDomain);
  ASSERT_TRUE(participant.has_value());
  auto crowd = proto::Writer<proto::DisplayStatus>::create(*participant, "");
  ASSERT_TRUE(crowd.has_value());
  proto::DisplayStatus wire{};
  proto::set_text(wire.kiosk, "kiosk-1");
  proto::set_text(wire.display, "crowd");
  wire.protocol = proto::kProtocol;
  const auto tell = [&](std::uint64_t session, std::uint64_t uptime_s) {
    wire.session = session;
    wire.uptime_s = uptime_s;
    return crowd->write(wire);
  };
  for (std::uint64_t session = 1; session <= kMost; ++session)
    ASSERT_TRUE(tell(session, 0));
  ASSERT_TRUE(eventually([&] { return watch_->displays().size() == kMost; }));
  ASSERT_TRUE(tell(kMost + 1, 0));
  ASSERT_TRUE(tell(1, 7));
  ASSERT_TRUE(eventually([&] { return watch_->displays().front().uptime_s == 7; })) << "one that is listed goes on";
  EXPECT_EQ(watch_->displays().size(), kMost);
}

TEST_F(Displays, OneThatEndedIsGone) {
  Desk wall("wall");
  ASSERT_TRUE(told({&wall}, "wall", [](const DisplayStatus&) { return true; }));
  wall.client.reset();
  EXPECT_TRUE(eventually([&] { return watch_->displays().empty(); }));
}

}  // namespace
}  // namespace mechane::test
