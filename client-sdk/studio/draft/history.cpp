#include "client-sdk/studio/draft/history.hpp"

#include "server/base/assert.hpp"

namespace mechane::studio {

std::optional<std::string> History::text_after(const Move& move) const {
  if (move.kind == Move::Kind::step) return applied(text_, move.step.delta);
  const bool back = move.kind == Move::Kind::undo;
  const std::vector<Step>& from = back ? undo_ : redo_;
  if (from.empty()) return std::nullopt;
  return applied(text_, back ? from.back().delta.reversed() : from.back().delta);
}

void History::make(Move move, std::string text) {
  shift(std::move(move));
  text_ = std::move(text);
}

bool History::replay(Move move) {
  if (move.kind == Move::Kind::undo && undo_.empty()) return false;
  if (move.kind == Move::Kind::redo && redo_.empty()) return false;
  shift(std::move(move));
  return true;
}

void History::shift(Move move) {
  ++revision_;
  if (move.kind == Move::Kind::step) {
    redo_.clear();
    undo_.push_back(std::move(move.step));
    return forget_oldest();
  }
  const bool back = move.kind == Move::Kind::undo;
  std::vector<Step>& from = back ? undo_ : redo_;
  MECHANE_ASSERT(!from.empty());
  (back ? redo_ : undo_).push_back(std::move(from.back()));
  from.pop_back();
}

void History::forget_oldest() {
  std::size_t kept = 0, bytes = 0;
  while (kept < undo_.size() && kept < kMostSteps) {
    bytes += undo_[undo_.size() - 1 - kept].delta.bytes();
    if (bytes > kMostBytes && kept > 0) break;
    ++kept;
  }
  undo_.erase(undo_.begin(), undo_.end() - static_cast<std::ptrdiff_t>(kept));
}

}  // namespace mechane::studio
