#include "client-sdk/studio/draft/journal.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <span>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "server/base/assert.hpp"
#include "server/base/whole_file.hpp"
#include "server/content/content_hash.hpp"

namespace mechane::studio {
namespace {

using JournalJson = nlohmann::json;

constexpr int kJournalFormat = 1;
constexpr std::uintmax_t kMostRead = 2 * Journal::kMostBytes;
constexpr std::array<std::string_view, 3> kMoves{"step", "undo", "redo"};

std::string line_of(const JournalJson& json) {
  return json.dump(-1, ' ', false, JournalJson::error_handler_t::replace) + "\n";
}

std::string head_line(const std::string& from, std::int64_t revision, const std::string& text_hash) {
  return line_of({{"format", kJournalFormat}, {"from", from}, {"revision", revision}, {"text", text_hash}});
}

std::string text_of(const JournalLine& line) {
  const Step& step = line.move.step;
  JournalJson json{{"revision", line.revision},
                   {"do", kMoves[static_cast<std::size_t>(line.move.kind)]},
                   {"by", step.by},
                   {"time_s", step.time_s},
                   {"text", line.text_hash}};
  if (line.move.kind == Move::Kind::step)
    json.update(
        {{"title", step.title}, {"at", step.delta.at}, {"before", step.delta.before}, {"after", step.delta.after}});
  return line_of(json);
}

/// Fields of a line; after the first one that is missing or of another kind, `whole` is false.
struct JournalFields {
  const JournalJson& json;
  bool whole = true;

  std::string text(const char* name) {
    const auto found = json.find(name);
    if (found != json.end() && found->is_string()) return found->get<std::string>();
    whole = false;
    return {};
  }
  std::int64_t number(const char* name) {
    const auto found = json.find(name);
    if (found != json.end() && found->is_number_integer()) return found->get<std::int64_t>();
    whole = false;
    return 0;
  }
};

std::optional<JournalLine> read_line(const JournalJson& json) {
  JournalFields fields{json};
  JournalLine line;
  line.revision = fields.number("revision");
  line.text_hash = fields.text("text");
  line.move.step.by = fields.text("by");
  line.move.step.time_s = fields.number("time_s");
  const std::string kind = fields.text("do");
  const auto known = std::find(kMoves.begin(), kMoves.end(), kind);
  if (known == kMoves.end()) return std::nullopt;
  line.move.kind = static_cast<Move::Kind>(known - kMoves.begin());
  if (line.move.kind == Move::Kind::step) {
    line.move.step.title = fields.text("title");
    const std::int64_t at = fields.number("at");
    line.move.step.delta = {static_cast<std::size_t>(std::max<std::int64_t>(at, 0)), fields.text("before"),
                            fields.text("after")};
    if (at < 0) return std::nullopt;
  }
  if (!fields.whole) return std::nullopt;
  return line;
}

tl::unexpected<Error> damaged_line(int number) {
  return fail(ErrorCode::damaged, "the draft's history is damaged", Place("history.jsonl", number),
              "the draft itself is kept; what was done before cannot be undone any more");
}

bool read_head(const JournalJson& json, JournalContent& out) {
  JournalFields fields{json};
  out.from = fields.text("from");
  out.revision = fields.number("revision");
  out.text_hash = fields.text("text");
  return fields.number("format") == kJournalFormat && fields.whole && out.revision >= 0;
}

}  // namespace

std::string hash_of(std::string_view text) {
  return content::content_hash(std::as_bytes(std::span(text)));
}

Expected<JournalContent> parse_journal(std::string_view text) {
  JournalContent out;
  int number = 0;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', out.whole_bytes)) {
    ++number;
    const JournalJson json = JournalJson::parse(text.substr(out.whole_bytes, end - out.whole_bytes), nullptr, false);
    if (!json.is_object()) return damaged_line(number);
    if (number == 1) {
      if (!read_head(json, out)) return damaged_line(number);
    } else {
      auto line = read_line(json);
      const bool follows = line && line->revision == out.revision + number - 1;
      if (!follows) return damaged_line(number);
      out.lines.push_back(std::move(*line));
    }
    out.whole_bytes = end + 1;
  }
  if (number == 0) return damaged_line(1);
  out.cut = out.whole_bytes < text.size();
  return out;
}

Expected<JournalContent> Journal::read() {
  const auto bytes = read_whole(file_, kMostRead);
  if (!bytes) return tl::unexpected(bytes.error());
  auto content = parse_journal(as_text(*bytes));
  if (!content) return content;
  bytes_ = before_last_ = content->whole_bytes;
  if (content->cut) cut_to(content->whole_bytes);
  from_ = content->from;
  return content;
}

Expected<void> Journal::write_all(const History& history) {
  std::string text = history.text();
  for (auto step = history.undoable().rbegin(); step != history.undoable().rend(); ++step)
    text = applied(text, step->delta.reversed()).value_or(text);
  std::vector<Move> moves;
  for (const Step& step : history.undoable())
    moves.push_back({Move::Kind::step, step});
  for (auto step = history.redoable().rbegin(); step != history.redoable().rend(); ++step)
    moves.push_back({Move::Kind::step, *step});
  for (const Step& step : history.redoable())
    moves.push_back({Move::Kind::undo, {"", step.by, step.time_s, {}}});
  // What is undone was done before, so that a history has made at least as many moves.
  History again(std::move(text), history.revision() - static_cast<std::int64_t>(moves.size()));
  std::string out = head_line(from_, again.revision(), hash_of(again.text()));
  for (Move& move : moves) {
    auto next = again.text_after(move);
    MECHANE_ASSERT(next);
    out += text_of({again.revision() + 1, move, hash_of(*next)});
    again.make(std::move(move), std::move(*next));
  }
  auto written = write_whole(file_, std::as_bytes(std::span(out)), WholeFile::durable);
  if (!written) return written;
  bytes_ = before_last_ = out.size();
  broken_ = false;
  return {};
}

Expected<void> Journal::append(const JournalLine& line) {
  const std::string text = text_of(line);
  const int fd = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  int error = fd < 0 ? errno : mechane::write_all(fd, std::as_bytes(std::span(text)));
  if (error == 0 && ::fsync(fd) != 0) error = errno;
  if (fd >= 0) ::close(fd);
  if (error != 0) {
    if (fd >= 0) cut_to(bytes_);
    return tl::unexpected(file_error("the step cannot be written, so nothing was changed", file_, error));
  }
  before_last_ = bytes_;
  bytes_ += text.size();
  return {};
}

void Journal::take_back() {
  cut_to(before_last_);
}

void Journal::cut_to(std::uintmax_t bytes) {
  if (::truncate(file_.c_str(), static_cast<off_t>(bytes)) != 0) broken_ = true;
  bytes_ = before_last_ = bytes;
}

}  // namespace mechane::studio
