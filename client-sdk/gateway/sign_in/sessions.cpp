#include "client-sdk/gateway/sign_in/sessions.hpp"

#include <algorithm>
#include <string_view>

#include "client-sdk/gateway/http/request_path.hpp"
#include "client-sdk/gateway/sign_in/secrets.hpp"

namespace mechane::gateway {
namespace {

constexpr std::string_view kCookie = "mechane_session";
constexpr int kFreeTries = 5;
constexpr Duration kFirstWait = std::chrono::seconds(1);
constexpr Duration kLongestWait = std::chrono::minutes(5);
constexpr Duration kForgotten = std::chrono::hours(1);
constexpr std::size_t kMostGuessers = 10000;

bool is_over(const Session& session, TimePoint now) {
  if (session.role == Role::visitor) return now - session.used > Sessions::kVisitorIdle;
  return now - session.used > Sessions::kIdle || now - session.began > Sessions::kLongest;
}

}  // namespace

std::string Sessions::begin(const std::string& user, Role role, TimePoint now) {
  std::erase_if(sessions_, [now](const auto& entry) { return is_over(entry.second, now); });
  if (sessions_.size() >= kMost)
    sessions_.erase(std::ranges::min_element(sessions_, {}, [](const auto& entry) { return entry.second.used; }));
  std::string cookie = random_secret(32);
  sessions_[cookie] = {user, role, random_secret(24), now, now};
  return cookie;
}

const Session* Sessions::find(const std::string& cookie, TimePoint now) {
  const auto found = sessions_.find(cookie);
  if (found == sessions_.end()) return nullptr;
  if (is_over(found->second, now)) {
    sessions_.erase(found);
    return nullptr;
  }
  found->second.used = now;
  return &found->second;
}

void Sessions::end_of(const std::string& user) {
  std::erase_if(sessions_, [&](const auto& entry) { return entry.second.user == user; });
}

std::string session_cookie(const std::string& header) {
  std::string_view rest = header;
  while (!rest.empty()) {
    const std::string_view one = next_part(rest, ';');
    if (one.size() > kCookie.size() && one.starts_with(kCookie) && one[kCookie.size()] == '=')
      return std::string(one.substr(kCookie.size() + 1));
  }
  return {};
}

std::string set_session_cookie(const std::string& value, bool secure) {
  std::string text = std::string(kCookie) + "=" + value + "; HttpOnly; SameSite=Strict; Path=/";
  // A visitor's lasts longest; the gateway itself ends the others.
  const auto longest = std::chrono::duration_cast<std::chrono::seconds>(Sessions::kVisitorIdle).count();
  text += "; Max-Age=" + std::to_string(value.empty() ? 0 : longest);
  if (secure) text += "; Secure";
  return text;
}

std::optional<Duration> SignInGuard::wait_of(const std::string& name, TimePoint now) const {
  const auto found = failures_.find(name);
  if (found == failures_.end() || found->second.count < kFreeTries) return std::nullopt;
  const int doublings = std::min(found->second.count - kFreeTries, 16);
  const Duration wait = std::min<Duration>(kFirstWait * (1 << doublings), kLongestWait);
  const Duration left = found->second.last + wait - now;
  if (left <= Duration{0}) return std::nullopt;
  return left;
}

void SignInGuard::failed(const std::string& name, TimePoint now) {
  if (failures_.size() >= kMostGuessers)
    std::erase_if(failures_, [now](const auto& entry) { return now - entry.second.last > kLongestWait; });
  Failures& failures = failures_[name];
  if (now - failures.last > kForgotten) failures.count = 0;
  ++failures.count;
  failures.last = now;
}

}  // namespace mechane::gateway
