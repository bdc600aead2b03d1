#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "client-sdk/client/device_link.hpp"
#include "client-sdk/client/device_watch.hpp"
#include "client-sdk/client/display_link.hpp"
#include "client-sdk/client/hand_link.hpp"
#include "client-sdk/client/parse.hpp"
#include "client-sdk/client/world_link.hpp"
#include "server/base/thread_setup.hpp"
#include "server/hand/deadband.hpp"
#include "server/log/log.hpp"
#include "server/realtime/wakeup.hpp"
#include <mechane/client/client.hpp>
#include <mechane/proto/convert.hpp>
#include <mechane/proto/entity.hpp>
#include <mechane/proto/identity.hpp>

namespace mechane::client {
namespace {

constexpr Duration kLookEvery = std::chrono::milliseconds(20);
constexpr Duration kReportEvery = std::chrono::seconds(1);
constexpr std::size_t kMaxServers = 16;
// A server of another version is reported only after this long without one of ours, which may answer a moment later.
constexpr Duration kOtherVersionAfter = std::chrono::seconds(1);
constexpr Duration kOtherVersionForgotten = std::chrono::seconds(2);

TimePoint now() {
  return std::chrono::steady_clock::now();
}

class ClientImpl final : public Client {
 public:
  ClientImpl(ClientConfig config, proto::Participant participant)
      : config_(std::move(config)),
        session_(proto::random_id()),
        participant_(std::move(participant)),
        scenario_(config_.scenario) {}
  ~ClientImpl() override;

  [[nodiscard]] Expected<void> open();

  [[nodiscard]] LinkState state() const override { return state_.load(std::memory_order_acquire); }
  [[nodiscard]] bool wait_for(LinkState wanted, Duration timeout) override;
  [[nodiscard]] std::string refusal() const override;
  [[nodiscard]] std::uint64_t session() const override { return session_; }
  bool send(const HandSample& input) noexcept override {
    return hand_ && state() == LinkState::joined && hand_->send(input);
  }
  [[nodiscard]] std::uint64_t sent_sequence() const noexcept override { return hand_ ? hand_->sent_sequence() : 0; }
  [[nodiscard]] std::optional<ForceSample> newest_force() noexcept override {
    return hand_ ? hand_->newest_force() : std::nullopt;
  }
  [[nodiscard]] std::optional<ForceSample> wait_force(Duration timeout) override {
    return hand_ ? hand_->wait_force(timeout) : std::nullopt;
  }
  [[nodiscard]] bool newest_frame(Frame& out) override;
  [[nodiscard]] bool interpolated_frame(TimePoint at, Duration delay, Frame& out) override;
  [[nodiscard]] std::vector<SceneObject> objects() const override;
  [[nodiscard]] std::optional<WorldStatus> world_status() const override;
  [[nodiscard]] std::shared_ptr<const WorldPresentation> presentation() const override;
  [[nodiscard]] std::optional<ServerStatus> server_status() const override;
  [[nodiscard]] std::vector<WorldEvent> take_events() override;
  std::uint64_t start_activity(const std::string& activity) override {
    return send_command(mechane_command_start_activity, activity);
  }
  std::uint64_t restart_activity() override { return send_command(mechane_command_restart_activity, ""); }
  std::uint64_t next_step() override { return send_command(mechane_command_next_step, ""); }
  std::uint64_t click(const std::string& object) override { return send_command(mechane_command_click, object); }
  std::uint64_t open_exhibit(const std::string& scenario) override {
    return send_command(mechane_command_open, scenario);
  }
  std::uint64_t answer(const VisitAnswer& given) override {
    const char* const time = given.when == AnswerTime::before ? "before" : "after";
    return send_command(mechane_command_answer,
                        fmt::format("{}:{}/{}={}", time, given.activity, given.question, given.answer));
  }
  std::uint64_t tell_language(const std::string& language) override {
    return send_command(mechane_command_language, language);
  }
  [[nodiscard]] FrameTraffic frame_traffic() const override {
    const std::lock_guard lock(store_.mutex);
    return store_.traffic;
  }
  bool report(const DisplayStatus& status) override { return display_ && display_->report(status); }
  [[nodiscard]] std::optional<ViewerHead> viewer_head() override {
    return display_ ? display_->viewer_head() : std::nullopt;
  }
  void tell_device(const DeviceReport& report) override;
  bool tell_details(const DeviceDetails& details) override { return device_link_ && device_link_->tell(details); }
  [[nodiscard]] std::vector<DeviceRequest> take_device_requests() override {
    std::vector<DeviceRequest> requests;
    if (device_link_) requests = device_link_->take_requests();
    if (state() == LinkState::refused) requests.clear();  // they are for the program that has this hand
    return requests;
  }
  [[nodiscard]] std::vector<DeviceReport> devices() override;
  [[nodiscard]] std::vector<DeviceDetails> device_details() override;
  [[nodiscard]] Expected<std::uint64_t> ask_device(const DeviceRequest& request) override {
    if (auto ok = check(request); !ok) return tl::unexpected(ok.error());
    return watch_ ? watch_->ask(config_.kiosk, request) : 0;
  }
  [[nodiscard]] std::vector<DisplayRequest> take_display_requests() override {
    return display_ ? display_->take_requests() : std::vector<DisplayRequest>();
  }

