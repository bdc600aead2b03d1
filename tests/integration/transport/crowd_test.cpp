// Many programs at one server, many servers, and programs of another version.
#include <set>

#include <gmock/gmock.h>

#include "server/log/log.hpp"
#include "tests/integration/transport/loopback.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::test {
namespace {

using client::LinkState;
using client::Role;
using namespace std::chrono_literals;

/// One process that says that it is many programs, or many servers.
template <class T>
struct Crowd {
  proto::Participant participant = *proto::Participant::create(kClientDomain);
  proto::Writer<T> writer = *proto::Writer<T>::create(participant, "");
};

proto::KioskStatus status_of(const std::string& kiosk, std::uint64_t session) {
  proto::KioskStatus status{};
  proto::set_text(status.kiosk, kiosk);
  status.protocol = proto::kProtocol;
  status.session = session;
  status.role = 1;
  return status;
}

TEST_F(Loopback, WhoFindsNoRoomIsToldAndComesInWhenOthersHaveLeft) {
  log::start("test", log::Level::warning);
  EchoServer server;
  auto crowd = std::make_unique<Crowd<proto::KioskStatus>>();
  ASSERT_TRUE(eventually([&] { return crowd->writer.matched() > 0; }));
  const auto report = [&] {
    for (std::uint64_t i = 0; i < transport::SessionTable::kMaxSessions; ++i)
      crowd->writer.write(status_of("crowd", 2 * i + 2));
  };
  report();
  ASSERT_TRUE(eventually([&] { return server.sessions() == transport::SessionTable::kMaxSessions; }));
  auto late = connect(Role::hand, "late");
  auto among_them = connect(Role::hand, "among-them", 0, "crowd");
  for (const auto* client : {late.get(), among_them.get()}) {
    ASSERT_TRUE(eventually([&] { return client->state() == LinkState::refused; }, 10s, report)) << "not told";
    EXPECT_NE(client->refusal().find("512 programs"), std::string::npos) << client->refusal();
  }
  EXPECT_EQ(server.sessions(), transport::SessionTable::kMaxSessions);
  EXPECT_EQ(log::trouble().count, 1u) << "one warning for both: " << log::trouble().last;

  crowd.reset();
  EXPECT_TRUE(late->wait_for(LinkState::joined, 20s));
  EXPECT_TRUE(among_them->wait_for(LinkState::joined, 20s));
}

/// A full server, without threads of its own, that is told the time.
class FullServer : public Loopback {
 protected:
  static constexpr const char* kCrowd = "zz-crowd";  // the last by name: what is told to it comes after all else

  void SetUp() override {
    Loopback::SetUp();
    transport_ = *transport::ServerTransport::start({.server = "test", .domain = kServerDomain});
    crowd_ = std::make_unique<Crowd<proto::KioskStatus>>();
    told_reader_ = *proto::Reader<proto::WorldAssignment>::create(crowd_->participant, "");
    ASSERT_TRUE(eventually([&] { return crowd_->writer.matched() > 0 && told_reader_.matched() > 0; }));
    hear({});
    ASSERT_EQ(transport_->sessions().sessions().size(), transport::SessionTable::kMaxSessions);
  }

  /// Lets the crowd and these kiosks report, until the server has taken it all.
  void hear(const std::set<std::string>& kiosks) {
    for (std::uint64_t i = 0; i < transport::SessionTable::kMaxSessions; ++i)
      crowd_->writer.write(status_of(kCrowd, 2 * i + 2));
    for (const std::string& kiosk : kiosks)
      crowd_->writer.write(status_of(kiosk, 2 * std::hash<std::string>()(kiosk) + 1));
    proto::KioskStatus last = status_of(kCrowd, 1);
    last.protocol = 0;
    const auto refused = [&] { return transport_->rejected().count(transport::Reject::wrong_protocol); };
    const std::uint64_t before = refused();
    crowd_->writer.write(last);
    ASSERT_TRUE(eventually([&] { return refused() > before; }, 10s, [&] { (void)transport_->poll(now_); }));
  }

  /// The kiosks that know now why they get no world.
  const std::set<std::string>& told() {
    const std::string last = fmt::format("{}", ++asked_);
    transport_->refuse_kiosk(kCrowd, last);
    bool all = false;
    EXPECT_TRUE(eventually([&] {
      told_reader_.view().take_each([&](const proto::WorldAssignment& wire, const proto::SampleInfo& info) {
        const std::string kiosk(proto::text_of(wire.kiosk));
        if (!info.alive) {
          told_.erase(kiosk);
        } else if (info.valid) {
          const std::string why = proto::string_of(wire.trouble);
          all = all || why == last;
          if (why.find("512 programs") != std::string::npos) told_.insert(kiosk);
        }
      });
      return all;
    }));
    return told_;
  }

