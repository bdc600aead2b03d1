#include "server/scenario/checker.hpp"

#include <algorithm>
#include <ostream>

#include <fmt/format.h>

#include "server/scenario/file_finder.hpp"

namespace mechane::scenario {
namespace {

std::string count(std::size_t number, std::string_view word) {
  return fmt::format("{} {}{}", number, word, number == 1 ? "" : "s");
}

}  // namespace

std::vector<Problem> check(const std::filesystem::path& file) {
  Problems problems(file.string());
  FileFinder finder;
  // The result is of no interest here: what is wrong with it is in `problems`.
  static_cast<void>(read_scenario(file, finder, problems));
  std::vector<Problem> sorted = problems.all();
  std::stable_sort(sorted.begin(), sorted.end(), [](const Problem& a, const Problem& b) { return a.line < b.line; });
  return sorted;
}

int run_check(std::span<const std::string> files, std::ostream& out, CheckFormat format) {
  if (files.empty()) {
    out << "mechane check: no file is named; write: mechane check scenarios/NAME/NAME.x3d\n";
    return 2;
  }
  std::vector<Problem> all;
  for (const std::string& file : files) {
    const std::vector<Problem> found = check(file);
    all.insert(all.end(), found.begin(), found.end());
  }
  const auto is_error = [](const Problem& p) { return p.severity == Severity::error; };
  const auto errors = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_error));
  if (format == CheckFormat::json) {
    out << to_json(all) << "\n";
  } else {
    for (const Problem& problem : all)
      out << to_string(problem) << "\n";
    out << fmt::format("{}: {}, {}\n", count(files.size(), "file"), count(errors, "error"),
                       count(all.size() - errors, "warning"));
  }
  return errors > 0 ? 1 : 0;
}

}  // namespace mechane::scenario
