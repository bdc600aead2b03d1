// Who owns which hand: the policy, without network or threads.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/base/clock.hpp"

namespace mechane::transport {

enum class Role { hand, watcher };

/// One process at a kiosk, as it describes itself.
struct Session {
  std::uint64_t id = 0;  ///< random, never 0
  std::string kiosk;
  std::uint32_t user = 0;
  Role role = Role::watcher;
  std::string program;
  std::string host;
  std::string scenario;    ///< request: id of the scenario; empty: the server's first
  bool was_there = false;  ///< it is not a request: the kiosk was in that scenario last
  std::string join_kiosk;  ///< request: share the world of this kiosk; empty: a world of its own
};

/// A hand came to a session, or was taken from it.
struct HandChange {
  bool granted = false;  ///< false: freed
  Session session;
};

/// The first session on a hand wins, and keeps it while it lives. A session that owns a hand but sends nothing for 500 ms loses it
/// when another one waits for it, and goes to the end of the line. One thread.
class SessionTable {
 public:
  static constexpr Duration kSilence = std::chrono::milliseconds(500);
  /// A session that just got the hand may still be finding its endpoints.
  static constexpr Duration kFirstInputGrace = std::chrono::seconds(3);
  static constexpr std::size_t kMaxSessions = 512;

  /// False when it is known already (its requests are then brought up to date), or when the table is full.
  bool appeared(const Session& session);
  /// False when it is not known.
  bool left(std::uint64_t session);
  /// `at`: when the last input of this session arrived.
  void heard(std::uint64_t session, TimePoint at);
  /// Settles who owns what at `now`; frees come before grants. Call it regularly.
  [[nodiscard]] std::vector<HandChange> decide(TimePoint now);

  /// Nobody else is taken until somebody leaves.
  [[nodiscard]] bool full() const { return sessions_.size() >= kMaxSessions; }
  /// Null when nobody owns the hand. Good until the next change.
  [[nodiscard]] const Session* owner(const std::string& kiosk, std::uint32_t user) const;
  [[nodiscard]] const Session* find(std::uint64_t session) const;
  /// How many sessions a kiosk has, of any role.
  [[nodiscard]] std::size_t sessions_at(const std::string& kiosk) const;
  [[nodiscard]] const std::vector<Session>& sessions() const { return sessions_; }  ///< in the order they appeared

 private:
  using HandKey = std::pair<std::string, std::uint32_t>;
  struct Hand {
    std::optional<Session> owner;
    TimePoint granted;
    std::optional<TimePoint> heard;
    std::vector<std::uint64_t> line;  // sessions that wait, first come first
  };

  [[nodiscard]] static bool silent(const Hand& hand, TimePoint now);

  std::vector<Session> sessions_;
  std::map<HandKey, Hand> hands_;
  std::vector<HandChange> freed_by_leaving_;
};

}  // namespace mechane::transport