 private:
  struct Server {
    ServerStatus status;
    std::uint64_t incarnation = 0;
    TimePoint received;
  };

  void run();
  void report(TimePoint at);
  void take_servers(TimePoint at);
  /// Forgets servers that fell silent, except the kiosk's own. Under mutex_.
  void forget_oldest_server();
  void take_assignments();
  void follow_world(bool server_alive);
  [[nodiscard]] bool server_alive(TimePoint at) const;
  [[nodiscard]] bool any_server_alive(TimePoint at) const;
  [[nodiscard]] LinkState judge(TimePoint at, bool server_alive, std::string& why) const;
  void enter(LinkState state, std::string why);
  std::uint64_t send_command(proto::CommandKind kind, const std::string& argument);
  [[nodiscard]] std::vector<KioskDevice> heard_devices();

  const ClientConfig config_;
  const std::uint64_t session_;
  std::string host_;
  proto::Participant participant_;
  std::atomic<LinkState> state_{LinkState::searching};
  std::atomic<bool> stop_{false};
  std::atomic<bool> device_changed_{false};
  mutable WorldStore store_;
  std::atomic<std::uint64_t> world_number_{0};

  mutable std::mutex mutex_;  // for what follows
  std::condition_variable changed_;
  std::string refusal_;
  std::map<std::string, Server> servers_;
  std::string other_version_;  // what to report of a server that was heard lately and speaks another protocol
  TimePoint other_version_since_{};
  TimePoint other_version_heard_{};
  std::optional<Assignment> assignment_;
  std::unique_ptr<WorldLink> world_;
  std::uint64_t commands_ = 0;
  DeviceReport device_;

  // Used by the link thread only.
  bool was_joined_ = false;
  std::string world_name_;
  std::uint64_t world_incarnation_ = 0;
  TimePoint next_report_{};
  std::uint64_t report_sequence_ = 0;
  std::string scenario_;  // the kiosk's last scenario, or the one to begin with
  bool was_there_ = false;
  proto::Writer<proto::KioskStatus> kiosk_status_;

