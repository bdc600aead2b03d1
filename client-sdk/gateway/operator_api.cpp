#include "client-sdk/gateway/operator_api.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "client-sdk/gateway/browsers/asked_devices.hpp"
#include "client-sdk/gateway/browsers/device_json.hpp"
#include "client-sdk/gateway/exhibit_api.hpp"
#include "client-sdk/gateway/http/request_path.hpp"
#include "client-sdk/gateway/http/security_headers.hpp"
#include "client-sdk/gateway/operations_api.hpp"
#include "client-sdk/gateway/sign_in/secrets.hpp"
#include "client-sdk/gateway/studio_api.hpp"
#include "client-sdk/gateway/visits_api.hpp"
#include "server/log/log.hpp"
#include <mechane/proto/identity.hpp>

namespace mechane::gateway {
namespace {

using ApiJson = nlohmann::json;
using Done = Site::Done;
using client::DisplayStatus;

constexpr Duration kOpensWithin = std::chrono::seconds(15);
constexpr Duration kAnswersWithin = std::chrono::seconds(5);
constexpr Duration kPictureWithin = std::chrono::seconds(20);
constexpr std::size_t kAuditShown = 500;

/// Of "/api/kiosks/NAME/VERB"; none: the path is another one.
std::optional<std::pair<std::string, std::string>> kiosk_and_verb(const std::string& path) {
  constexpr std::string_view kKiosks = "/api/kiosks/";
  if (!path.starts_with(kKiosks)) return std::nullopt;
  const std::string rest = path.substr(kKiosks.size());
  const std::size_t slash = rest.find('/');
  if (slash == std::string::npos) return std::nullopt;
  return std::pair(rest.substr(0, slash), rest.substr(slash + 1));
}

HttpAnswer json_answer(const ApiJson& json) {
  return fresh_answer(json.dump(-1, ' ', false, ApiJson::error_handler_t::replace));
}

HttpAnswer not_allowed(std::string_view role) {
  return refusal(403, "this is for the role " + std::string(role), "sign in as somebody who has it");
}

ApiJson display_json(const DisplayStatus& display) {
  ApiJson settings = ApiJson::object();
  for (const client::DisplaySetting& setting : display.settings)
    settings[setting.name] = setting.value;
  return {{"display", display.display},
          {"session", std::to_string(display.session)},
          {"version", display.version},
          {"host", display.host},
          {"uptime", display.uptime_s},
          {"width", display.width},
          {"height", display.height},
          {"picturesPerS", display.pictures_per_s},
          {"pictureMsMedian", display.picture_ms_median},
          {"pictureMsP99", display.picture_ms_p99},
          {"link", display.link},
          {"refusal", display.refusal},
          {"world", display.world},
          {"scenario", display.scenario},
          {"framesPerS", display.frames_per_s},
          {"framesLost", display.frames_lost},
          {"missing", display.missing},
          {"renderer", display.renderer},
          {"offscreen", display.offscreen},
          {"sound", display.sound},
          {"soundProblem", display.sound_problem},
          {"showing", display.showing},
          {"warnings", display.warnings},
          {"lastWarning", display.last_warning},
          {"settings", settings}};
}

std::string origin_seen(const HttpRequest& request) {
  return (request.secure ? "https://" : "http://") + request.header("host");
}

ApiJson kiosk_json(GatewaySite& site, const std::string& kiosk, const HttpRequest& request, bool with_address) {
  ApiJson out{
      {"kiosk", kiosk}, {"displays", ApiJson::array()}, {"devices", ApiJson::array()}, {"scenario", ""}, {"world", ""},
      {"browsers", 0}};
  for (const client::KioskDevice& device : site.watch().devices())
    if (device.kiosk == kiosk) out["devices"].push_back(device_json(device.report));
  for (const DisplayStatus& display : site.watch().displays()) {
    if (display.kiosk != kiosk) continue;
    out["displays"].push_back(display_json(display));
    if (!display.world.empty()) out["world"] = display.world;
    if (!display.scenario.empty()) out["scenario"] = display.scenario;
  }
  if (const auto hub = site.hubs().find(kiosk); hub != site.hubs().end()) {
    out["browsers"] = hub->second->browsers();
    if (const client::WorldStatus* status = hub->second->status()) {
      out["world"] = status->world;
      out["scenario"] = status->scenario;
      out["activity"] = status->activity;
      out["step"] = status->step;
    }
  }
  if (with_address) out["address"] = site.address_of(kiosk, origin_seen(request));
  return out;
}

ApiJson server_json(const client::ServerStatus& status) {
  return {{"server", status.server},
          {"version", status.version},
          {"worlds", status.worlds},
          {"worldsLimit", status.worlds_limit},
          {"users", status.users},
          {"ticks", status.ticks},
          {"overruns", status.overruns},
          {"lateWakeups", status.late_wakeups},
          {"preemptions", status.preemptions},
          {"tickUs",
           {{"median", status.tick_us_median},
            {"p99", status.tick_us_p99},
            {"p999", status.tick_us_p999},
            {"max", status.tick_us_max}}},
          {"wakeUs", {{"p99", status.wake_us_p99}, {"max", status.wake_us_max}}},
          {"realtime", status.realtime},
          {"recordsOk", status.records_ok},
          {"scenarios", status.scenarios},
          {"inputGaps", status.input_gaps},
          {"inputGapMs", status.input_gap_ms},
          {"overload", status.overload}};
}

/// The server is heard by a kiosk's client: that of a kiosk in use, or else of the first one.
void answer_server(GatewaySite& site, const Done& done) {
  std::shared_ptr<KioskHub> hub;
  for (const auto& [kiosk, known] : site.hubs())
    if (!hub || known->browsers() > 0) hub = known;
  const auto gateway = [&site] {
    const WebServer::Traffic traffic = site.traffic();
    return ApiJson{{"version", MECHANE_VERSION},
                   {"connections", traffic.connections},
                   {"refused", traffic.refused},
                   {"framesSkipped", traffic.frames_skipped}};
  };
  if (!hub) return done(json_answer({{"server", nullptr}, {"gateway", gateway()}}));
  site.wait_for(
      [hub, gateway]() -> std::optional<HttpAnswer> {
        const auto status = hub->client() == nullptr ? std::nullopt : hub->client()->server_status();
        if (!status) return std::nullopt;
        return json_answer({{"server", server_json(*status)}, {"gateway", gateway()}});
      },
      std::chrono::seconds(2), json_answer({{"server", nullptr}, {"gateway", gateway()}}), done);
}

HttpAnswer audit_answer(const std::filesystem::path& file) {
  ApiJson list = ApiJson::array();
  for (const AuditEntry& entry : newest_entries(file, kAuditShown))
    list.push_back({{"time", entry.time},
                    {"user", entry.user},
                    {"address", entry.address},
                    {"action", entry.action},
                    {"detail", entry.detail}});
  return json_answer({{"entries", list}});
}

// POST

std::optional<std::string> stated(const ApiJson& json, const char* key) {
  if (!json.is_object() || !json.contains(key) || !json[key].is_string()) return std::nullopt;
  return json[key].get<std::string>();
}

/// The displays that a request is for, by session.
std::vector<DisplayStatus> meant_displays(GatewaySite& site, const std::string& kiosk, const std::string& display) {
  std::vector<DisplayStatus> meant = site.watch().displays();
  std::erase_if(meant, [&](const DisplayStatus& one) {
    return one.kiosk != kiosk || (!display.empty() && one.display != display);
  });
  return meant;
}

std::optional<client::RequestAnswer> answer_of(const DisplayStatus& display, std::uint64_t id) {
  const auto found = std::ranges::find(display.answers, id, &client::RequestAnswer::id);
  if (found == display.answers.end()) return std::nullopt;
  return *found;
}

void change_settings(GatewaySite& site, const std::string& kiosk, const ApiJson& json, const Done& done) {
  std::vector<client::DisplaySetting> settings;
  const bool listed = json.contains("settings") && json["settings"].is_object() && json["settings"].size() <= 20;
  if (!listed) return done(refusal(400, "there are no settings", R"(send {"settings":{"volume":"0.5"}})"));
  for (const auto& [name, value] : json["settings"].items()) {
    if (!value.is_string())
      return done(refusal(400, "a setting's value must be a text: " + name, "write it in quotes"));
    settings.push_back({name, value.get<std::string>()});
  }
  const std::string display = stated(json, "display").value_or("");
  const std::size_t asked = meant_displays(site, kiosk, display).size();
  if (asked == 0) return done(refusal(404, "no such display is running", "GET /api/kiosks lists them"));
  const auto id = site.watch().request(kiosk, display, {.settings = settings});
  if (!id) return done(refusal(id.error()));
  const auto look = [&site, kiosk, display, asked, id = *id]() -> std::optional<HttpAnswer> {
    ApiJson answers = ApiJson::array();
    for (const DisplayStatus& one : meant_displays(site, kiosk, display))
      if (const auto answer = answer_of(one, id))
        answers.push_back({{"display", one.display}, {"refusal", answer->refusal}});
    if (answers.size() < asked) return std::nullopt;
    return json_answer({{"answers", answers}});
  };
  site.wait_for(look, kAnswersWithin,
                refusal(504, "not every display answered in time", "GET /api/kiosks shows what was changed"), done);
}

HttpAnswer picture_file(const std::string& path) {
  FileStore once;
  const std::filesystem::path file(path);
  if (content_type_of(file) != "image/png")
    return refusal(502, "the display's picture is not a PNG file", "see its log");
  return once.answer({file.parent_path(), file.filename().string()});
}

void take_picture(GatewaySite& site, const std::string& kiosk, const std::string& display, const Done& done) {
  if (meant_displays(site, kiosk, display).size() != 1)
    return done(refusal(404, "a picture is taken of one display at a time", "name one that runs: GET /api/kiosks"));
  const auto id = site.watch().request(kiosk, display, {.picture = true});
  if (!id) return done(refusal(id.error()));
  const auto path = std::make_shared<std::string>();
  const auto then = [&site, path, done](HttpAnswer answer) {
    if (path->empty()) return done(std::move(answer));
    site.on_disk([path] { return picture_file(*path); }, done);
  };
  const auto look = [&site, kiosk, display, path, id = *id]() -> std::optional<HttpAnswer> {
    for (const DisplayStatus& one : meant_displays(site, kiosk, display)) {
      const auto answer = answer_of(one, id);
      if (!answer) continue;
      if (!answer->refusal.empty()) return refusal(409, answer->refusal, "start the display with --out FOLDER");
      if (one.host != proto::host_name())
        return refusal(409, "the picture is on another machine: " + one.host, "look at " + answer->picture + " there");
      *path = answer->picture;
      return HttpAnswer{};
    }
    return std::nullopt;
  };
  site.wait_for(look, kPictureWithin, refusal(504, "the display took no picture in time", "see its log"), then);
}

void put_account(GatewaySite& site, const ApiJson& json, const Done& done) {
  const auto user = stated(json, "user"), role = stated(json, "role"), password = stated(json, "password");
  const auto known = role ? role_of(*role) : std::nullopt;
  if (!user || !known || !password)
    return done(refusal(400, "user, role and password are needed", "roles are visitor, author and operator"));
  if (password->size() < Accounts::kLeastPassword)
    return done(refusal(400, "the password is too short", "take ten letters or more"));
  const bool given =
      site.on_passwords([&site, user = *user, role = *known, password = *password, done]() -> std::function<void()> {
        auto hash = hash_password(password);
        return [&site, user, role, done, hash] {
          if (!hash) return done(refusal(hash.error()));
          if (auto put = site.accounts().put(user, {role, *hash}); !put) return done(refusal(put.error()));
          site.sessions().end_of(user);
          done(json_answer(ApiJson::object()));
        };
      });
  if (!given) done(refusal(503, "too many passwords at a time", "try again in a few seconds"));
}

ApiJson accounts_json(const Accounts& accounts) {
  ApiJson list = ApiJson::array();
  for (const auto& [user, account] : accounts.all())
    list.push_back({{"user", user}, {"role", word_of(account.role)}});
  return {{"accounts", list}};
}

/// A kiosk that no browser uses is joined first, which takes a moment. `order`: what a device is asked; null: nothing.
void look_at_devices(GatewaySite& site, const std::string& kiosk,
                     const std::shared_ptr<const client::DeviceRequest>& order, const Done& done) {
  const auto hub = site.hub_of(kiosk);
  if (!hub) return done(refusal(503, "too many kiosks are in use", "try again later"));
  const auto look = [hub, order]() -> std::optional<HttpAnswer> {
    hub->use(time_now());
    if (hub->link() != client::LinkState::joined) return std::nullopt;
    if (order)
      if (const auto sent = hub->asked_devices().ask(*hub->client(), *order, time_now()); !sent)
        return refusal(sent.error());
    return json_answer({{"devices", hub->devices_json(time_now())}});
  };
  site.wait_for(look, kAnswersWithin,
                refusal(504, "the kiosk could not be joined in time", "check that the server runs"), done);
}

bool post_to_kiosk(GatewaySite& site, const std::string& kiosk, const std::string& verb, const ApiJson& json,
                   const std::string& body, const Done& answer) {
  if (!site.knows_kiosk(kiosk)) return answer(unknown_kiosk(kiosk)), true;
  if (verb == "device") {
    const auto order = parse_device_order(body);
    if (!order) return answer(refusal(order.error())), true;
    return look_at_devices(site, kiosk, std::make_shared<const client::DeviceRequest>(*order), answer), true;
  }
  const auto until_then = with_end(site, kiosk, verb, body, answer);
  if (!until_then) return answer(refusal(until_then.error())), true;
  const Done& done = *until_then;
  if (verb == "open") {
    const auto scenario = stated(json, "scenario");
    if (!scenario) return done(refusal(400, "no scenario is named", R"(send {"scenario":""} for home)")), true;
    return open_at_kiosk(site, kiosk, *scenario, done), true;
  }
  if (verb == "settings") return change_settings(site, kiosk, json, done), true;
  if (verb != "picture") return false;
  return take_picture(site, kiosk, stated(json, "display").value_or(""), done), true;
}

}  // namespace

void open_at_kiosk(GatewaySite& site, const std::string& kiosk, const std::string& scenario, const Done& done) {
  const auto hub = site.hub_of(kiosk);
  if (!hub) return done(refusal(503, "too many kiosks are in use", "try again later"));
  const auto sent = std::make_shared<std::uint64_t>(0);
  const auto look = [hub, scenario, sent]() -> std::optional<HttpAnswer> {
    hub->use(time_now());
    if (hub->link() != client::LinkState::joined || hub->status() == nullptr) return std::nullopt;
    const auto server = hub->client()->server_status();
    if (!server || server->scenarios.empty()) return std::nullopt;
    const std::string wanted = scenario.empty() ? server->scenarios.front() : scenario;
    if (std::ranges::count(server->scenarios, wanted) == 0)
      return refusal(404, "the server has no exhibit '" + wanted + "'", "GET /api/server lists them");
    if (hub->status()->scenario == wanted) return json_answer({{"world", hub->status()->world}, {"scenario", wanted}});
    if (*sent == 0) *sent = hub->client()->open_exhibit(scenario);
    if (*sent != 0 && hub->refused(*sent))
      return refusal(409, "the server refused to open the exhibit", "see the server's log");
    return std::nullopt;
  };
  site.wait_for(look, kOpensWithin,
                refusal(504, "the kiosk did not go on to the exhibit in time", "check that the server runs"), done);
}

HttpAnswer unknown_kiosk(const std::string& kiosk) {
  return refusal(404, "there is no kiosk '" + kiosk + "'", "GET /api/kiosks lists them");
}

bool answer_api_get(GatewaySite& site, const Session& session, const HttpRequest& request, const Done& done) {
  if (session.role == Role::visitor) return done(not_allowed("author or operator")), true;
  const std::string& path = request.path;
  const bool operates = session.role == Role::manager;
  if (path == "/api/kiosks") {
    ApiJson list = ApiJson::array();
    for (const std::string& kiosk : site.kiosks())
      list.push_back(kiosk_json(site, kiosk, request, operates));
    return done(json_answer({{"kiosks", list}})), true;
  }
  if (path == "/api/server") return answer_server(site, done), true;
  if (path == "/api/operations") return done(operations_answer(site)), true;
  if (answer_visits_get(site, request, done)) return true;
  if (answer_studio_get(site, request, done)) return true;
  if (const auto at = kiosk_and_verb(path); operates && at && at->second == "devices") {
    if (!site.knows_kiosk(at->first)) return done(unknown_kiosk(at->first)), true;
    return look_at_devices(site, at->first, nullptr, done), true;
  }
  const bool for_operators = path == "/api/audit" || path == "/api/accounts" || path == "/api/exhibits";
  if (!for_operators) return false;
  if (!operates) return done(not_allowed("operator")), true;
  if (path == "/api/accounts") return done(json_answer(accounts_json(site.accounts()))), true;
  if (answer_exhibits_get(site, request, done)) return true;
  site.on_disk([file = site.audit().file()] { return audit_answer(file); }, done);
  return true;
}

bool answer_api_post(GatewaySite& site, const Session& session, const HttpRequest& request, const Done& done) {
  if (answer_visits_post(site, session, request, done)) return true;
  if (answer_studio_post(site, session, request, done)) return true;
  if (session.role != Role::manager) return done(not_allowed("operator")), true;
  const ApiJson json = ApiJson::parse(request.body, nullptr, false);
  if (!json.is_object()) return done(refusal(400, "this request is not a JSON object", "send an object")), true;
  ApiJson told = json;  // without secrets
  if (told.contains("password")) told["password"] = "...";
  const std::string detail = told.dump(-1, ' ', false, ApiJson::error_handler_t::replace).substr(0, 500);
  if (!site.note(session, request, request.path, detail))
    return done(refusal(500, "the audit log cannot be written, so nothing was done", "see the gateway's log")), true;
  if (request.path == "/api/accounts") return put_account(site, json, done), true;
  if (request.path == "/api/accounts/remove") {
    const std::string user = stated(json, "user").value_or("");
    auto removed = site.accounts().remove(user);
    if (!removed) return done(refusal(removed.error())), true;
    site.sessions().end_of(user);
    return done(json_answer(ApiJson::object())), true;
  }
  const bool now = json.contains("now") && json["now"].is_boolean() && json["now"].get<bool>();
  if (answer_exhibits_post(site, request, now, done)) return true;
  if (answer_operations_post(site, request, done)) return true;
  const auto at = kiosk_and_verb(request.path);
  return at && post_to_kiosk(site, at->first, at->second, json, request.body, done);
}

}  // namespace mechane::gateway
