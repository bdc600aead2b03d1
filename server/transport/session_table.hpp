// Decides which session owns which hand. Without network or threads.
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

/// One process at a kiosk, with what it says about itself.
struct Session {
  std::uint64_t id = 0;  ///< random, never 0
  std::string kiosk;
  std::uint32_t user = 0;
  Role role = Role::watcher;
  std::string program;
  std::string host;
  std::string scenario;    ///< id of the scenario that it asks for; empty: the server's first
  bool was_there = false;  ///< `scenario` is not a request, but where the kiosk was last
  std::string join_kiosk;  ///< asks to share the world of this kiosk; empty: a world of its own
};

/// A hand came to a session, or was taken from it.
struct HandChange {
  bool granted = false;  ///< false: freed
  Session session;
};

/// The first session that asks for a hand owns it as long as it is connected. When it sends nothing for 500 ms and another session waits
/// for the hand, that one gets it, and the first goes to the end of the queue. One thread.
class SessionTable {
 public:
  static constexpr Duration kSilence = std::chrono::milliseconds(500);
  /// A session that has just got the hand may need this long until its first sample: DDS still has to match its endpoints.
  static constexpr Duration kFirstInputGrace = std::chrono::seconds(3);
  static constexpr std::size_t kMaxSessions = 512;

  /// False when the session is known already (then its requests are updated), or when the table is full.
  bool appeared(const Session& session);
  /// False when the session is not known.
  bool left(std::uint64_t session);
  /// `at`: when the last input of this session arrived.
  void heard(std::uint64_t session, TimePoint at);
  /// Decides who owns which hand at `now`. Hands that are freed come first, then hands that are granted. Call it regularly.
  [[nodiscard]] std::vector<HandChange> decide(TimePoint now);

  /// No further session is accepted until one leaves.
  [[nodiscard]] bool full() const { return sessions_.size() >= kMaxSessions; }
  /// Null when nobody owns the hand. Valid until the next change.
  [[nodiscard]] const Session* owner(const std::string& kiosk, std::uint32_t user) const;
  [[nodiscard]] const Session* find(std::uint64_t session) const;
  /// How many sessions a kiosk has, hands and watchers.
  [[nodiscard]] std::size_t sessions_at(const std::string& kiosk) const;
  [[nodiscard]] const std::vector<Session>& sessions() const { return sessions_; }  ///< in the order they appeared

 private:
  using HandKey = std::pair<std::string, std::uint32_t>;
  struct Hand {
    std::optional<Session> owner;
    TimePoint granted;
    std::optional<TimePoint> heard;
    std::vector<std::uint64_t> queue;  // sessions that wait for the hand, in the order in which they came
  };

  [[nodiscard]] static bool silent(const Hand& hand, TimePoint now);

  std::vector<Session> sessions_;
  std::map<HandKey, Hand> hands_;
  std::vector<HandChange> freed_by_leaving_;
};

}  // namespace mechane::transport