  realtime::Wakeup news_;
  std::unique_ptr<HandLink> hand_;
  std::unique_ptr<DisplayLink> display_;
  std::unique_ptr<DeviceLink> device_link_;
  std::unique_ptr<DeviceWatch> watch_;  // only for a hand or a display
  proto::Reader<proto::ServerStatus> server_reader_;
  proto::Reader<proto::WorldAssignment> assignment_reader_;
  std::thread thread_;  // last
};

Expected<void> ClientImpl::open() {
  host_ = proto::host_name();
  auto writer = proto::Writer<proto::KioskStatus>::create(participant_, "");
  if (!writer) return tl::unexpected<Error>(writer.error());
  kiosk_status_ = std::move(*writer);
  if (config_.role == Role::hand) {
    auto hand = HandLink::create(participant_, config_, session_);
    if (!hand) return tl::unexpected<Error>(hand.error());
    hand_ = std::move(*hand);
    auto device = DeviceLink::create(participant_, config_.kiosk, config_.user, session_);
    if (!device) return tl::unexpected<Error>(device.error());
    device_link_ = std::move(*device);
  }
  if (!config_.display.empty()) {
    auto display = DisplayLink::create(participant_, config_.kiosk, config_.display, session_);
    if (!display) return tl::unexpected<Error>(display.error());
    display_ = std::move(*display);
  }
  if (hand_ || display_) {
    auto watch = DeviceWatch::create(participant_, config_.kiosk);
    if (!watch) return tl::unexpected<Error>(watch.error());
    watch_ = std::move(*watch);
  }
  auto servers = proto::Reader<proto::ServerStatus>::create(participant_, "", [this](auto) { news_.signal(); });
  if (!servers) return tl::unexpected<Error>(servers.error());
  server_reader_ = std::move(*servers);
  auto assignments = proto::Reader<proto::WorldAssignment>::create(participant_, "", [this](auto) { news_.signal(); });
  if (!assignments) return tl::unexpected<Error>(assignments.error());
  assignment_reader_ = std::move(*assignments);
  thread_ = std::thread([this] { run(); });
  return {};
}

ClientImpl::~ClientImpl() {
  stop_.store(true, std::memory_order_release);
  news_.signal();
  if (thread_.joinable()) thread_.join();
}

void ClientImpl::run() {
  set_up_thread("client-link");
  while (!stop_.load(std::memory_order_acquire)) {
    const TimePoint at = now();
    report(at);
    take_servers(at);
    take_assignments();
    const bool alive = server_alive(at);
    follow_world(alive);
    std::string why;
    const LinkState state = judge(at, alive, why);
    enter(state, std::move(why));
    news_.wait(kLookEvery);
  }
}

void ClientImpl::report(TimePoint at) {
  if (!device_changed_.exchange(false) && at < next_report_) return;
  next_report_ = at + kReportEvery;
  proto::KioskStatus wire{};
  proto::set_text(wire.kiosk, config_.kiosk);
  wire.session = session_;
  wire.protocol = proto::kProtocol;
  wire.seq = ++report_sequence_;
  wire.sent_ns = to_ns(at);
  wire.user = config_.user;
  wire.role = config_.role == Role::hand ? mechane_role_hand : mechane_role_watcher;
  proto::set_text(wire.program, config_.program);
  proto::set_text(wire.host, host_);
  wire.process_id = static_cast<std::uint32_t>(::getpid());
  // After a restart, the server returns the kiosk to the scenario that it went on to, not to its first one.
  if (std::string now_in = store_.scenario(); !now_in.empty()) {
    scenario_ = std::move(now_in);
    was_there_ = true;
  }
  wire.was_there = was_there_ ? 1 : 0;
  proto::set_text(wire.scenario, scenario_);
  proto::set_text(wire.join_kiosk, config_.join_kiosk);
  {
    const std::lock_guard lock(mutex_);
    wire.device = static_cast<std::uint32_t>(device_.state);
    wire.device_kind = static_cast<std::uint32_t>(device_.kind);
    wire.device_side = static_cast<std::uint32_t>(device_.side);
    proto::set_text(wire.device_name, device_.name);
    wire.calibration = static_cast<std::uint32_t>(device_.calibration.step);
    wire.calibration_held = device_.calibration.held;
    wire.calibration_refusal = static_cast<std::uint32_t>(device_.calibration.refusal);
  }
  if (!kiosk_status_.write(wire)) log::warning("client: the status of this process could not be sent");
}

void ClientImpl::take_servers(TimePoint at) {
  const std::lock_guard lock(mutex_);
  server_reader_.view().take_each([&](const proto::ServerStatus& wire, const proto::SampleInfo& info) {
    ServerStatus status;
    if (!info.valid || !info.alive) return;
    if (std::string other = other_protocol(wire); !other.empty()) {
      if (other_version_.empty()) other_version_since_ = at;
      other_version_ = std::move(other);
      other_version_heard_ = at;
      return;
    }
    if (!parse(wire, status)) return;
    if (servers_.size() >= kMaxServers && servers_.find(status.server) == servers_.end()) forget_oldest_server();
    Server& server = servers_[status.server];
    server = {std::move(status), wire.incarnation, at};
  });
  if (at - other_version_heard_ > kOtherVersionForgotten) other_version_.clear();
}

void ClientImpl::forget_oldest_server() {
  auto oldest = servers_.end();
  for (auto it = servers_.begin(); it != servers_.end(); ++it) {
    if (assignment_ && it->first == assignment_->server) continue;
    if (oldest == servers_.end() || it->second.received < oldest->second.received) oldest = it;
  }
  servers_.erase(oldest);
}

void ClientImpl::take_assignments() {
  const std::lock_guard lock(mutex_);
  assignment_reader_.view().take_each([&](const proto::WorldAssignment& wire, const proto::SampleInfo& info) {
    if (proto::text_of(wire.kiosk) != config_.kiosk) return;
    Assignment assignment;
    if (!info.alive) {
      assignment_.reset();
    } else if (info.valid && parse(wire, assignment)) {
      assignment_ = std::move(assignment);
    }
  });
}

bool ClientImpl::server_alive(TimePoint at) const {
  const std::lock_guard lock(mutex_);
  if (!assignment_) return false;
  const auto it = servers_.find(assignment_->server);
  return it != servers_.end() && it->second.incarnation == assignment_->incarnation &&
         at - it->second.received < proto::kServerLiveliness;
}

void ClientImpl::follow_world(bool server_alive) {
  if (!server_alive) return;                      // keep the link for a server that comes back
  const std::string wanted = assignment_->world;  // only this thread writes it
  const std::uint64_t incarnation = assignment_->incarnation;
  if (hand_) hand_->accept_epoch(assignment_->epoch);
  if (wanted == world_name_ && incarnation == world_incarnation_) return;
  world_name_ = wanted;
  world_incarnation_ = incarnation;
  std::unique_ptr<WorldLink> link;
  {
    const std::lock_guard lock(mutex_);
    link = std::move(world_);
  }
  link.reset();  // waits until its listeners have ended
  store_.clear();
  const std::uint64_t number = world_number_.fetch_add(1) + 1;  // frames of the previous world do not count
  if (wanted.empty()) return;
  auto made = WorldLink::create(participant_, wanted, number, store_);
  if (!made) {
    log::error(made.error());
    world_name_.clear();  // try again at the next look
    return;
  }
  const std::lock_guard lock(mutex_);
  world_ = std::move(*made);
}

bool ClientImpl::any_server_alive(TimePoint at) const {
  return std::any_of(servers_.begin(), servers_.end(),
                     [at](const auto& entry) { return at - entry.second.received < proto::kServerLiveliness; });
}

LinkState ClientImpl::judge(TimePoint at, bool server_alive, std::string& why) const {
  const LinkState waiting = was_joined_ ? LinkState::lost : LinkState::searching;
  const std::lock_guard lock(mutex_);
  if (!server_alive) {
    if (other_version_.empty() || at - other_version_since_ < kOtherVersionAfter || any_server_alive(at))
      return waiting;
    why = other_version_;
    return LinkState::refused;
  }
  if (!assignment_->trouble.empty()) {
    why = assignment_->trouble;
    return LinkState::refused;
  }
  if (assignment_->world.empty()) return waiting;
  if (config_.role == Role::hand) {
    const Assignment::Owner& owner = assignment_->owners[config_.user];
    if (owner.session == 0 && !assignment_->no_room.empty()) {
      why = assignment_->no_room;
      return LinkState::refused;
    }
    if (owner.session == 0) return waiting;
    if (owner.session != session_) {
      why = fmt::format(
          "hand {} of {} belongs to {} on {}; stop that program, or choose another user or kiosk: this hand joins by "
          "itself as soon as it is free",
          config_.user, config_.kiosk, owner.program, owner.host);
      return LinkState::refused;
    }
    if (!hand_->matched()) return waiting;
  }
  return world_ && world_->matched() ? LinkState::joined : waiting;
}

void ClientImpl::enter(LinkState state, std::string why) {
  if (state == LinkState::joined) was_joined_ = true;
  const std::lock_guard lock(mutex_);
  refusal_ = std::move(why);
  if (state_.exchange(state, std::memory_order_acq_rel) != state) changed_.notify_all();
}

bool ClientImpl::wait_for(LinkState wanted, Duration timeout) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return state() == wanted; });
}

