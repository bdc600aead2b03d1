#include "server/transport/server_transport.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "server/log/log.hpp"
#include "server/transport/haptic_publisher.hpp"
#include "server/transport/kiosk_link.hpp"
#include "server/transport/museum_publisher.hpp"
#include <mechane/proto/convert.hpp>
#include <mechane/proto/entity.hpp>
#include <mechane/proto/identity.hpp>

namespace mechane::transport {
namespace {

constexpr Duration kReportEvery = std::chrono::seconds(1);
// How often a lasting fault of other programs is logged: it must not fill the log.
constexpr Duration kSayAgainAfter = std::chrono::minutes(1);
constexpr Duration kNextOtherServerAfter = std::chrono::seconds(10);
constexpr std::size_t kMostRefusalsTold = 8;
constexpr std::size_t kMostOthers = 64;   // other servers that are remembered
constexpr std::size_t kMostLeftOut = 64;  // kiosks that a full server tells why they get no world

}  // namespace

class ServerTransport::Impl {
 public:
  Impl(const TransportConfig& config, proto::Participant participant)
      : server(config.server),
        version(config.version),
        host(proto::host_name()),
        incarnation(proto::random_id()),
        gate(config.exhibit_key, config.server, incarnation),
        participant_(std::move(participant)),
        fifo_priority_(config.fifo_priority),
        haptic_(config.fifo_priority, config.cpu) {}
  ~Impl();

  [[nodiscard]] Expected<void> open_endpoints();
  [[nodiscard]] std::vector<News> poll(TimePoint now);
  [[nodiscard]] Expected<WorldPort*> open_world(const std::string& world,
                                                std::shared_ptr<const state::WorldDescription> description);
  void close_world(WorldPort& port);
  void assign(const std::string& kiosk, const std::string& world, const std::string& trouble);
  [[nodiscard]] proto::ServerStatus wire_status(const ServerStatusData& data);
  void set_scenarios(const std::vector<std::string>& ids);
  [[nodiscard]] std::vector<ExhibitOrder> take_exhibit_orders(TimePoint now);
  void publish_exhibits(ExhibitStatusData data);

  const std::string server;
  const std::string version;
  const std::string host;
  const std::uint64_t incarnation;
  ScenarioNames scenarios;
  ExhibitGate gate;
  RejectCounters rejects;
  SessionTable table;
  [[nodiscard]] HapticPublisher& haptic() { return haptic_; }
  [[nodiscard]] MuseumPublisher& museum() { return *museum_; }

 private:
  struct Kiosk {
    std::shared_ptr<KioskLink> link;
    Assignment assignment;
  };

  void take_kiosks(TimePoint now, std::vector<News>& news);
  void session_appeared(const Session& session, TimePoint now, std::vector<News>& news);
  void session_left(std::uint64_t id, std::vector<News>& news);
  void leave_out(const Session& session, TimePoint now);
  void forget_left_out(TimePoint now);
  void drop_silent_sessions(TimePoint now, std::vector<News>& news);
  void settle_hands(TimePoint now, std::vector<News>& news);
  void drop_empty_kiosks(std::vector<News>& news);
  void report(TimePoint now);
  void warn_of_others(TimePoint now);
  void warn_of_version(const proto::KioskStatus& wire, TimePoint now);
  [[nodiscard]] std::shared_ptr<HandChannel> open_channel(const std::string& kiosk, std::uint32_t user,
                                                          std::uint64_t session);
  void close_channel(const std::shared_ptr<HandChannel>& channel);

