#include "client-sdk/gateway/exhibit_api.hpp"

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include <mechane/client/exhibits.hpp>

namespace mechane::gateway {
namespace {

using client::ExhibitStatus;
using ExhibitJson = nlohmann::json;

constexpr std::string_view kExhibits = "/api/exhibits/";
constexpr std::string_view kGiveKey =
    "start the gateway with the server's folder of records (--records FOLDER), or with its key (--exhibit-key FILE)";
constexpr Duration kServerWithin = std::chrono::seconds(2);
/// Fitting the parts of a new mesh takes minutes; whoever asked may look at GET /api/exhibits meanwhile.
constexpr Duration kLoadedWithin = std::chrono::minutes(10);

HttpAnswer exhibit_answer(const ExhibitJson& json, unsigned status = 200) {
  return fresh_answer(json.dump(-1, ' ', false, ExhibitJson::error_handler_t::replace), "application/json", status);
}

/// What to do before exhibits can be changed here; empty: they can.
std::string_view remedy_of(const ExhibitStatus& status, bool has_key) {
  if (!status.changeable) return "start the server with a folder of records, or with --exhibit-key FILE";
  return has_key ? "" : kGiveKey;
}

ExhibitJson exhibits_json(const ExhibitStatus& status, bool has_key) {
  ExhibitJson list = ExhibitJson::array();
  for (const client::OpenableExhibit& exhibit : status.exhibits)
    list.push_back({{"id", exhibit.id},
                    {"title", exhibit.title},
                    {"contentHash", exhibit.content_hash},
                    {"worlds", exhibit.worlds},
                    {"formerWorlds", exhibit.former_worlds}});
  return {{"server", status.server},
          {"changeable", remedy_of(status, has_key).empty()},
          {"remedy", std::string(remedy_of(status, has_key))},
          {"preparing", status.preparing},
          {"exhibits", list},
          {"loadable", status.loadable}};
}

void ask(GatewaySite& site, const client::ExhibitRequest& request, const Site::Done& done) {
  if (site.options().exhibit_key.empty()) {
    return done(refusal(404, "this gateway has no key of the server", std::string(kGiveKey)));
  }
  client::ExhibitWatch& watch = site.exhibits();
  const auto servers = watch.servers();
  if (servers.empty()) return done(refusal(503, "no server is heard", "check that the server runs"));
  const auto id = watch.request(servers.front().server, request, site.options().exhibit_key);
  if (!id) return done(refusal(id.error()));
  const auto look = [&watch, id = *id, name = request.exhibit]() -> std::optional<HttpAnswer> {
    const auto answer = watch.answer(id);
    if (!answer) return std::nullopt;
    if (answer->refusal.empty()) return exhibit_answer({{"exhibit", name}});
    return exhibit_answer({{"error", answer->refusal}, {"place", answer->place}, {"remedy", answer->remedy}}, 409);
  };
  site.wait_for(look, kLoadedWithin,
                refusal(504, "the server has not answered yet", "GET /api/exhibits tells what it prepares"), done);
}

}  // namespace

bool answer_exhibits_get(GatewaySite& site, const HttpRequest& request, const Site::Done& done) {
  if (request.path != "/api/exhibits") return false;
  const bool has_key = !site.options().exhibit_key.empty();
  const auto look = [&site, has_key]() -> std::optional<HttpAnswer> {
    const auto servers = site.exhibits().servers();
    if (servers.empty()) return std::nullopt;
    return exhibit_answer(exhibits_json(servers.front(), has_key));
  };
  site.wait_for(look, kServerWithin, refusal(503, "no server is heard", "check that the server runs"), done);
  return true;
}

bool answer_exhibits_post(GatewaySite& site, const HttpRequest& request, bool now, const Site::Done& done) {
  if (!request.path.starts_with(kExhibits)) return false;
  const std::string rest = request.path.substr(kExhibits.size());
  const std::size_t slash = rest.find('/');
  if (slash == std::string::npos) return false;
  const auto verb = client::exhibit_verb(rest.substr(slash + 1));
  if (!verb) return false;
  ask(site, {.verb = *verb, .exhibit = rest.substr(0, slash), .now = now}, done);
  return true;
}

}  // namespace mechane::gateway
