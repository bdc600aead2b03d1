#include "client-sdk/cli/echo.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <span>

#include <nlohmann/json.hpp>

#include "server/hand/hand_force.hpp"
#include "server/realtime/wakeup.hpp"
#include <mechane/proto/convert.hpp>
#include <mechane/proto/entity.hpp>

namespace mechane::cli {
namespace {

using Json = nlohmann::ordered_json;

volatile std::sig_atomic_t interrupted = 0;

template <std::size_t N>
Json list(const float (&values)[N]) {
  return Json(std::vector<float>(std::begin(values), std::end(values)));
}
template <std::size_t N>
std::string text(const char (&chars)[N]) {
  return std::string(proto::text_of(chars));
}
Json pose(const proto::WirePose& X) {
  return {{"p", list(X.p)}, {"q", list(X.q)}};
}
template <class Sequence>
Json texts(const Sequence& sequence) {
  Json all = Json::object();
  for (const auto& t : proto::elements(sequence))
    all[text(t.language)] = proto::string_of(t.content);
  return all;
}
template <class Sequence>
Json strings(const Sequence& sequence) {
  Json all = Json::array();
  for (const char* s : proto::elements(sequence))
    all.push_back(proto::string_of(s));
  return all;
}
template <class T>
Json head(const T& s) {
  return {{"protocol", s.protocol}, {"seq", s.seq}, {"sent_ns", s.sent_ns}};
}

Json to_json(const proto::HapticInput& s) {
  Json j = head(s);
  j.update(
      {{"kiosk", text(s.kiosk)}, {"user", s.user}, {"session", s.session}, {"kind", s.kind}, {"X_WH", pose(s.X_WH)}});
  j.update({{"v_WH", list(s.v_WH)}, {"w_WH", list(s.w_WH)}, {"joints", list(s.joints)}, {"hand_scale", s.hand_scale}});
  j.update({{"grasp_intent", s.grasp_intent},
            {"buttons", s.buttons},
            {"finger_scale", list(s.finger_scale)},
            {"side", s.side}});
  j.update({{"echo_epoch", s.echo_epoch}, {"echo_seq", s.echo_seq}, {"echo_held_us", s.echo_held_us}});
  j.update({{"deadband", s.deadband}});
  return j;
}

Json to_json(const proto::HapticOutput& s) {
  Json j = head(s);
  j.update({{"kiosk", text(s.kiosk)}, {"user", s.user}, {"session", s.session}, {"tick", s.tick}, {"epoch", s.epoch}});
  j.update({{"echo_seq", s.echo_seq}, {"echo_sent_ns", s.echo_sent_ns}, {"f_W", list(s.f_W)}, {"t_W", list(s.t_W)}});
  j.update({{"finger_force_n", list(s.finger_force_n)}, {"reasons", s.reasons}, {"holding", s.holding != 0}});
  j.update({{"clicks", s.clicks}, {"click_n", s.click_n}});
  const auto& held = s.held;
  j["held"] = {{"kind", held.kind},
               {"p_HG", list(held.p_HG)},
               {"p_W", list(held.p_W)},
               {"axis_W", list(held.axis_W)},
               {"radius_m", held.radius_m},
               {"along_n", held.along_n},
               {"stiffness_n_per_m", held.stiffness_n_per_m},
               {"damping_ns_per_m", held.damping_ns_per_m},
               {"limit_n", held.limit_n},
               {"valid_us", held.valid_us}};
  Json contacts = Json::array();
  for (std::size_t i = 0; i < s.contact_count && i < hand::kMaxLocalContacts; ++i) {
    const auto& c = s.contacts[i];
    contacts.push_back({{"p_W", list(c.p_W)},
                        {"n_W", list(c.n_W)},
                        {"v_W", list(c.v_W)},
                        {"depth_m", c.depth_m},
                        {"curvature_per_m", c.curvature_per_m},
                        {"stiffness_n_per_m", c.stiffness_n_per_m},
                        {"damping_ns_per_m", c.damping_ns_per_m},
                        {"static_friction", c.static_friction},
                        {"dynamic_friction", c.dynamic_friction},
                        {"viscosity_ns_per_m", c.viscosity_ns_per_m},
                        {"groove_depth_m", c.groove_depth_m},
                        {"groove_wave_W", list(c.groove_wave_W)},
                        {"groove_phase_rad", c.groove_phase_rad},
                        {"valid_us", c.valid_us}});
  }
  j["contacts"] = contacts;
  return j;
}

Json to_json(const proto::SceneFrame& s) {
  Json j = head(s);
  j.update({{"world", text(s.world)}, {"tick", s.tick}});
  Json bodies = Json::array();
  for (const auto& b : proto::elements(s.bodies))
    bodies.push_back({{"object", b.object}, {"X_WB", pose(b.X_WB)}});
  Json hands = Json::array();
  for (const auto& h : proto::elements(s.hands)) {
    Json segments = Json::array();
    for (const auto& X : proto::elements(h.X_WS))
      segments.push_back(pose(X));
    hands.push_back({{"kiosk", text(h.kiosk)},
                     {"user", h.user},
                     {"session", h.session},
                     {"kind", h.kind},
                     {"stale", h.stale != 0},
                     {"holding", h.holding != 0},
                     {"f_W", list(h.f_W)},
                     {"X_WS", segments}});
  }
  const auto visible = proto::elements(s.visible);
  const auto quantities = proto::elements(s.quantities);
  j["bodies"] = bodies;
  j["visible"] = std::vector<int>(visible.begin(), visible.end());
  j["quantities"] = std::vector<double>(quantities.begin(), quantities.end());
  j["hands"] = hands;
  Json ropes = Json::array();
  for (const auto& r : proto::elements(s.ropes)) {
    const auto points = proto::elements(r.p_W);
    ropes.push_back({{"diameter_m", r.diameter_m}, {"p_W", std::vector<float>(points.begin(), points.end())}});
  }
  j["ropes"] = ropes;
  return j;
}

Json to_json(const proto::SceneObject& s) {
  Json j = head(s);
  j.update({{"world", text(s.world)}, {"object", s.object}, {"objects_total", s.objects_total}});
  j.update({{"name", proto::string_of(s.name)}, {"mesh_uri", proto::string_of(s.mesh_uri)}});
  j.update({{"mesh_hash", proto::string_of(s.mesh_hash)}, {"mesh_node", proto::string_of(s.mesh_node)}});
  j.update(
      {{"parent", proto::string_of(s.parent)}, {"X_WB", pose(s.X_WB)}, {"movable", s.movable}, {"visible", s.visible}});
  j.update({{"stiffness_n_per_m", s.stiffness_n_per_m}, {"damping_ns_per_m", s.damping_ns_per_m}});
  j.update({{"static_friction", s.static_friction}, {"dynamic_friction", s.dynamic_friction}});
  j.update({{"title", texts(s.title)}});
  return j;
}

Json to_json(const proto::WorldStatus& s) {
  Json j = head(s);
  j.update({{"world", text(s.world)}, {"scenario", proto::string_of(s.scenario)}});
  j.update(
      {{"scenario_hash", proto::string_of(s.scenario_hash)}, {"scenario_folder", proto::string_of(s.scenario_folder)}});
  j.update(
      {{"activity", proto::string_of(s.activity)}, {"step", proto::string_of(s.step)}, {"steps_done", s.steps_done}});
  j.update({{"steps_total", s.steps_total}, {"done", s.done}, {"hint", s.hint}});
  Json quantities = Json::array();
  for (const auto& q : proto::elements(s.quantities)) {
    Json quantity{{"name", proto::string_of(q.name)}, {"unit", proto::string_of(q.unit)}, {"label", texts(q.label)}};
    if (q.ranged) quantity["range"] = {q.least, q.greatest};
    quantities.push_back(std::move(quantity));
  }
  Json goals = Json::array();
  for (const auto& goal : proto::elements(s.goals))
    goals.push_back({{"quantity", goal.quantity}, {"value", goal.value}, {"from_above", goal.from_above}});
  j["goals"] = goals;
  j.update({{"enabled_agents", strings(s.enabled_agents)}, {"quantities", quantities}, {"title", texts(s.title)}});
  j.update({{"caption", texts(s.caption)}, {"hint_text", texts(s.hint_text)}, {"activities", strings(s.activities)}});
  j.update({{"narration", texts(s.narration)}, {"audio", texts(s.audio)}, {"detail", proto::string_of(s.detail)}});
  return j;
}

Json to_json(const proto::WireQuestion& q) {
  Json answers = Json::array();
  for (const auto& a : proto::elements(q.answers))
    answers.push_back({{"name", proto::string_of(a.name)}, {"text", texts(a.text)}});
  return {{"name", proto::string_of(q.name)},
          {"kind", q.kind == mechane_question_choice ? "choice" : "scale"},
          {"text", texts(q.text)},
          {"answers", answers},
          {"marks", q.marks},
          {"low", texts(q.low)},
          {"high", texts(q.high)}};
}

Json to_json(const proto::WireEffect& e) {
  return {{"name", proto::string_of(e.name)},
          {"kind", proto::string_of(e.kind)},
          {"object", e.object},
          {"node", proto::string_of(e.node)},
          {"p_BE", list(e.p_BE)},
          {"direction_B", list(e.direction_B)},
          {"quantity", e.quantity},
          {"full", e.full},
          {"size_m", e.size_m},
          {"speed_m_per_s", e.speed_m_per_s}};
}

Json to_json(const proto::WorldPresentation& s) {
  Json j = head(s);
  j.update({{"world", text(s.world)}, {"languages", strings(s.languages)}});
  Json activities = Json::array();
  for (const auto& a : proto::elements(s.activities)) {
    Json questions = Json::array();
    for (const auto& q : proto::elements(a.questions))
      questions.push_back(to_json(q));
    activities.push_back({{"name", proto::string_of(a.name)},
                          {"title", texts(a.title)},
                          {"goal", texts(a.goal)},
                          {"questions", questions}});
  }
  Json views = Json::array();
  for (const auto& v : proto::elements(s.views)) {
    views.push_back(
        {{"name", proto::string_of(v.name)}, {"X_WV", pose(v.X_WV)}, {"field_of_view_rad", v.field_of_view_rad}});
  }
  Json effects = Json::array();
  for (const auto& e : proto::elements(s.effects))
    effects.push_back(to_json(e));
  Json affordances = Json::array();
  for (const auto& w : proto::elements(s.affordances)) {
    affordances.push_back({{"kind", w.kind},
                           {"agent", proto::string_of(w.agent)},
                           {"object", w.object},
                           {"base", w.base},
                           {"X_AJ", pose(w.X_AJ)},
                           {"X_BJ", pose(w.X_BJ)}});
  }
  j.update({{"activities", activities}, {"views", views}, {"effects", effects}, {"affordances", affordances}});
  return j;
}

Json to_json(const proto::Event& s) {
  Json j = head(s);
  j.update(
      {{"scope", text(s.scope)}, {"tick", s.tick}, {"kind", text(s.kind)}, {"subject", proto::string_of(s.subject)}});
  j.update({{"object", proto::string_of(s.object)}, {"value", s.value}});
  return j;
}

const char* word_of(proto::CommandKind kind) {
  switch (kind) {
    case mechane_command_none:
      break;
    case mechane_command_start_activity:
      return "start_activity";
    case mechane_command_restart_activity:
      return "restart_activity";
    case mechane_command_next_step:
      return "next_step";
    case mechane_command_click:
      return "click";
    case mechane_command_open:
      return "open";
    case mechane_command_answer:
      return "answer";
    case mechane_command_language:
      return "language";
  }
  return "none";
}

Json to_json(const proto::Command& s) {
  Json j = head(s);
  j.update({{"scope", text(s.scope)}, {"session", s.session}, {"id", s.id}, {"kind", word_of(s.kind)}});
  j["argument"] = proto::string_of(s.argument);
  return j;
}

Json to_json(const proto::WorldAssignment& s) {
  Json j = head(s);
  j.update({{"kiosk", text(s.kiosk)}, {"server", text(s.server)}, {"incarnation", s.incarnation}, {"epoch", s.epoch}});
  j.update({{"world", text(s.world)}, {"trouble", proto::string_of(s.trouble)}});
  Json owners = Json::array();
  for (const auto& o : s.owners) {
    owners.push_back({{"session", o.session}, {"program", text(o.program)}, {"host", text(o.host)}});
  }
  j["owners"] = owners;
  return j;
}

Json to_json(const proto::ServerStatus& s) {
  Json j = head(s);
  j.update({{"server", text(s.server)}, {"incarnation", s.incarnation}, {"version", proto::string_of(s.version)}});
  j.update(
      {{"host", proto::string_of(s.host)}, {"worlds", s.worlds}, {"worlds_limit", s.worlds_limit}, {"users", s.users}});
  j.update({{"ticks", s.ticks}, {"overruns", s.overruns}, {"late_wakeups", s.late_wakeups}});
  j.update({{"preemptions", s.preemptions}, {"samples_rejected", s.samples_rejected}});
  j.update({{"tick_us_median", s.tick_us_median}, {"tick_us_p99", s.tick_us_p99}, {"tick_us_p999", s.tick_us_p999}});
  j.update({{"tick_us_max", s.tick_us_max}, {"wake_us_p99", s.wake_us_p99}, {"wake_us_max", s.wake_us_max}});
  j.update({{"realtime", s.realtime}, {"records_ok", s.records_ok}, {"scenarios", strings(s.scenarios)}});
  j.update({{"input_gaps", s.input_gaps}, {"input_gap_ms", s.input_gap_ms}});
  j.update({{"overload", proto::string_of(s.overload)}});
  return j;
}

constexpr std::array kDeviceWords{"none",         "preparing", "ready", "let go", "not ready",
                                  "uncalibrated", "warm",      "hot",   "lost"};
static_assert(kDeviceWords.size() == mechane_device_lost + 1);
constexpr std::array kSideWords{"right", "left"};
static_assert(kSideWords.size() == mechane_hand_left + 1);
constexpr std::array kCalibrationWords{"none", "flat", "fist", "pinch", "done"};
static_assert(kCalibrationWords.size() == mechane_calibration_done + 1);
constexpr std::array kRefusalWords{"none", "moved", "unlike", "swapped", "unseen"};
static_assert(kRefusalWords.size() == mechane_refusal_unseen + 1);

const char* word_of(std::span<const char* const> words, std::uint32_t number) {
  return number < words.size() ? words[number] : "unknown";
}

Json to_json(const proto::KioskStatus& s) {
  Json j = head(s);
  j.update({{"kiosk", text(s.kiosk)},
            {"session", s.session},
            {"user", s.user},
            {"role", s.role == mechane_role_hand ? "hand" : "watcher"}});
  j.update({{"program", text(s.program)}, {"host", text(s.host)}, {"process_id", s.process_id}});
  j.update({{"scenario", text(s.scenario)}, {"was_there", s.was_there != 0}, {"join_kiosk", text(s.join_kiosk)}});
  j.update({{"device", word_of(kDeviceWords, s.device)},
            {"device_name", text(s.device_name)},
            {"device_side", word_of(kSideWords, s.device_side)}});
  j.update({{"calibration", word_of(kCalibrationWords, s.calibration)},
            {"calibration_held", s.calibration_held},
            {"calibration_refusal", word_of(kRefusalWords, s.calibration_refusal)}});
  return j;
}

template <class Sequence>
Json settings(const Sequence& sequence) {
  Json all = Json::object();
  for (const proto::WireSetting& setting : proto::elements(sequence))
    all[text(setting.name)] = text(setting.value);
  return all;
}

Json to_json(const proto::DisplayStatus& s) {
  Json j = head(s);
  j.update({{"kiosk", text(s.kiosk)}, {"display", text(s.display)}, {"session", s.session}});
  j.update(
      {{"version", proto::string_of(s.version)}, {"host", proto::string_of(s.host)}, {"process_id", s.process_id}});
  j.update({{"uptime_s", s.uptime_s}, {"width", s.width}, {"height", s.height}, {"offscreen", s.offscreen}});
  j.update(
      {{"pictures", s.pictures}, {"pictures_per_s", s.pictures_per_s}, {"picture_ms_median", s.picture_ms_median}});
  j.update({{"picture_ms_p99", s.picture_ms_p99}, {"wanted_per_s", s.wanted_per_s}, {"link", s.link}});
  j.update({{"refusal", proto::string_of(s.refusal)}, {"world", proto::string_of(s.world)}});
  j.update(
      {{"scenario", proto::string_of(s.scenario)}, {"frames_per_s", s.frames_per_s}, {"frames_lost", s.frames_lost}});
  j.update({{"missing_total", s.missing_total},
            {"missing", strings(s.missing)},
            {"renderer", proto::string_of(s.renderer)}});
  j.update({{"sound", proto::string_of(s.sound)}, {"sound_problem", proto::string_of(s.sound_problem)}});
  j.update({{"showing", proto::string_of(s.showing)}, {"warnings", s.warnings}});
  j.update({{"last_warning", proto::string_of(s.last_warning)}, {"settings", settings(s.settings)}});
  Json answers = Json::array();
  for (const proto::WireRequestAnswer& a : proto::elements(s.answers)) {
    answers.push_back(
        {{"id", a.id}, {"refusal", proto::string_of(a.refusal)}, {"picture", proto::string_of(a.picture)}});
  }
  j["answers"] = answers;
  return j;
}

Json to_json(const proto::ExhibitStatus& s) {
  Json j = head(s);
  j.update({{"server", text(s.server)}, {"incarnation", s.incarnation}, {"changeable", s.changeable}});
  j.update({{"counter", s.counter}, {"preparing", proto::string_of(s.preparing)}, {"loadable", strings(s.loadable)}});
  Json exhibits = Json::array(), answers = Json::array();
  for (const proto::WireExhibit& e : proto::elements(s.exhibits)) {
    exhibits.push_back({{"id", proto::string_of(e.id)},
                        {"content_hash", proto::string_of(e.content_hash)},
                        {"worlds", e.worlds},
                        {"former_worlds", e.former_worlds}});
  }
  for (const proto::WireExhibitAnswer& a : proto::elements(s.answers)) {
    answers.push_back({{"id", a.id},
                       {"refusal", proto::string_of(a.refusal)},
                       {"place", proto::string_of(a.place)},
                       {"remedy", proto::string_of(a.remedy)}});
  }
  j.update({{"exhibits", exhibits}, {"answers", answers}});
  return j;
}
Json to_json(const proto::ExhibitRequest& s) {
  Json j = head(s);
  j.update({{"server", text(s.server)}, {"id", s.id}, {"incarnation", s.incarnation}, {"counter", s.counter}});
  j.update({{"verb", s.verb}, {"exhibit", text(s.exhibit)}, {"now", s.now}});
  return j;
}

Json place(const proto::WireDevicePlace& place) {
  return {{"p_WD", list(place.p_WD)}, {"turn_rad", place.turn_rad}, {"scale", place.scale}};
}

Json to_json(const proto::DeviceStatus& s) {
  Json j = head(s);
  j.update({{"kiosk", text(s.kiosk)}, {"user", s.user}, {"session", s.session}, {"wanted_hz", s.wanted_hz}});
  j.update({{"peak_force_n", s.peak_force_n},
            {"continuous_force_n", s.continuous_force_n},
            {"peak_torque_nm", s.peak_torque_nm},
            {"peak_finger_force_n", s.peak_finger_force_n},
            {"max_stiffness_n_per_m", s.max_stiffness_n_per_m},
            {"workspace_min_m", list(s.workspace_min_m)},
            {"workspace_max_m", list(s.workspace_max_m)},
            {"place", place(s.place)}});
  j.update({{"rate_hz", s.rate_hz}, {"late_us", s.late_us}, {"p_WH", list(s.p_WH)}, {"force_n", s.force_n}});
  j.update({{"temperature", s.temperature},
            {"testing", s.testing},
            {"test_force_n", s.test_force_n},
            {"test_energy_j", s.test_energy_j}});
  j.update({{"answered", s.answered}, {"refusal", text(s.refusal)}});
  return j;
}

Json to_json(const proto::DeviceRequest& s) {
  Json j = head(s);
  j.update({{"kiosk", text(s.kiosk)}, {"id", s.id}, {"user", s.user}, {"action", s.action}, {"place", place(s.place)}});
  return j;
}

Json to_json(const proto::DisplayRequest& s) {
  Json j = head(s);
  j.update({{"kiosk", text(s.kiosk)}, {"display", text(s.display)}, {"session", s.session}, {"id", s.id}});
  j.update({{"settings", settings(s.settings)}, {"picture", s.picture}, {"restart", s.restart}});
  return j;
}

Json to_json(const proto::ViewerHead& s) {
  Json j = head(s);
  j.update({{"kiosk", text(s.kiosk)}, {"display", text(s.display)}, {"session", s.session}, {"seen", s.seen}});
  j["X_SV"] = pose(s.X_SV);
  return j;
}

/// Whether a sample's key has the requested kiosk and world.
bool wanted(const Json& j, const EchoOptions& options) {
  const bool kiosk = options.kiosk.empty() || !j.contains("kiosk") || j["kiosk"] == options.kiosk;
  return kiosk && (options.world.empty() || !j.contains("world") || j["world"] == options.world);
}

void print(const std::string& topic, const Json& j, bool as_json) {
  constexpr auto kReplace = Json::error_handler_t::replace;  // texts from the network need not be UTF-8
  if (as_json) {
    std::cout << j.dump(-1, ' ', false, kReplace) << std::endl;
    return;
  }
  std::cout << topic << "\n";
  for (const auto& [name, value] : j.items())
    std::cout << "  " << name << ": " << value.dump(-1, ' ', false, kReplace) << "\n";
  std::cout << std::flush;
}

/// Ends by count, by time, or when interrupted.
class Watch {
 public:
  explicit Watch(const EchoOptions& options) : options_(options), begin_(std::chrono::steady_clock::now()) {
    interrupted = 0;
    previous_ = std::signal(SIGINT, [](int) { interrupted = 1; });
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch() { std::signal(SIGINT, previous_); }

  /// Called by the reader's listener when something has arrived. Any thread.
  void wake() { news_.signal(); }

  /// Waits for news; returns whether to look again. Reports silence once, which would otherwise look like a fault.
  [[nodiscard]] bool goes_on(std::uint64_t seen, const std::string& waits_for) {
    news_.wait(kLookEvery);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
    if (seen == 0 && !told_ && passed.count() > kSilence_s) {
      told_ = true;
      std::cerr << "mechane echo: nothing yet: " << waits_for << " in DDS domain " << options_.domain
                << "; is a server running, with the same domain and CYCLONEDDS_URI? (mechane doctor)" << std::endl;
    }
    const bool enough = options_.count > 0 && seen >= options_.count;
    return interrupted == 0 && !enough && (options_.seconds <= 0 || passed.count() < options_.seconds);
  }

 private:
  static constexpr Duration kLookEvery = std::chrono::milliseconds(100);  // at the clock, and for an interrupt
  static constexpr double kSilence_s = 3;
  const EchoOptions& options_;
  std::chrono::steady_clock::time_point begin_;
  void (*previous_)(int) = SIG_DFL;
  bool told_ = false;
  realtime::Wakeup news_;
};

template <proto::TopicType T>
std::string partition_of(const EchoOptions& options) {
  if (proto::TopicOf<T>::place == proto::Place::kiosk)
    return proto::kiosk_partition(options.kiosk.empty() ? "*" : options.kiosk);
  if (proto::TopicOf<T>::place == proto::Place::world)
    return proto::world_partition(options.world.empty() ? "*" : options.world);
  return "";
}

/// The world that the kiosk is in, for topics that know worlds only. Empty: it is in none, and the watch has ended.
std::string world_of(const proto::Participant& participant, const EchoOptions& options, Watch& watch) {
  std::string world;
  auto reader = proto::Reader<proto::WorldAssignment>::create(participant, "", [&watch](auto) { watch.wake(); });
  if (!reader) return world;
  do {
    reader->view().take_each([&](const proto::WorldAssignment& sample, const proto::SampleInfo& info) {
      if (info.valid && text(sample.kiosk) == options.kiosk) world = text(sample.world);
    });
  } while (world.empty() && watch.goes_on(0, "no kiosk " + options.kiosk + " with a world"));
  return world;
}

template <proto::TopicType T>
int echo(EchoOptions options) {
  auto participant = proto::Participant::create(options.domain);
  if (!participant) return std::cerr << "mechane echo: " << participant.error().to_string() << "\n", 1;
  Watch watch(options);
  if (proto::TopicOf<T>::place == proto::Place::world && options.world.empty() && !options.kiosk.empty()) {
    options.world = world_of(*participant, options, watch);
    if (options.world.empty()) return 1;
  }
  auto reader = proto::Reader<T>::create(*participant, partition_of<T>(options), [&watch](auto) { watch.wake(); });
  if (!reader) return std::cerr << "mechane echo: " << reader.error().to_string() << "\n", 1;
  std::uint64_t seen = 0;
  do {
    reader->view().take_each([&](const T& sample, const proto::SampleInfo& info) {
      if (!info.valid || (options.count > 0 && seen >= options.count)) return;
      const Json j = to_json(sample);
      if (!wanted(j, options)) return;
      ++seen;
      print(proto::TopicOf<T>::name, j, options.json);
    });
  } while (watch.goes_on(seen, std::string("no ") + proto::TopicOf<T>::name));
  return seen == 0 && options.seconds > 0 ? 1 : 0;
}

struct Topic {
  const char* name;
  int (*run)(EchoOptions);
};

template <proto::TopicType T>
constexpr Topic topic() {
  return {proto::TopicOf<T>::name, echo<T>};
}

}  // namespace

int run_echo(const EchoOptions& options) {
  static constexpr Topic kTopics[] = {
      topic<proto::HapticInput>(),  topic<proto::HapticOutput>(),      topic<proto::SceneFrame>(),
      topic<proto::SceneObject>(),  topic<proto::WorldStatus>(),       topic<proto::Event>(),
      topic<proto::Command>(),      topic<proto::WorldAssignment>(),   topic<proto::ServerStatus>(),
      topic<proto::KioskStatus>(),  topic<proto::WorldPresentation>(), topic<proto::DisplayStatus>(),
      topic<proto::DeviceStatus>(), topic<proto::DeviceRequest>(),     topic<proto::DisplayRequest>(),
      topic<proto::ViewerHead>(),   topic<proto::ExhibitStatus>(),     topic<proto::ExhibitRequest>()};
  for (const Topic& t : kTopics) {
    if (options.topic == t.name) return t.run(options);
  }
  std::ostream& out = options.topic.empty() ? std::cout : std::cerr;
  if (!options.topic.empty()) out << "mechane echo: there is no topic '" << options.topic << "'. ";
  out << "Topics:\n";
  for (const Topic& t : kTopics)
    out << "  " << t.name << "\n";
  return options.topic.empty() ? 0 : 2;
}

}  // namespace mechane::cli
