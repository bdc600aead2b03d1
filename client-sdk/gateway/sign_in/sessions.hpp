// Who is signed in, and from where somebody tried in vain. Kept in memory: a restart signs everybody out. All on the loop's
// thread; time is an argument.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "client-sdk/gateway/sign_in/accounts.hpp"
#include "server/base/clock.hpp"

namespace mechane::gateway {

struct Session {
  std::string user;
  Role role = Role::visitor;
  std::string csrf;  ///< what each POST must carry in X-Mechane-CSRF
  TimePoint began;
  TimePoint used;
};

class Sessions {
 public:
  static constexpr std::size_t kMost = 1000;  ///< beyond that, the one that was not used for longest ends
  /// A kiosk's tablet is signed in as a visitor; an operator's page is not left open.
  static constexpr Duration kVisitorIdle = std::chrono::hours(24 * 30);
  static constexpr Duration kIdle = std::chrono::hours(2);
  static constexpr Duration kLongest = std::chrono::hours(24);

  /// The cookie's value.
  [[nodiscard]] std::string begin(const std::string& user, Role role, TimePoint now);
  /// None: there is no such session, or it has ended. Counts as use.
  [[nodiscard]] const Session* find(const std::string& cookie, TimePoint now);
  void end(const std::string& cookie) { sessions_.erase(cookie); }
  /// Another password or role: signs the user out everywhere.
  void end_of(const std::string& user);

 private:
  std::map<std::string, Session> sessions_;
};

/// The session's cookie in a Cookie header; empty: none.
[[nodiscard]] std::string session_cookie(const std::string& header);
/// The Set-Cookie header. An empty value ends it.
[[nodiscard]] std::string set_session_cookie(const std::string& value, bool secure);

/// Slows down guessing: after five failures from one address or for one user, each waits twice as long as the one before, up to
/// five minutes.
class SignInGuard {
 public:
  /// How long `name` has to wait before the next try; none: it may try.
  [[nodiscard]] std::optional<Duration> wait_of(const std::string& name, TimePoint now) const;
  void failed(const std::string& name, TimePoint now);
  void succeeded(const std::string& name) { failures_.erase(name); }

 private:
  struct Failures {
    int count = 0;
    TimePoint last;
  };
  std::map<std::string, Failures> failures_;
};

}  // namespace mechane::gateway
