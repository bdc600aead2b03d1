#include "client-sdk/gateway/visits_api.hpp"

#include <optional>

#include "client-sdk/gateway/visits_json.hpp"
#include "server/visits/visit_csv.hpp"

namespace mechane::gateway {
namespace {

constexpr std::string_view kVisitsPath = "/api/visits";
constexpr std::string_view kSpreadsheetPath = "/api/visits.csv";
constexpr std::string_view kRemarksVerb = "/remarks";

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

}  // namespace

bool answer_visits_get(GatewaySite& site, const HttpRequest& request, const Site::Done& done) {
  const bool as_csv = request.path == kSpreadsheetPath;
  if (!as_csv && request.path != kVisitsPath) return false;
  const auto query = parse_visits_query(request.query);
  if (!query) return done(refusal(query.error())), true;
  site.visits().read(*query, as_csv ? spreadsheet : figures, done);
  return true;
}

bool answer_visits_post(GatewaySite& site, const Session& session, const HttpRequest& request, const Site::Done& done) {
  const auto number = visit_in(request.path, kRemarksVerb);
  if (!number) return false;
  if (session.role == Role::visitor)
    return done(refusal(403, "this is for the role author or operator", "sign in as somebody who has it")), true;
  const auto remark = parse_remark(request.body, session.user);
  if (!remark) return done(refusal(remark.error())), true;
  // The log keeps no words: a visit that is forgotten would stay in it.
  if (!site.note(session, request, request.path, ""))
    return done(refusal(500, "the audit log cannot be written, so nothing was done", "see the gateway's log")), true;
  site.visits().remark(*number, *remark, done);
  return true;
}

}  // namespace mechane::gateway