std::string ClientImpl::refusal() const {
  const std::lock_guard lock(mutex_);
  return refusal_;
}

bool ClientImpl::newest_frame(Frame& out) {
  const WorldStore::Numbered* newest = store_.newest.newest();
  if (newest == nullptr || newest->world != world_number_.load(std::memory_order_acquire)) return false;
  out = newest->frame;
  return true;
}

bool ClientImpl::interpolated_frame(TimePoint at, Duration delay, Frame& out) {
  const std::lock_guard lock(store_.mutex);
  return store_.history.at(at - delay, out);
}

std::vector<SceneObject> ClientImpl::objects() const {
  const std::lock_guard lock(store_.mutex);
  std::vector<SceneObject> all;
  for (const auto& [index, object] : store_.objects)
    all.push_back(object);
  return all;
}

std::optional<WorldStatus> ClientImpl::world_status() const {
  const std::lock_guard lock(store_.mutex);
  return store_.status;
}

std::shared_ptr<const WorldPresentation> ClientImpl::presentation() const {
  const std::lock_guard lock(store_.mutex);
  return store_.presentation;
}

std::optional<ServerStatus> ClientImpl::server_status() const {
  const std::lock_guard lock(mutex_);
  if (!assignment_) return std::nullopt;
  const auto it = servers_.find(assignment_->server);
  return it == servers_.end() ? std::nullopt : std::optional<ServerStatus>(it->second.status);
}

