// A text with the steps that led to it: undo and redo give back the very bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client-sdk/studio/draft/text_delta.hpp"

namespace mechane::studio {

struct Step {
  std::string title;        ///< for people: what it did
  std::string by;           ///< the author's name; empty: nobody signed in
  std::int64_t time_s = 0;  ///< since 1970 UTC
  TextDelta delta;
};

/// What happened to a text: a new step, or one taken back or done again.
struct Move {
  enum class Kind : std::uint8_t { step, undo, redo };
  Kind kind = Kind::step;
  Step step;  ///< of undo and redo only who and when
};

/// In memory. One thread.
class History {
 public:
  static constexpr std::size_t kMostSteps = 1000;
  static constexpr std::size_t kMostBytes = std::size_t{16} << 20U;  ///< of the deltas; the oldest go first

  explicit History(std::string text, std::int64_t revision = 0) : text_(std::move(text)), revision_(revision) {}

  [[nodiscard]] const std::string& text() const { return text_; }
  /// Grows by one with each move.
  [[nodiscard]] std::int64_t revision() const { return revision_; }
  [[nodiscard]] const std::vector<Step>& undoable() const { return undo_; }  ///< the newest last
  [[nodiscard]] const std::vector<Step>& redoable() const { return redo_; }  ///< the next one last

  /// The text after a move; none where there is nothing to undo or redo, or the step does not fit the text.
  [[nodiscard]] std::optional<std::string> text_after(const Move& move) const;
  /// Makes a move, whose text_after() is `text`.
  void make(Move move, std::string text);
  /// The same without a text: for who knows the last one only.
  [[nodiscard]] bool replay(Move move);
  void set_text(std::string text) { text_ = std::move(text); }

 private:
  void shift(Move move);
  void forget_oldest();

  std::string text_;
  std::int64_t revision_;
  std::vector<Step> undo_;
  std::vector<Step> redo_;
};

}  // namespace mechane::studio
