#include "client-sdk/gateway/operations/visits_query.hpp"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

#include "server/visits/remark_book.hpp"

namespace mechane::gateway {
namespace {

constexpr std::size_t kLongestOfQuery = 100;

std::string named(const std::map<std::string, std::string>& query, const char* key) {
  const auto found = query.find(key);
  return found == query.end() ? std::string() : found->second;
}

}  // namespace

bool VisitsQuery::fits(const visits::VisitRecord& record) const {
  return (exhibit.empty() || record.scenario == exhibit) && (language.empty() || record.language == language);
}

Expected<VisitsQuery> parse_visits_query(const std::map<std::string, std::string>& query) {
  VisitsQuery wanted;
  wanted.exhibit = named(query, "exhibit");
  wanted.language = named(query, "language");
  if (wanted.exhibit.size() > kLongestOfQuery || wanted.language.size() > kLongestOfQuery)
    return fail(ErrorCode::invalid_value, "this name is too long", {}, "take a name that GET /api/visits lists");
  const std::string days = named(query, "days");
  if (days.empty()) return wanted;
  const auto [end, error] = std::from_chars(days.data(), days.data() + days.size(), wanted.days);
  const bool read = error == std::errc{} && end == days.data() + days.size();
  if (!read || wanted.days < 1 || wanted.days > VisitsQuery::kMostDays)
    return fail(ErrorCode::invalid_value, "days must be a number from 1 to 3660", {}, "write days=7");
  return wanted;
}

Expected<visits::RecordedRemark> parse_remark(std::string_view body, const std::string& author) {
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  const auto wrong = [] {
    return fail(ErrorCode::invalid_value, "this is not a remark", {}, R"(send {"text":"laughed aloud","at":35.5})");
  };
  if (!json.is_object() || !json.contains("text") || !json["text"].is_string()) return wrong();
  visits::RecordedRemark remark{visits::minute_now(), json["text"], author};
  if (json.contains("at") && !json["at"].is_null()) {
    if (!json["at"].is_number()) return wrong();
    remark.at_s = json["at"].get<double>();
  }
  if (auto fits = visits::check_remark(remark, {}); !fits) return tl::unexpected(fits.error());
  return remark;
}

}  // namespace mechane::gateway