void ClientImpl::tell_device(const DeviceReport& report) {
  {
    const std::lock_guard lock(mutex_);
    if (report == device_) return;
    device_ = report;
  }
  device_changed_ = true;
  news_.signal();
}

/// By user. A second program of a hand waits until that is free: its device is not what the visitor touches.
std::vector<KioskDevice> ClientImpl::heard_devices() {
  std::vector<KioskDevice> all;
  if (!watch_) return all;
  auto told = watch_->devices();
  const std::lock_guard lock(mutex_);
  for (auto& [session, device] : told) {
    const std::uint64_t owner = assignment_ ? assignment_->owners[device.report.user].session : 0;
    if (owner == 0 || owner == session) all.push_back(std::move(device));
  }
  std::ranges::stable_sort(all, {}, [](const KioskDevice& one) { return one.report.user; });
  return all;
}

std::vector<DeviceReport> ClientImpl::devices() {
  std::vector<DeviceReport> all;
  for (KioskDevice& one : heard_devices())
    all.push_back(std::move(one.report));
  return all;
}

std::vector<DeviceDetails> ClientImpl::device_details() {
  std::vector<DeviceDetails> all;
  for (KioskDevice& one : heard_devices())
    if (one.details) all.push_back(std::move(*one.details));
  return all;
}

std::vector<WorldEvent> ClientImpl::take_events() {
  const std::lock_guard lock(store_.mutex);
  std::vector<WorldEvent> events(store_.events.begin(), store_.events.end());
  store_.events.clear();
  return events;
}

std::uint64_t ClientImpl::send_command(proto::CommandKind kind, const std::string& argument) {
  const std::lock_guard lock(mutex_);
  if (!world_) return 0;
  // 20 bits of the session distinguish clients; with 52 bits in all, an event's value (a double) holds the id exactly.
  const std::uint64_t id = ((session_ >> 1 & 0xfffffu) << 32) | (++commands_ & 0xffffffffu);
  return world_->send_command(session_, id, kind, argument) ? id : 0;
}

Expected<void> check(const ClientConfig& config) {
  if (auto named = proto::check_name(config.kiosk, "kiosk"); !named) return named;
  if (!config.join_kiosk.empty()) {
    if (auto named = proto::check_name(config.join_kiosk, "kiosk"); !named) return named;
  }
  if (!config.display.empty()) {
    if (auto named = proto::check_name(config.display, "display"); !named) return named;
  }
  if (config.user >= hand::kMaxUsers) {
    return fail(ErrorCode::invalid_value, fmt::format("a kiosk has no user {}", config.user), "user",
                "choose one of 0 to 3");
  }
  if (!(config.deadband >= 0 && config.deadband <= hand::kMaxDeadband)) {
    return fail(ErrorCode::invalid_value, fmt::format("no deadband is {}", config.deadband), "deadband",
                fmt::format("choose a share from 0 to {}", hand::kMaxDeadband));
  }
  constexpr std::size_t kMostProgram = sizeof(proto::KioskStatus::program) - 1;
  constexpr std::size_t kMostScenario = sizeof(proto::KioskStatus::scenario) - 1;
  const bool long_program = config.program.size() > kMostProgram;
  if (long_program || config.scenario.size() > kMostScenario) {
    return fail(
        ErrorCode::too_large, "the name is too long", long_program ? "program" : "scenario",
        fmt::format("a program's name has at most {} characters, a scenario's {}", kMostProgram, kMostScenario));
  }
  return {};
}

}  // namespace

std::string_view link_name(LinkState state) {
  switch (state) {
    case LinkState::joined:
      return "joined";
    case LinkState::refused:
      return "refused";
    case LinkState::lost:
      return "lost";
    case LinkState::searching:
      break;
  }
  return "searching";
}

Expected<std::unique_ptr<Client>> Client::connect(const ClientConfig& config) {
  if (auto good = check(config); !good) return tl::unexpected<Error>(good.error());
  auto participant = proto::Participant::create(config.domain);
  if (!participant) return tl::unexpected<Error>(participant.error());
  auto client = std::make_unique<ClientImpl>(config, std::move(*participant));
  if (auto opened = client->open(); !opened) return tl::unexpected<Error>(opened.error());
  return client;
}

}  // namespace mechane::client