  TimePoint now_ = std::chrono::steady_clock::now();

 private:
  std::unique_ptr<transport::ServerTransport> transport_;
  std::unique_ptr<Crowd<proto::KioskStatus>> crowd_;
  proto::Reader<proto::WorldAssignment> told_reader_;
  std::set<std::string> told_;
  int asked_ = 0;
};

TEST_F(FullServer, Tells64KiosksWhyTheyGetNoWorldAndTheOthersWhenThoseHaveLeft) {
  std::set<std::string> asking;
  for (int i = 0; i < 100; ++i)
    asking.insert(fmt::format("far-{}", i));
  hear(asking);
  const std::set<std::string> first = told();
  EXPECT_EQ(first.size(), 64u);
  for (int i = 0; i < 3; ++i) {
    now_ += 2s;
    hear(asking);
    EXPECT_EQ(told(), first) << "who goes on asking is told for as long";
  }
  std::erase_if(asking, [&](const std::string& kiosk) { return first.contains(kiosk); });
  for (int i = 0; i < 3; ++i) {
    now_ += 2s;
    hear(asking);
  }
  EXPECT_EQ(told(), asking);
}

TEST_F(Loopback, ServersThatCameAndWentDoNotKeepTheNextOneOut) {
  auto hand = connect(Role::hand);
  Crowd<proto::ServerStatus> gone;
  ASSERT_TRUE(eventually([&] { return gone.writer.matched() > 0; }));
  const std::string none;
  for (std::uint64_t i = 0; i < 40; ++i) {
    proto::ServerStatus status{};
    proto::set_text(status.server, fmt::format("a-server-{}", i));
    status.protocol = proto::kProtocol;
    status.incarnation = i + 1;
    status.version = status.host = proto::look_into(none);
    gone.writer.write(status);
  }
  EchoServer server;
  EXPECT_TRUE(hand->wait_for(LinkState::joined, 10s));
}

TEST_F(Loopback, AServerOfAnotherVersionIsToldInsteadOfSearchedForEver) {
  auto hand = connect(Role::hand);
  Crowd<proto::ServerStatus> newer;
  const std::string version = "9.8.7";
  const std::string host = "far";
  proto::ServerStatus status{};
  proto::set_text(status.server, "newer");
  status.protocol = proto::kProtocol + 1;
  status.incarnation = 7;
  status.version = proto::look_into(version);
  status.host = proto::look_into(host);
  ASSERT_TRUE(
      eventually([&] { return hand->state() == LinkState::refused; }, 10s, [&] { newer.writer.write(status); }));
  for (const std::string& part : {version, host, fmt::format("protocol {}", proto::kProtocol + 1)})
    EXPECT_NE(hand->refusal().find(part), std::string::npos) << hand->refusal();

  EchoServer server;
  EXPECT_TRUE(hand->wait_for(LinkState::joined, 10s));
}

TEST_F(Loopback, AProgramOfAnotherVersionIsNamedInTheServersLog) {
  log::start("test", log::Level::warning);
  EchoServer server;
  Crowd<proto::KioskStatus> older;
  proto::KioskStatus status{};
  proto::set_text(status.kiosk, "kiosk-7");
  proto::set_text(status.program, "old-display");
  status.protocol = proto::kProtocol - 1;
  status.session = 8;
  testing::internal::CaptureStderr();
  EXPECT_TRUE(eventually([] { return log::trouble().count > 0; }, 10s, [&] { older.writer.write(status); }));
  const TimePoint until = std::chrono::steady_clock::now() + 3200ms;
  (void)eventually([&] { return std::chrono::steady_clock::now() > until; }, 10s, [&] { older.writer.write(status); });
  EXPECT_LE(log::trouble().count, 2u) << "this warning, and one of rejected samples; not one each second";
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("old-display of kiosk kiosk-7"));
}

TEST_F(Loopback, ManyOtherServersAreNotManyWarnings) {
  log::start("test", log::Level::warning);
  EchoServer server;
  Crowd<proto::ServerStatus> others;
  const auto say = [&] {
    for (std::uint64_t i = 0; i < 40; ++i) {
      proto::ServerStatus status{};
      proto::set_text(status.server, fmt::format("other-{}", i));
      status.incarnation = i + 1;
      others.writer.write(status);
    }
  };
  EXPECT_TRUE(eventually([] { return log::trouble().last.find("another server") != std::string::npos; }, 10s, say));
  auto hand = connect(Role::hand);
  EXPECT_TRUE(hand->wait_for(LinkState::joined, 10s));
  EXPECT_LT(log::trouble().count, 5u);
}

}  // namespace
}  // namespace mechane::test
