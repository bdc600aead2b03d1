#include "client-sdk/gateway/operations_api.hpp"

#include <algorithm>
#include <ctime>

#include <nlohmann/json.hpp>

#include "client-sdk/gateway/operations/wake_on_lan.hpp"
#include "client-sdk/gateway/operator_api.hpp"

namespace mechane::gateway {
namespace {

using OrderJson = nlohmann::json;

constexpr Duration kRestartsWithin = std::chrono::seconds(5);

HttpAnswer order_answer(const OrderJson& json) {
  return fresh_answer(json.dump(-1, ' ', false, OrderJson::error_handler_t::replace));
}

void store(GatewaySite& site, OperationsState next, const OrderJson& json, const Site::Done& done) {
  if (auto written = site.operations().change(std::move(next)); !written) return done(refusal(written.error()));
  done(order_answer(json));
}

void put_hours(GatewaySite& site, const std::string& body, const Site::Done& done) {
  auto hours = parse_hours(body);
  if (!hours) return done(refusal(hours.error()));
  OperationsState next = site.operations().state();
  next.hours = std::move(*hours);
  store(site, std::move(next), OrderJson::object(), done);
}

void add_message(GatewaySite& site, const std::string& body, const Site::Done& done) {
  auto message = parse_visitor_message(body, wall_now());
  if (!message) return done(refusal(message.error()));
  for (const std::string& kiosk : message->kiosks)
    if (!site.knows_kiosk(kiosk)) return done(unknown_kiosk(kiosk));
  OperationsState next = without_ended(site.operations().state(), wall_now());
  if (next.messages.size() >= OperationsState::kMostMessages)
    return done(refusal(409, "there are too many messages", "remove one that is not needed"));
  message->id = next.next_id++;
  const OrderJson json{{"id", message->id}, {"until", message->until}};
  next.messages.push_back(std::move(*message));
  store(site, std::move(next), json, done);
}

std::optional<std::uint64_t> id_in(const OrderJson& json) {
  const auto found = json.find("id");
  if (found == json.end() || !found->is_number_unsigned()) return std::nullopt;
  return found->get<std::uint64_t>();
}

void remove_message(GatewaySite& site, const OrderJson& json, const Site::Done& done) {
  const auto id = id_in(json);
  OperationsState next = site.operations().state();
  if (!id || std::erase_if(next.messages, [id](const VisitorMessage& one) { return one.id == *id; }) == 0)
    return done(refusal(404, "there is no such message", "GET /api/operations lists them"));
  store(site, std::move(next), OrderJson::object(), done);
}

/// Ends a timed change now; the keeper takes it back.
void end_change(GatewaySite& site, const OrderJson& json, const Site::Done& done) {
  const auto id = id_in(json);
  OperationsState next = site.operations().state();
  const auto found = std::ranges::find_if(next.changes, [id](const TimedChange& one) { return id && one.id == *id; });
  if (found == next.changes.end())
    return done(refusal(404, "there is no such change", "GET /api/operations lists them"));
  found->until = wall_now();
  store(site, std::move(next), OrderJson::object(), done);
}

void maintain(GatewaySite& site, const std::string& kiosk, const OrderJson& json, const std::string& body,
              const Site::Done& done) {
  if (!json.contains("on") || !json["on"].is_boolean())
    return done(refusal(400, "on must be true or false",
                        R"(send {"on": true, "minutes": 60}; without minutes it ends by hand)"));
  const auto end = parse_end(body, wall_now());
  if (!end) return done(refusal(end.error()));
  OperationsState next = site.operations().state();
  if (json["on"].get<bool>())
    next.maintenance[kiosk] = *end;
  else
    next.maintenance.erase(kiosk);
  if (next.maintenance.size() > OperationsState::kMostInMaintenance)
    return done(refusal(409, "too many kiosks are under maintenance", "end it at one of them"));
  store(site, std::move(next), OrderJson::object(), done);
}

void restart_display(GatewaySite& site, const std::string& kiosk, const OrderJson& json, const Site::Done& done) {
  const std::string display = json.contains("display") && json["display"].is_string() ? json["display"] : OrderJson("");
  const auto all = site.watch().displays();
  const auto found = std::ranges::find_if(
      all, [&](const client::DisplayStatus& one) { return one.kiosk == kiosk && one.display == display; });
  if (found == all.end())
    return done(refusal(404, "no such display is running", "name one display: GET /api/kiosks lists them"));
  const auto id = site.watch().request(kiosk, display, {.restart = true});
  if (!id) return done(refusal(id.error()));
  const auto look = [&site, id = *id, session = found->session]() -> std::optional<HttpAnswer> {
    const auto now = site.watch().displays();
    const auto same = std::ranges::find(now, session, &client::DisplayStatus::session);
    if (same == now.end()) return order_answer({{"restarts", true}});  // it has ended already
    const auto answer = std::ranges::find(same->answers, id, &client::RequestAnswer::id);
    if (answer == same->answers.end()) return std::nullopt;
    if (!answer->refusal.empty()) return refusal(409, answer->refusal, "reload the browser's page");
    return order_answer({{"restarts", true}});
  };
  site.wait_for(look, kRestartsWithin, refusal(504, "the display did not answer in time", "see its log"), done);
}

void wake_kiosk(GatewaySite& site, const std::string& kiosk, const Site::Done& done) {
  const auto& known = site.operations().state().hours.wake;
  const auto found = known.find(kiosk);
  const auto mac = found == known.end() ? std::nullopt : parse_mac(found->second);
  if (!mac)
    return done(refusal(404, "no MAC address is known of this kiosk", "write it into the opening hours, under wake"));
  if (auto sent = wake(*mac, site.options().wake_to); !sent) return done(refusal(sent.error()));
  done(order_answer(OrderJson::object()));
}

bool post_order_of_kiosk(GatewaySite& site, const std::string& kiosk, const std::string& verb, const std::string& body,
                         const Site::Done& done) {
  if (verb != "maintenance" && verb != "restart" && verb != "wake") return false;
  if (verb == "wake") return wake_kiosk(site, kiosk, done), true;  // it sleeps, and may not be known
  if (!site.knows_kiosk(kiosk)) return done(unknown_kiosk(kiosk)), true;
  const OrderJson json = OrderJson::parse(body, nullptr, false);
  if (verb == "restart") return restart_display(site, kiosk, json, done), true;
  return maintain(site, kiosk, json, body, done), true;
}

/// What a display says of a setting; its own words for a value that was written otherwise, such as 0.50.
std::string said_value(const std::string& name, const std::string& value) {
  client::DisplaySettings tried;
  if (!client::apply({name, value}, tried)) return value;
  for (const client::DisplaySetting& setting : client::settings_of(tried))
    if (setting.name == name) return setting.value;
  return value;
}

std::vector<TimedChange> changes_in(GatewaySite& site, const std::string& kiosk, const std::string& verb,
                                    const OrderJson& json) {
  std::vector<TimedChange> out;
  const auto text = [&json](const char* key) {
    return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : std::string();
  };
  if (verb == "open") {
    TimedChange change{0, kiosk, "exhibit", text("scenario"), {{"", ""}}, 0};
    for (const client::DisplayStatus& display : site.watch().displays())
      if (display.kiosk == kiosk && !display.scenario.empty()) change.before[""] = display.scenario;
    if (const auto hub = site.hubs().find(kiosk); hub != site.hubs().end() && hub->second->status() != nullptr)
      change.before[""] = hub->second->status()->scenario;
    out.push_back(std::move(change));
  }
  if (verb != "settings" || !json.contains("settings") || !json["settings"].is_object()) return out;
  for (const auto& [name, value] : json["settings"].items()) {
    if (!value.is_string()) continue;
    TimedChange change{0, kiosk, name, said_value(name, value.get<std::string>()), {}, 0};
    for (const client::DisplayStatus& display : site.watch().displays()) {
      if (display.kiosk != kiosk || (!text("display").empty() && display.display != text("display"))) continue;
      for (const client::DisplaySetting& setting : display.settings)
        if (setting.name == name) change.before[display.display] = setting.value;
    }
    out.push_back(std::move(change));
  }
  return out;
}

std::string zone_name(std::int64_t now) {
  const std::time_t time = now;
  std::tm local{};
  ::localtime_r(&time, &local);
  return local.tm_zone == nullptr ? "" : local.tm_zone;
}

}  // namespace

HttpAnswer operations_answer(GatewaySite& site) {
  const OperationsState& state = site.operations().state();
  const std::int64_t now = wall_now();
  // What is stored, but for what only the gateway needs.
  OrderJson out = OrderJson::parse(operations_text(state));
  out.erase("nextId");
  for (OrderJson& change : out["changes"])
    change.erase("before");
  OrderJson kiosks = OrderJson::array();
  for (const std::string& kiosk : site.kiosks()) {
    const KioskTarget target = target_of(state, kiosk, now);
    const HoursPlan* const plan = plan_of(state.hours, kiosk);
    const auto changes = plan == nullptr ? std::nullopt : next_change(*plan, now);
    kiosks.push_back({{"kiosk", kiosk},
                      {"open", target.open},
                      {"sign", target.sign},
                      {"changesAt", changes ? OrderJson(*changes) : OrderJson()}});
  }
  out.update({{"now", now}, {"zone", zone_name(now)}, {"kiosks", kiosks}});
  return order_answer(out);
}

bool answer_operations_post(GatewaySite& site, const HttpRequest& request, const Site::Done& done) {
  const std::string& path = request.path;
  if (path == "/api/hours") return put_hours(site, request.body, done), true;
  if (path == "/api/messages") return add_message(site, request.body, done), true;
  if (path == "/api/messages/remove")
    return remove_message(site, OrderJson::parse(request.body, nullptr, false), done), true;
  if (path == "/api/changes/end") return end_change(site, OrderJson::parse(request.body, nullptr, false), done), true;
  constexpr std::string_view kKiosk = "/api/kiosks/";
  if (!path.starts_with(kKiosk)) return false;
  const std::string rest = path.substr(kKiosk.size());
  const std::size_t slash = rest.find('/');
  if (slash == std::string::npos) return false;
  return post_order_of_kiosk(site, rest.substr(0, slash), rest.substr(slash + 1), request.body, done);
}

Expected<Site::Done> with_end(GatewaySite& site, const std::string& kiosk, const std::string& verb,
                              const std::string& body, const Site::Done& done) {
  if (verb != "open" && verb != "settings") return done;
  const auto end = parse_end(body, wall_now());
  if (!end) return tl::unexpected(end.error());
  std::vector<TimedChange> changes = changes_in(site, kiosk, verb, OrderJson::parse(body, nullptr, false));
  OperationsState tried = site.operations().state();
  for (TimedChange& change : changes) {
    change.until = end->value_or(0);
    if (*end)
      if (auto added = add_change(tried, change); !added) return tl::unexpected(added.error());
  }
  return Site::Done([&site, changes = std::move(changes), timed = end->has_value(), done](HttpAnswer answer) {
    if (answer.status != 200) return done(std::move(answer));
    OperationsState next = site.operations().state();
    for (const TimedChange& change : changes) {
      if (!timed)
        std::erase_if(next.changes, [&change](const TimedChange& known) {
          return known.kiosk == change.kiosk && known.name == change.name;
        });
      else if (auto added = add_change(next, change); !added)
        return done(refusal(added.error()));
    }
    if (auto written = site.operations().change(std::move(next)); !written) return done(refusal(written.error()));
    done(std::move(answer));
  });
}

}  // namespace mechane::gateway
