#include "server/transport/session_table.hpp"

#include <algorithm>

namespace mechane::transport {

bool SessionTable::appeared(const Session& session) {
  for (Session& known : sessions_) {
    if (known.id != session.id) continue;
    known.scenario = session.scenario;
    known.was_there = session.was_there;
    known.join_kiosk = session.join_kiosk;
    return false;
  }
  if (full()) return false;
  sessions_.push_back(session);
  if (session.role == Role::hand) hands_[{session.kiosk, session.user}].queue.push_back(session.id);
  return true;
}

bool SessionTable::left(std::uint64_t session) {
  const auto it = std::find_if(sessions_.begin(), sessions_.end(), [&](const Session& s) { return s.id == session; });
  if (it == sessions_.end()) return false;
  if (it->role == Role::hand) {
    Hand& hand = hands_[{it->kiosk, it->user}];
    std::erase(hand.queue, session);
    if (hand.owner && hand.owner->id == session) {
      freed_by_leaving_.push_back({false, *hand.owner});
      hand.owner.reset();
    }
  }
  sessions_.erase(it);
  return true;
}

void SessionTable::heard(std::uint64_t session, TimePoint at) {
  const Session* known = find(session);
  if (known == nullptr || known->role != Role::hand) return;
  Hand& hand = hands_[{known->kiosk, known->user}];
  if (hand.owner && hand.owner->id == session && (!hand.heard || at > *hand.heard)) hand.heard = at;
}

bool SessionTable::silent(const Hand& hand, TimePoint now) {
  const bool sent = hand.heard && *hand.heard >= hand.granted;
  return sent ? now - *hand.heard >= kSilence : now - hand.granted >= kFirstInputGrace;
}

std::vector<HandChange> SessionTable::decide(TimePoint now) {
  std::vector<HandChange> changes = std::exchange(freed_by_leaving_, {});
  std::vector<HandChange> grants;
  for (auto it = hands_.begin(); it != hands_.end();) {
    Hand& hand = it->second;
    if (hand.owner && !hand.queue.empty() && silent(hand, now)) {
      changes.push_back({false, *hand.owner});
      hand.queue.push_back(hand.owner->id);
      hand.owner.reset();
    }
    if (!hand.owner && !hand.queue.empty()) {
      hand.owner = *find(hand.queue.front());
      hand.queue.erase(hand.queue.begin());
      hand.granted = now;
      hand.heard.reset();
      grants.push_back({true, *hand.owner});
    }
    it = hand.owner ? std::next(it) : hands_.erase(it);
  }
  changes.insert(changes.end(), grants.begin(), grants.end());
  return changes;
}

const Session* SessionTable::owner(const std::string& kiosk, std::uint32_t user) const {
  const auto it = hands_.find({kiosk, user});
  return it == hands_.end() || !it->second.owner ? nullptr : &*it->second.owner;
}

const Session* SessionTable::find(std::uint64_t session) const {
  const auto it = std::find_if(sessions_.begin(), sessions_.end(), [&](const Session& s) { return s.id == session; });
  return it == sessions_.end() ? nullptr : &*it;
}

std::size_t SessionTable::sessions_at(const std::string& kiosk) const {
  return static_cast<std::size_t>(
      std::count_if(sessions_.begin(), sessions_.end(), [&](const Session& s) { return s.kiosk == kiosk; }));
}

}  // namespace mechane::transport
