#include "client-sdk/studio/draft/draft.hpp"

#include <chrono>
#include <span>

#include <fmt/format.h>

#include "server/base/whole_file.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;

fs::path journal_file(const fs::path& folder) {
  return folder / "history.jsonl";
}

/// A name beside the history that is not taken.
fs::path set_aside_name(const fs::path& folder) {
  std::error_code unknown;
  for (int number = 1;; ++number) {
    const fs::path file = folder / fmt::format("history.damaged-{}.jsonl", number);
    if (!fs::exists(file, unknown)) return file;
  }
}

std::int64_t last_change_s(const fs::path& file) {
  std::error_code unknown;
  const auto changed = fs::last_write_time(file, unknown);
  if (unknown) return 0;
  const auto system = std::chrono::file_clock::to_sys(changed);
  return std::chrono::duration_cast<std::chrono::seconds>(system.time_since_epoch()).count();
}

}  // namespace

Expected<Draft> Draft::make(const fs::path& folder, std::string text, const std::string& from, const Author& author) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return tl::unexpected(file_error("cannot be made", folder, error.value()));
  Draft draft(folder, History(std::move(text)), Journal(journal_file(folder), from));
  draft.changed_ = author;
  // The text comes last: a folder without it is no draft yet.
  if (auto written = draft.journal_.write_all(draft.history_); !written) return tl::unexpected(written.error());
  if (auto written = draft.write_text(draft.text()); !written) return tl::unexpected(written.error());
  return draft;
}

Expected<Draft> Draft::open(const fs::path& folder) {
  const fs::path file = folder / "draft.x3d";
  const auto bytes = read_whole(file, kMostBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  std::string text(as_text(*bytes));
  Draft draft(folder, History(std::move(text)), Journal(journal_file(folder), ""));
  draft.changed_.time_s = last_change_s(file);
  const auto content = draft.journal_.read();
  auto taken = content ? draft.take_up(*content) : tl::unexpected(content.error());
  if (taken) return draft;
  if (taken.error().code == ErrorCode::io_failure) return tl::unexpected(taken.error());
  if (auto begun = draft.begin_anew(taken.error()); !begun) return tl::unexpected(begun.error());
  return draft;
}

/// The steps lead to the text, or all but the last one do: then the program was ended between writing the step and the text, and what
/// was left is done now.
Expected<void> Draft::take_up(const JournalContent& content) {
  const std::string here = hash_of(text());
  const auto misfit = [] {
    return fail(ErrorCode::damaged, "the draft's text is not the one that its history leads to", "history.jsonl",
                "the draft itself is kept; what was done before cannot be undone any more");
  };
  History history(text(), content.revision);
  for (std::size_t i = 0; i < content.lines.size(); ++i) {
    const JournalLine& line = content.lines[i];
    const bool last = i + 1 == content.lines.size();
    if (last && line.text_hash != here) {
      auto text = history.text_after(line.move);
      if (!text || hash_of(*text) != line.text_hash) return misfit();
      if (auto written = write_text(*text); !written) return written;
      history.make(line.move, std::move(*text));
    } else if (!history.replay(line.move)) {
      return misfit();
    }
    changed_ = {line.move.step.by, line.move.step.time_s};
  }
  if (content.lines.empty() && content.text_hash != here) return misfit();
  history_ = std::move(history);
  if (content.cut) notice_ = "the last line of the history was not whole, and was left out: the text is complete";
  return {};
}

Expected<void> Draft::begin_anew(const Error& why) {
  std::error_code error;
  const fs::path aside = set_aside_name(folder_);
  const bool there = fs::exists(journal_.file(), error);
  if (there) fs::rename(journal_.file(), aside, error);
  if (error) return tl::unexpected(file_error("cannot be set aside", journal_.file(), error.value()));
  notice_ = fmt::format("{}; {}{}", why.what, "the text is as it was, and what was done before cannot be undone",
                        there ? "; the damaged file is kept as " + aside.filename().string() : "");
  // A page that still has an older revision must not take the text for one that it knows.
  history_ = History(text(), changed_.time_s);
  return journal_.write_all(history_);
}

Expected<void> Draft::write_text(const std::string& text) const {
  return write_whole(file(), std::as_bytes(std::span(text)), WholeFile::durable);
}

Expected<void> Draft::step(const std::string& title, const std::string& text, const Author& author) {
  if (text == history_.text()) return {};
  return make({Move::Kind::step, {title, author.name, author.time_s, delta_between(history_.text(), text)}});
}

Expected<void> Draft::undo(const Author& author) {
  if (history_.undoable().empty()) return fail(ErrorCode::conflict, "there is nothing to undo", "", "go on");
  return make({Move::Kind::undo, {"", author.name, author.time_s, {}}});
}

Expected<void> Draft::redo(const Author& author) {
  if (history_.redoable().empty()) return fail(ErrorCode::conflict, "there is nothing to redo", "", "go on");
  return make({Move::Kind::redo, {"", author.name, author.time_s, {}}});
}

Expected<void> Draft::make(Move move) {
  auto text = history_.text_after(move);
  if (!text)
    return fail(ErrorCode::damaged, "this step does not fit the draft's text", folder_.string(), "open the draft anew");
  if (journal_.is_due())
    if (auto written = journal_.write_all(history_); !written) return written;
  const Author author{move.step.by, move.step.time_s};
  if (auto written = journal_.append({revision() + 1, move, hash_of(*text)}); !written) return written;
  if (auto written = write_text(*text); !written) {
    journal_.take_back();
    return written;
  }
  history_.make(std::move(move), std::move(*text));
  changed_ = author;
  return {};
}

}  // namespace mechane::studio
