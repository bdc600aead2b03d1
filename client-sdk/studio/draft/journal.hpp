// The file of a draft's steps, history.jsonl: one JSON object a line, only ever appended to, each on the disk before its edit is answered.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client-sdk/studio/draft/history.hpp"
#include "server/base/error.hpp"

namespace mechane::studio {

/// A move as the file has it: with the revision that it led to, and the hash of the text after it.
struct JournalLine {
  std::int64_t revision = 0;
  Move move;
  std::string text_hash;
};

struct JournalContent {
  std::string from;           ///< what the draft began as: "exhibit:odometer"
  std::int64_t revision = 0;  ///< before the first line
  std::string text_hash;      ///< of the text then
  std::vector<JournalLine> lines;
  std::uintmax_t whole_bytes = 0;  ///< up to the end of the last whole line
  bool cut = false;                ///< a line without an end follows: it was being written, and never answered
};

/// Reads the file's text. Errors: damaged, with the line.
[[nodiscard]] Expected<JournalContent> parse_journal(std::string_view text);

/// Appends to the file. One thread, which may wait for the disk.
class Journal {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 20U;  ///< then it is written anew

  explicit Journal(std::filesystem::path file, std::string from) : file_(std::move(file)), from_(std::move(from)) {}

  /// Errors: not_found; io_failure; damaged. A cut last line is removed from the file.
  [[nodiscard]] Expected<JournalContent> read();
  /// Writes the file anew: what can be undone and done again. Errors: io_failure, with the file as it was before.
  [[nodiscard]] Expected<void> write_all(const History& history);
  /// One line, flushed to the disk. Errors: io_failure; the file is as it was before.
  [[nodiscard]] Expected<void> append(const JournalLine& line);
  /// Takes the last appended line back, whose edit failed later.
  void take_back();
  /// It must be written anew before anything is appended: it has grown too long, or a line could not be taken back.
  [[nodiscard]] bool is_due() const { return broken_ || bytes_ > kMostBytes; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::string& from() const { return from_; }

 private:
  void cut_to(std::uintmax_t bytes);

  std::filesystem::path file_;
  std::string from_;
  std::uintmax_t bytes_ = 0;
  std::uintmax_t before_last_ = 0;
  bool broken_ = false;
};

/// content::content_hash() of a text.
[[nodiscard]] std::string hash_of(std::string_view text);

}  // namespace mechane::studio
