#include "client-sdk/gateway/visits_api.hpp"

#include <array>
#include <optional>

#include "client-sdk/gateway/operations/visits_json.hpp"
#include "server/visits/visit_csv.hpp"
#include <mechane/proto/names.hpp>

namespace mechane::gateway {
namespace {

constexpr std::string_view kVisitsPath = "/api/visits";
constexpr std::string_view kSpreadsheetPath = "/api/visits.csv";
constexpr std::string_view kRemarksVerb = "/remarks";
constexpr std::string_view kPlaybackVerb = "/playback";
constexpr std::string_view kTapeVerb = "/tape";

HttpAnswer figures(const VisitsFound& found) {
  return fresh_answer(visits_json(found));
}

HttpAnswer spreadsheet(const VisitsFound& found) {
  HttpAnswer answer = fresh_answer(visits::visits_csv(found.records), "text/csv; charset=utf-8; header=present");
  answer.headers.emplace_back("Content-Disposition", R"(attachment; filename="visits.csv")");
  return answer;
}

/// Of "/api/visits/k7m2-9qxd-4tz0/remarks": the number, where the path ends so.
std::optional<std::string> visit_in(const std::string& path, std::string_view verb) {
  const std::size_t head = kVisitsPath.size() + 1;
  if (!path.starts_with("/api/visits/") || !path.ends_with(verb) || path.size() < head + verb.size())
    return std::nullopt;
  return path.substr(head, path.size() - head - verb.size());
}

HttpAnswer no_playback() {
  return refusal(404, "this visit is not being played back", "begin it: POST /api/visits/NUMBER/playback");
}

HttpAnswer playback_answer(const Playback& playback) {
  constexpr std::array<const char*, 3> kWords{"preparing", "ready", "failed"};
  return fresh_answer(playback_json(playback.visit(), kWords[static_cast<std::size_t>(playback.state())],
                                    playback.share(), playback.trouble()));
}

HttpAnswer tape_answer(const Playback& playback) {
  if (!playback.tape()) return refusal(409, "the visit's playback is not ready", "ask for its state until it is");
  HttpAnswer answer;
  answer.content_type = "application/octet-stream";
  answer.body = playback.tape();
  answer.size = answer.body->size();
  answer.headers.emplace_back("Cache-Control", "no-store");
  return answer;
}

void begin_playback(GatewaySite& site, const std::string& number, const Site::Done& done) {
  if (site.options().scenarios.empty())
    return done(refusal(404, "this gateway was started without exhibits", "start it with --scenarios FOLDER"));
  site.visits().find(number, [&site, done](const Expected<visits::VisitRecord>& visit) {
    if (!visit) return done(refusal(visit.error()));
    // The scenario's name becomes a path.
    if (auto named = proto::check_name(visit->scenario, "scenario"); !named) return done(refusal(named.error()));
    if (visit->ending == visits::VisitEnding::running)
      return done(refusal(409, "this visit is not over yet", "play it back when it is"));
    const auto playback = site.playbacks().begin(*visit, site.options(), site.backstage(), time_now());
    if (!playback) return done(refusal(503, "two visits are being prepared already", "try again in a minute"));
    done(playback_answer(*playback));
  });
}

}  // namespace

bool answer_visits_get(GatewaySite& site, const HttpRequest& request, const Site::Done& done) {
  const auto state = visit_in(request.path, kPlaybackVerb), tape = visit_in(request.path, kTapeVerb);
  if (state || tape) {
    const auto playback = site.playbacks().find(state ? *state : *tape, time_now());
    return done(!playback ? no_playback() : state ? playback_answer(*playback) : tape_answer(*playback)), true;
  }
  const bool as_csv = request.path == kSpreadsheetPath;
  if (!as_csv && request.path != kVisitsPath) return false;
  const auto query = parse_visits_query(request.query);
  if (!query) return done(refusal(query.error())), true;
  site.visits().read(*query, as_csv ? spreadsheet : figures, done);
  return true;
}

bool answer_visits_post(GatewaySite& site, const Session& session, const HttpRequest& request, const Site::Done& done) {
  const auto remarked = visit_in(request.path, kRemarksVerb), played = visit_in(request.path, kPlaybackVerb);
  if (!remarked && !played) return false;
  if (session.role == Role::visitor)
    return done(refusal(403, "this is for the role author or operator", "sign in as somebody who has it")), true;
  const auto remark = remarked ? parse_remark(request.body, session.user) : Expected<visits::RecordedRemark>();
  if (!remark) return done(refusal(remark.error())), true;
  // The log keeps no words: a visit that is forgotten would stay in it.
  if (!site.note(session, request, request.path, ""))
    return done(refusal(500, "the audit log cannot be written, so nothing was done", "see the gateway's log")), true;
  if (played) return begin_playback(site, *played, done), true;
  site.visits().remark(*remarked, *remark, done);
  return true;
}

}  // namespace mechane::gateway
