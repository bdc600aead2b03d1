// What is wrong in a scenario, in words that let its author mend it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::x3d {

enum class Severity { note, warning, error };

/// One fault. With an error the scenario cannot run; a warning is of something that is likely not meant; a note is of something valid
/// that Mechane ignores.
struct Problem {
  Severity severity = Severity::error;
  ErrorCode code = ErrorCode::invalid_value;
  std::string file;    ///< as the caller named it
  int line = 0;        ///< from 1; 0 where no line can be named
  std::string node;    ///< "RigidBody INNER", "step turn"; empty where it is about the whole file
  std::string what;    ///< what is wrong
  std::string remedy;  ///< what to write instead
};

/// Collects the problems of one file. One thread.
class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}

  void error(ErrorCode code, int line, std::string node, std::string what, std::string remedy);
  void warning(ErrorCode code, int line, std::string node, std::string what, std::string remedy);
  /// For a word that is not known in its place, with ErrorCode::unknown_name: an error that names the nearest candidate, because that
  /// was likely meant; a warning where no candidate is near.
  void unknown(int line, std::string node, std::string what, const std::string& word,
               std::span<const std::string> candidates);
  /// For something valid that Mechane ignores: ErrorCode::not_supported.
  void note(int line, std::string node, std::string what, std::string remedy);

  /// Counts elements that Mechane makes nothing of, whether there is a note for each or not.
  void leave_out(std::size_t nodes) { left_out_ += nodes; }

  [[nodiscard]] std::size_t left_out() const { return left_out_; }
  [[nodiscard]] bool has_errors() const { return errors_ > 0; }
  /// True once no more are kept, so that a search for more may stop: a broken file can have one fault a line.
  [[nodiscard]] bool full() const { return problems_.size() >= kMost; }
  /// The first error, as the Error of an Expected, with a count of the others. There must be an error.
  [[nodiscard]] Error first_error() const;
  [[nodiscard]] const std::vector<Problem>& all() const { return problems_; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  void add(Severity severity, ErrorCode code, int line, std::string node, std::string what, std::string remedy);

  static constexpr std::size_t kMost = 200;

  std::string file_;
  std::vector<Problem> problems_;
  std::size_t errors_ = 0;
  std::size_t left_out_ = 0;
};

/// "note", "warning" or "error".
[[nodiscard]] std::string_view word_of(Severity severity);

/// One line for a person: "file:line: error: node: what; remedy".
[[nodiscard]] std::string to_string(const Problem& problem);

/// The same as JSON, an array of objects with the fields of Problem, for editors and build servers.
[[nodiscard]] std::string to_json(std::span<const Problem> problems);

}  // namespace mechane::x3d
