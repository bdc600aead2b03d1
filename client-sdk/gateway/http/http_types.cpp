#include "client-sdk/gateway/http/http_types.hpp"

#include <nlohmann/json.hpp>

namespace mechane::gateway {

const std::string& HttpRequest::header(const std::string& name) const {
  static const std::string kNone;
  const auto found = headers.find(name);
  return found == headers.end() ? kNone : found->second;
}

std::string HttpRequest::query_value(const std::string& name) const {
  const auto found = query.find(name);
  return found == query.end() ? std::string() : found->second;
}

HttpAnswer answer_with(std::string body, std::string content_type, unsigned status) {
  HttpAnswer answer;
  answer.status = status;
  answer.content_type = std::move(content_type);
  answer.size = body.size();
  answer.body = std::make_shared<const std::string>(std::move(body));
  return answer;
}

HttpAnswer fresh_answer(std::string body, std::string content_type, unsigned status) {
  HttpAnswer answer = answer_with(std::move(body), std::move(content_type), status);
  answer.headers.emplace_back("Cache-Control", "no-store");
  return answer;
}

HttpAnswer refusal(unsigned status, const std::string& what, const std::string& remedy) {
  const nlohmann::json text{{"error", what}, {"remedy", remedy}};
  return answer_with(text.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), "application/json", status);
}

HttpAnswer refusal(const Error& error) {
  unsigned status = 400;
  if (error.code == ErrorCode::not_found || error.code == ErrorCode::unknown_name) status = 404;
  if (error.code == ErrorCode::conflict) status = 409;
  if (error.code == ErrorCode::too_large) status = 413;
  if (error.code == ErrorCode::busy) status = 503;
  if (error.code == ErrorCode::timed_out) status = 504;
  if (error.code == ErrorCode::io_failure || error.code == ErrorCode::damaged) status = 500;
  return refusal(status, error.where.empty() ? error.what : error.where + ": " + error.what, error.remedy);
}

}  // namespace mechane::gateway
