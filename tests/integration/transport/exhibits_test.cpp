// Requests about exhibits over the loopback: sealed ones are taken once, forged and replayed ones are not; a world lets its hands go.
#include <filesystem>

#include <gmock/gmock.h>

#include "tests/integration/transport/loopback.hpp"
#include "tests/support/allocation_guard.hpp"
#include <mechane/client/exhibits.hpp>
#include <mechane/proto/exhibit_key.hpp>
#include <mechane/proto/names.hpp>

namespace mechane::test {
namespace {

namespace fs = std::filesystem;
using testing::SizeIs;
using transport::ExhibitOrder;
using transport::ExhibitVerb;

class Exhibits : public Loopback {
 protected:
  void SetUp() override {
    Loopback::SetUp();
    const auto key = proto::ExhibitKey::read_or_make(key_file_);
    ASSERT_TRUE(key) << key.error().to_string();
    transport::TransportConfig config;
    config.server = "test";
    config.scenarios = {"small"};
    config.domain = kServerDomain;
    config.exhibit_key = *key;
    auto transport = transport::ServerTransport::start(config);
    ASSERT_TRUE(transport) << transport.error().to_string();
    transport_ = std::move(*transport);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static TimePoint now() { return std::chrono::steady_clock::now(); }
  void take_orders() {
    for (ExhibitOrder& order : transport_->take_exhibit_orders(now()))
      orders_.push_back(std::move(order));
    transport::ExhibitStatusData data;
    data.exhibits.push_back({"small", "00ff", {{"en", "A small world"}}, 1, 0});
    data.loadable = {"large"};
    for (const ExhibitOrder& order : orders_)
      data.answers.push_back({order.id, "it is broken", "large.x3d:3", "mend it"});
    transport_->publish_exhibits(std::move(data));
  }

  fs::path folder_ = fs::path(testing::TempDir()) / fmt::format("exhibits-{}", ::getpid());
  fs::path key_file_ = folder_ / "exhibits.key";
  std::unique_ptr<transport::ServerTransport> transport_;
  std::vector<ExhibitOrder> orders_;
};

TEST_F(Exhibits, ASealedRequestIsTakenAndAnswered) {
  auto watch = client::ExhibitWatch::open(kClientDomain);
  ASSERT_TRUE(watch) << watch.error().to_string();
  const client::ExhibitRequest wanted{.verb = client::ExhibitVerb::load, .exhibit = "large", .now = true};
  EXPECT_EQ((*watch)->request("test", wanted, key_file_).error().code, ErrorCode::unknown_name) << "not heard yet";
  ASSERT_TRUE(
      eventually([&] { return !(*watch)->servers().empty(); }, std::chrono::seconds(10), [&] { take_orders(); }));
  const client::ExhibitStatus heard = (*watch)->servers().front();
  EXPECT_EQ(heard.exhibits.at(0).title.at("en"), "A small world");
  EXPECT_THAT(heard.loadable, testing::ElementsAre("large"));
  ASSERT_TRUE(proto::ExhibitKey::read_or_make(folder_ / "other.key"));
  EXPECT_EQ((*watch)->request("test", wanted, folder_ / "other.key").error().code, ErrorCode::conflict);
  const auto id = (*watch)->request("test", wanted, key_file_);
  ASSERT_TRUE(id) << id.error().to_string();
  ASSERT_TRUE(eventually([&] { return !(*watch)->servers().front().answers.empty(); }, std::chrono::seconds(10),
                         [&] { take_orders(); }));
  ASSERT_THAT(orders_, SizeIs(1));
  EXPECT_EQ(orders_[0].id, *id);
  EXPECT_EQ(orders_[0].verb, ExhibitVerb::load);
  EXPECT_EQ(orders_[0].exhibit, "large");
  EXPECT_TRUE(orders_[0].now);
  const client::ExhibitAnswer answer = (*watch)->servers().front().answers.at(0);
  EXPECT_EQ(answer.id, *id);
  EXPECT_EQ(answer.place, "large.x3d:3");
  EXPECT_EQ(answer.remedy, "mend it");
}

TEST_F(Exhibits, ForgedAndReplayedRequestsAreRefused) {
  auto participant = proto::Participant::create(kClientDomain);
  ASSERT_TRUE(participant);
  auto writer = proto::Writer<proto::ExhibitRequest>::create(*participant, "");
  auto reader = proto::Reader<proto::ExhibitStatus>::create(*participant, "");
  ASSERT_TRUE(writer && reader);
  proto::ExhibitRequest wire{};
  std::uint64_t incarnation = 0;
  ASSERT_TRUE(eventually(
      [&] {
        reader->view().take_each(
            [&](const proto::ExhibitStatus& status, const proto::SampleInfo&) { incarnation = status.incarnation; });
        return incarnation != 0 && writer->matched() > 0;
      },
      std::chrono::seconds(10), [&] { take_orders(); }));
  proto::set_text(wire.server, "test");
  wire.protocol = proto::kProtocol;
  wire.incarnation = incarnation;
  wire.counter = 1;
  wire.verb = mechane_exhibit_retire;
  proto::set_text(wire.exhibit, "small");
  wire.id = 17;
  ASSERT_TRUE(proto::ExhibitKey::read_or_make(folder_ / "theirs.key"));
  proto::ExhibitKey::read(folder_ / "theirs.key")->seal(wire);
  ASSERT_TRUE(writer->write(wire));  // forged
  wire.id = 18;
  const auto key = proto::ExhibitKey::read(key_file_);
  key->seal(wire);
  ASSERT_TRUE(writer->write(wire));  // the real one
  ASSERT_TRUE(writer->write(wire));  // heard on the way, and sent again
  auto changed = wire;
  changed.counter = 2;  // the same with a new counter
  ASSERT_TRUE(writer->write(changed));
  wire.counter = 2;
  wire.id = 19;
  key->seal(wire);
  ASSERT_TRUE(writer->write(wire));  // comes last: by then all the others have come
  ASSERT_TRUE(eventually([&] { return !orders_.empty() && orders_.back().id == 19; }, std::chrono::seconds(10),
                         [&] { take_orders(); }));
  ASSERT_THAT(orders_, SizeIs(2));
  EXPECT_EQ(orders_[0].id, 18U);
}

/// What the loop does in the ticks in which a world is left: no allocation, and the device gets its way to no force.
TEST_F(Exhibits, AWorldThatIsLeftLetsItsHandsGo) {
  const auto world = small_world();
  auto port = transport_->open_world("w1", world);
  ASSERT_TRUE(port) << port.error().to_string();
  auto hand = connect(client::Role::hand);
  ASSERT_NE(hand, nullptr);
  state::TickInputs inputs;
  ASSERT_TRUE(eventually([&] { return inputs.users[0].fresh; }, std::chrono::seconds(10),
                         [&] {
                           for (const transport::News& news : transport_->poll(now())) {
                             if (news.kind == transport::NewsKind::kiosk_appeared)
                               transport_->assign_kiosk(news.session.kiosk, **port);
                             if (news.kind == transport::NewsKind::hand_granted) {
                               EXPECT_TRUE(
                                   (*port)->bind_user(0, news.session.kiosk, news.session.user, news.session.id));
                             }
                           }
                           hand->send(hand_at(Vec3(0.1, 0, 0)));
                           (*port)->gather(inputs, now());
                         }));
  state::WorldState state(*world);
  state.users[0].present = true;
  const auto tick = [&](double force_n) {
    (*port)->gather(inputs, now());
    state.users[0].present = inputs.users[0].present;
    state.users[0].output.force_W.f = Vec3(0, force_n, 0);
    ++state.tick;
    (*port)->publish_forces(state);
  };
  tick(1.0);
  (*port)->retreat();
  AllocationGuard guard;
  tick(0.5);
  EXPECT_FALSE(inputs.users[0].present) << "for the tick and the journal the hand has left";
  EXPECT_FALSE((*port)->forces_are_zero());
  tick(0.0);
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE((*port)->forces_are_zero());
  std::optional<client::ForceSample> last;
  EXPECT_TRUE(eventually(
      [&] {
        if (const auto force = hand->wait_force(std::chrono::milliseconds(20))) last = force;
        return last && last->force_W.f.isZero(0);
      },
      std::chrono::seconds(10), [&] { tick(0.0); }))
      << "the device heard of it";
}

}  // namespace
}  // namespace mechane::test
