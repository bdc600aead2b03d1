// An author's working copy of one exhibit's file. Each change is on the disk before it is answered: whoever is killed loses nothing that
// was said to be done.
#pragma once

#include <filesystem>
#include <string>

#include "client-sdk/studio/draft/history.hpp"
#include "client-sdk/studio/draft/journal.hpp"
#include "server/base/error.hpp"

namespace mechane::studio {

/// Who changes a draft, and when.
struct Author {
  std::string name;
  std::int64_t time_s = 0;  ///< since 1970 UTC
};

/// A folder with draft.x3d and history.jsonl. One thread, which may wait for the disk; one program at a time.
class Draft {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{16} << 20U;  ///< as a scenario may have

  /// Makes the folder, with a text that can be read as X3D. Errors: io_failure.
  [[nodiscard]] static Expected<Draft> make(const std::filesystem::path& folder, std::string text,
                                            const std::string& from, const Author& author);
  /// Errors: not_found; io_failure; too_large. A damaged or missing history is set aside: notice() tells it, and the text is as it was.
  [[nodiscard]] static Expected<Draft> open(const std::filesystem::path& folder);

  [[nodiscard]] const std::string& text() const { return history_.text(); }
  [[nodiscard]] std::int64_t revision() const { return history_.revision(); }
  [[nodiscard]] const History& history() const { return history_; }
  /// What it began as: "exhibit:odometer".
  [[nodiscard]] const std::string& from() const { return journal_.from(); }
  /// What was found wrong with the history when it was opened; empty: nothing.
  [[nodiscard]] const std::string& notice() const { return notice_; }
  [[nodiscard]] const Author& changed() const { return changed_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "draft.x3d"; }

  /// A step to a new text. Nothing happens where it is the same. Errors: io_failure, with nothing changed.
  [[nodiscard]] Expected<void> step(const std::string& title, const std::string& text, const Author& author);
  /// Errors: conflict (there is nothing to undo or redo); io_failure, with nothing changed.
  [[nodiscard]] Expected<void> undo(const Author& author);
  [[nodiscard]] Expected<void> redo(const Author& author);

 private:
  Draft(std::filesystem::path folder, History history, Journal journal)
      : folder_(std::move(folder)), history_(std::move(history)), journal_(std::move(journal)) {}
  [[nodiscard]] Expected<void> make(Move move);
  [[nodiscard]] Expected<void> take_up(const JournalContent& content);
  [[nodiscard]] Expected<void> begin_anew(const Error& why);
  [[nodiscard]] Expected<void> write_text(const std::string& text) const;

  std::filesystem::path folder_;
  History history_;
  Journal journal_;
  Author changed_;
  std::string notice_;
};

}  // namespace mechane::studio