  proto::Participant participant_;
  std::map<std::string, Kiosk> kiosks_;
  // A new link to a kiosk counts its forces from 1 again; a client recognises them by their epoch. The first epoch is random, so that no
  // two servers, and no two runs of one server, share an epoch.
  std::uint64_t next_epoch_ = proto::random_id();
  std::map<std::uint64_t, TimePoint> last_status_;  // by session, on our clock
  std::vector<std::unique_ptr<WorldPort>> ports_;
  std::vector<std::shared_ptr<HandChannel>>
      closed_channels_;  // kept until no other thread holds them: freeing memory is not for real-time threads
  RejectReport reject_report_;
  TimePoint next_report_{};
  const int fifo_priority_;
  HapticPublisher haptic_;
  std::unique_ptr<MuseumPublisher> museum_;
  std::deque<std::uint64_t> others_;  // incarnations of other servers that a warning was logged for, newest last
  TimePoint next_warning_of_others_{};
  // Kiosks that were told that the server has no room for them, and when they last asked.
  std::map<std::string, TimePoint> left_out_;
  TimePoint next_warning_of_left_out_{};
  TimePoint next_warning_of_version_{};
  proto::Reader<proto::ServerStatus> server_status_;
  proto::Reader<proto::KioskStatus> kiosk_status_;
  // Requests about exhibits that had no right seal: they must not fill the log.
  std::uint64_t exhibit_requests_refused_ = 0;
  TimePoint next_warning_of_refused_{};
  std::vector<ExhibitAnswer> exhibit_refusals_;  // of sealed requests that were not taken, for the next status
  std::optional<ExhibitStatusData> told_exhibits_;
  proto::Reader<proto::ExhibitRequest> exhibit_requests_;
};

ServerTransport::Impl::~Impl() {
  while (!ports_.empty())
    close_world(*ports_.back());
  for (auto& [name, kiosk] : kiosks_)
    kiosk.link->shut();
}

Expected<void> ServerTransport::Impl::open_endpoints() {
  auto status_writer = proto::Writer<proto::ServerStatus>::create(participant_, "");
  if (!status_writer) return tl::unexpected<Error>(status_writer.error());
  auto assignment_writer = proto::Writer<proto::WorldAssignment>::create(participant_, "");
  if (!assignment_writer) return tl::unexpected<Error>(assignment_writer.error());
  auto reader = proto::Reader<proto::KioskStatus>::create(participant_, "");
  if (!reader) return tl::unexpected<Error>(reader.error());
  kiosk_status_ = std::move(*reader);
  auto others = proto::Reader<proto::ServerStatus>::create(participant_, "");
  if (!others) return tl::unexpected<Error>(others.error());
  server_status_ = std::move(*others);
  auto exhibit_writer = proto::Writer<proto::ExhibitStatus>::create(participant_, "");
  if (!exhibit_writer) return tl::unexpected<Error>(exhibit_writer.error());
  auto requests = proto::Reader<proto::ExhibitRequest>::create(participant_, "");
  if (!requests) return tl::unexpected<Error>(requests.error());
  exhibit_requests_ = std::move(*requests);
  museum_ = std::make_unique<MuseumPublisher>(std::move(*status_writer), std::move(*assignment_writer),
                                              std::move(*exhibit_writer), wire_status(ServerStatusData{}));
  return {};
}

std::vector<News> ServerTransport::Impl::poll(TimePoint now) {
  std::vector<News> news;
  take_kiosks(now, news);
  drop_silent_sessions(now, news);
  forget_left_out(now);
  settle_hands(now, news);
  drop_empty_kiosks(news);
  for (const auto& port : ports_)
    port->collect();
  std::erase_if(closed_channels_, [](const auto& channel) { return channel.use_count() == 1; });
  report(now);
  warn_of_others(now);
  return news;
}

/// Two servers in one domain, such as a forgotten demo beside the service, both answer every kiosk, and each drives the kiosk's hands.
void ServerTransport::Impl::warn_of_others(TimePoint now) {
  server_status_.view().take_each([&](const proto::ServerStatus& wire, const proto::SampleInfo& info) {
    if (!info.valid || wire.incarnation == incarnation || now < next_warning_of_others_) return;
    if (std::find(others_.begin(), others_.end(), wire.incarnation) != others_.end()) return;
    others_.push_back(wire.incarnation);
    if (others_.size() > kMostOthers) others_.pop_front();
    next_warning_of_others_ = now + kNextOtherServerAfter;
    log::warning(
        fmt::format("another server, {} on {}, answers the kiosks of this DDS domain too: stop one of "
                    "the two servers, or start it with another --domain",
                    std::string(wire.server), proto::string_of(wire.host)));
  });
}

void ServerTransport::Impl::take_kiosks(TimePoint now, std::vector<News>& news) {
  proto::KioskStatus wire;
  proto::SampleInfo info;
  while (kiosk_status_.view().take_into(wire, info)) {
    if (!info.alive) {
      session_left(wire.session, news);
      continue;
    }
    if (!info.valid) continue;
    Session session;
    const Reject fault = validate(wire, session);
    rejects.add(fault);
    if (fault == Reject::none) session_appeared(session, now, news);
    if (fault == Reject::wrong_protocol) warn_of_version(wire, now);
  }
}

/// The program drops what we send, as we drop what it sends. It sees our version in ServerStatus.
void ServerTransport::Impl::warn_of_version(const proto::KioskStatus& wire, TimePoint now) {
  if (now < next_warning_of_version_) return;
  next_warning_of_version_ = now + kSayAgainAfter;
  log::warning(fmt::format(
      "{} of kiosk {} on {} speaks protocol {}, but this server ({}) speaks protocol {}: install the same version of "
      "Mechane on both machines",
      proto::text_of(wire.program), proto::text_of(wire.kiosk), proto::text_of(wire.host), wire.protocol, version,
      proto::kProtocol));
}

void ServerTransport::Impl::session_appeared(const Session& session, TimePoint now, std::vector<News>& news) {
  const bool known = table.find(session.id) != nullptr;
  if (!known && table.full()) return leave_out(session, now);
  if (kiosks_.find(session.kiosk) == kiosks_.end()) {
    const std::uint64_t epoch = next_epoch_++;
    auto link = KioskLink::create(participant_, session.kiosk, epoch, rejects, fifo_priority_);
    if (!link) {
      log::error(link.error());
      return;
    }
    Kiosk& kiosk = kiosks_[session.kiosk];
    kiosk.link = std::move(*link);
    kiosk.assignment.epoch = epoch;
  }
  const bool first = table.sessions_at(session.kiosk) == 0;
  (void)table.appeared(session);
  left_out_.erase(session.kiosk);
  last_status_[session.id] = now;
  if (known) return;
  if (first) news.push_back({NewsKind::kiosk_appeared, session});
  news.push_back({NewsKind::session_appeared, session});
}

/// Tells a kiosk that has no connected program why it gets no world. At any other kiosk, displays follow its world all the same, and only
/// further hands are told.
void ServerTransport::Impl::leave_out(const Session& session, TimePoint now) {
  if (now >= next_warning_of_left_out_) {
    next_warning_of_left_out_ = now + kSayAgainAfter;
    log::warning(fmt::format(
        "{} programs are connected, which is the limit: {} of {} on {} and all further ones are refused until some of "
        "them end. List them with: mechane echo KioskStatus",
        SessionTable::kMaxSessions, session.program, session.kiosk, session.host));
  }
  const std::string why = fmt::format(
      "the server is full: {} programs are connected, which is its limit; end some of them (mechane echo KioskStatus "
      "lists them)",
      SessionTable::kMaxSessions);
  if (const auto kiosk = kiosks_.find(session.kiosk); kiosk != kiosks_.end()) {
    if (kiosk->second.assignment.no_room.empty()) {
      kiosk->second.assignment.no_room = why;
      museum_->assign(session.kiosk, kiosk->second.assignment);
    }
    return;
  }
  if (const auto told = left_out_.find(session.kiosk); told != left_out_.end()) {
    told->second = now;
    return;
  }
  if (left_out_.size() >= kMostLeftOut) return;
  left_out_[session.kiosk] = now;
  Assignment assignment;
  assignment.trouble = why;
  museum_->assign(session.kiosk, assignment);
}

void ServerTransport::Impl::forget_left_out(TimePoint now) {
  std::erase_if(left_out_, [&](const auto& entry) {
    if (now - entry.second <= proto::kKioskLiveliness) return false;
    museum_->forget(entry.first);
    return true;
  });
  if (table.full()) return;
  for (auto& [name, kiosk] : kiosks_) {
    if (!std::exchange(kiosk.assignment.no_room, {}).empty()) museum_->assign(name, kiosk.assignment);
  }
}

void ServerTransport::Impl::session_left(std::uint64_t id, std::vector<News>& news) {
  const Session* known = table.find(id);
  if (known == nullptr) return;
  const Session session = *known;
  (void)table.left(id);
  last_status_.erase(id);
  news.push_back({NewsKind::session_left, session});
}

void ServerTransport::Impl::drop_silent_sessions(TimePoint now, std::vector<News>& news) {
  std::vector<std::uint64_t> silent;
  for (const auto& [id, at] : last_status_) {
    if (now - at > proto::kKioskLiveliness) silent.push_back(id);
  }
  for (const std::uint64_t id : silent)
    session_left(id, news);
}

void ServerTransport::Impl::settle_hands(TimePoint now, std::vector<News>& news) {
  for (auto& [name, kiosk] : kiosks_) {
    for (std::uint32_t user = 0; user < hand::kMaxUsers; ++user) {
      const TimePoint heard = kiosk.link->heard(user);
      if (const Session* owner = table.owner(name, user); owner != nullptr && heard > TimePoint{}) {
        table.heard(owner->id, heard);
      }
    }
  }
  for (const HandChange& change : table.decide(now)) {
    const Session& session = change.session;
    const auto it = kiosks_.find(session.kiosk);
    if (it == kiosks_.end()) continue;
    it->second.link->set_owner(session.user, change.granted ? session.id : 0);
    it->second.assignment.owners[session.user] = change.granted ? session : Session{};
    museum_->assign(session.kiosk, it->second.assignment);
    news.push_back({change.granted ? NewsKind::hand_granted : NewsKind::hand_freed, session});
  }
}

void ServerTransport::Impl::drop_empty_kiosks(std::vector<News>& news) {
  for (auto it = kiosks_.begin(); it != kiosks_.end();) {
    if (table.sessions_at(it->first) > 0) {
      ++it;
      continue;
    }
    Session gone;
    gone.kiosk = it->first;
    it->second.link->shut();
    museum_->forget(it->first);
    news.push_back({NewsKind::kiosk_left, gone});
    it = kiosks_.erase(it);
  }
}

void ServerTransport::Impl::report(TimePoint now) {
  if (now < next_report_) return;
  const std::string line = reject_report_.since_last(rejects);
  next_report_ = now + (line.empty() ? kReportEvery : kSayAgainAfter);
  if (!line.empty()) log::warning(line);
}

std::shared_ptr<HandChannel> ServerTransport::Impl::open_channel(const std::string& kiosk, std::uint32_t user,
                                                                 std::uint64_t session) {
  const auto it = kiosks_.find(kiosk);
  if (it == kiosks_.end() || user >= hand::kMaxUsers) return nullptr;
  auto channel = std::make_shared<HandChannel>();
  channel->link = it->second.link;
  channel->user = user;
  channel->session = session;
  it->second.link->open(channel);
  haptic_.add(channel);
  return channel;
}

void ServerTransport::Impl::close_channel(const std::shared_ptr<HandChannel>& channel) {
  channel->link->close(channel);
  haptic_.remove(channel);
  closed_channels_.push_back(channel);
}

Expected<WorldPort*> ServerTransport::Impl::open_world(const std::string& world,
                                                       std::shared_ptr<const state::WorldDescription> description) {
  if (auto named = proto::check_name(world, "world"); !named) return tl::unexpected<Error>(named.error());
  if (std::any_of(ports_.begin(), ports_.end(), [&](const auto& p) { return p->world() == world; })) {
    return fail(ErrorCode::duplicate, "a world of this name is already open", world,
                "choose another name, or close that world first");
  }
  auto port = std::make_unique<WorldPort>(
      world, std::move(description), haptic_,
      [this](const std::string& kiosk, std::uint32_t user, std::uint64_t session) {
        return open_channel(kiosk, user, session);
      },
      [this](const std::shared_ptr<HandChannel>& channel) { close_channel(channel); });
  auto writer = WorldEndpoints::create(participant_, *port, rejects, scenarios);
  if (!writer) return tl::unexpected<Error>(writer.error());
  museum_->add(std::move(*writer));
  ports_.push_back(std::move(port));
  return ports_.back().get();
}

void ServerTransport::Impl::close_world(WorldPort& port) {
  museum_->remove(port);
  for (auto& [name, kiosk] : kiosks_) {
    if (kiosk.assignment.world == port.world()) assign(name, "", "");
  }
  std::erase_if(ports_, [&](const auto& p) { return p.get() == &port; });
}

void ServerTransport::Impl::assign(const std::string& kiosk, const std::string& world, const std::string& trouble) {
  const auto it = kiosks_.find(kiosk);
  if (it == kiosks_.end()) return;
  it->second.assignment.world = world;
  it->second.assignment.trouble = trouble;
  museum_->assign(kiosk, it->second.assignment);
}

proto::ServerStatus ServerTransport::Impl::wire_status(const ServerStatusData& data) {
  proto::ServerStatus wire{};
  proto::set_text(wire.server, server);
  wire.protocol = proto::kProtocol;
  wire.incarnation = incarnation;
  wire.version = proto::look_into(version);
  wire.host = proto::look_into(host);
  wire.worlds = data.worlds;
  wire.worlds_limit = data.worlds_limit;
  wire.users = data.users;
  wire.ticks = data.loops.ticks;
  wire.overruns = data.loops.overruns;
  wire.late_wakeups = data.loops.late_wakeups;
  wire.preemptions = data.loops.preemptions;
  wire.samples_rejected = rejects.total();
  wire.tick_us_median = static_cast<float>(data.loops.tick_us_median);
  wire.tick_us_p99 = static_cast<float>(data.loops.tick_us_p99);
  wire.tick_us_p999 = static_cast<float>(data.loops.tick_us_p999);
  wire.tick_us_max = static_cast<float>(data.loops.tick_us_max);
  wire.wake_us_p99 = static_cast<float>(data.loops.wake_us_p99);
  wire.wake_us_max = static_cast<float>(data.loops.wake_us_max);
  wire.realtime = data.loops.realtime;
  wire.records_ok = data.records_ok;
  wire.input_gaps = haptic_.input_gaps();
  wire.input_gap_ms = static_cast<float>(data.input_gap_ms);
  return wire;
}

void ServerTransport::Impl::set_scenarios(const std::vector<std::string>& ids) {
  scenarios.set(ids);
  museum_->set_scenarios(ids);
}

std::vector<ExhibitOrder> ServerTransport::Impl::take_exhibit_orders(TimePoint now) {
  std::vector<ExhibitOrder> orders;
  exhibit_requests_.view().take_each([&](const proto::ExhibitRequest& wire, const proto::SampleInfo& info) {
    if (!info.valid) return;
    ExhibitOrder order;
    const ExhibitFault fault = gate.take(wire, order);
    if (fault == ExhibitFault::none) {
      orders.push_back(std::move(order));
      return;
    }
    if (order.id != 0) {
      if (exhibit_refusals_.size() >= kMostRefusalsTold) exhibit_refusals_.erase(exhibit_refusals_.begin());
      exhibit_refusals_.push_back({order.id, std::string(words_of(fault)), "", "ask again"});
    }
    ++exhibit_requests_refused_;
    if (now < next_warning_of_refused_) return;
    next_warning_of_refused_ = now + kReportEvery;
    log::warning(fmt::format("a request to change exhibits was refused: {} ({} refused since the server's start)",
                             words_of(fault), exhibit_requests_refused_));
  });
  return orders;
}

void ServerTransport::Impl::publish_exhibits(ExhibitStatusData data) {
  data.changeable = gate.is_open();
  data.key_mark = gate.key_mark();
  data.counter = gate.counter();
  data.answers.insert(data.answers.end(), exhibit_refusals_.begin(), exhibit_refusals_.end());
  if (told_exhibits_ && *told_exhibits_ == data) return;
  museum_->set_exhibits(data);
  told_exhibits_ = std::move(data);
}

Expected<std::unique_ptr<ServerTransport>> ServerTransport::start(const TransportConfig& config) {
  if (auto named = proto::check_name(config.server, "server"); !named) return tl::unexpected<Error>(named.error());
  auto participant = proto::Participant::create(config.domain);
  if (!participant) return tl::unexpected<Error>(participant.error());
  auto impl = std::make_unique<Impl>(config, std::move(*participant));
  if (auto opened = impl->open_endpoints(); !opened) return tl::unexpected<Error>(opened.error());
  impl->set_scenarios(config.scenarios);
  return std::unique_ptr<ServerTransport>(new ServerTransport(std::move(impl)));
}

ServerTransport::ServerTransport(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ServerTransport::~ServerTransport() = default;

std::vector<News> ServerTransport::poll(TimePoint now) {
  return impl_->poll(now);
}
const SessionTable& ServerTransport::sessions() const {
  return impl_->table;
}
Expected<WorldPort*> ServerTransport::open_world(const std::string& world,
                                                 std::shared_ptr<const state::WorldDescription> description) {
  return impl_->open_world(world, std::move(description));
}
void ServerTransport::close_world(WorldPort& port) {
  impl_->close_world(port);
}
void ServerTransport::assign_kiosk(const std::string& kiosk, const WorldPort& port) {
  impl_->assign(kiosk, port.world(), "");
}
void ServerTransport::refuse_kiosk(const std::string& kiosk, const std::string& why) {
  impl_->assign(kiosk, "", why);
}
void ServerTransport::publish_server_status(const ServerStatusData& data) {
  impl_->museum().set_status(impl_->wire_status(data), data.overload);
}
void ServerTransport::set_scenarios(const std::vector<std::string>& scenarios) {
  impl_->set_scenarios(scenarios);
}
bool ServerTransport::has_room_for(const std::string& scenario) const {
  return impl_->scenarios.has_room_for(scenario);
}
const std::string& ServerTransport::scenario(std::uint32_t number) const {
  return impl_->scenarios.name(number);
}
std::vector<ExhibitOrder> ServerTransport::take_exhibit_orders(TimePoint now) {
  return impl_->take_exhibit_orders(now);
}
void ServerTransport::publish_exhibits(ExhibitStatusData data) {
  impl_->publish_exhibits(std::move(data));
}
bool ServerTransport::fifo_granted() const {
  return impl_->haptic().fifo_granted();
}
const RejectCounters& ServerTransport::rejected() const {
  return impl_->rejects;
}
const realtime::LatencyHistogram& ServerTransport::haptic_write_time() const {
  return impl_->haptic().write_time();
}
std::uint64_t ServerTransport::input_gaps() const {
  return impl_->haptic().input_gaps();
}
Duration ServerTransport::take_longest_input_gap() {
  return impl_->haptic().take_longest_gap();
}
std::uint64_t ServerTransport::haptic_writes_failed() const {
  return impl_->haptic().writes_failed();
}

}  // namespace mechane::transport
