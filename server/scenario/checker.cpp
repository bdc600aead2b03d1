#include "server/scenario/checker.hpp"

#include <algorithm>
#include <ostream>

#include <fmt/format.h>

#include "server/scenario/mesh_finder.hpp"

namespace mechane::scenario {
namespace {

std::string count(std::size_t number, std::string_view word) {
  return fmt::format("{} {}{}", number, word, number == 1 ? "" : "s");
}

std::vector<Problem> sorted(const Problems& problems) {
  std::vector<Problem> all = problems.all();
  std::stable_sort(all.begin(), all.end(), [](const Problem& a, const Problem& b) { return a.line < b.line; });
  return all;
}

}  // namespace

std::vector<Problem> check(const std::filesystem::path& file) {
  Problems problems(file.string());
  MeshFinder finder;
  // The result is of no interest here: what is wrong with it is in `problems`.
  static_cast<void>(read_scenario(file, finder, problems));
  return sorted(problems);
}

std::vector<Problem> check_text(std::string_view text, const std::filesystem::path& file, ObjectLoader& loader) {
  Problems problems(file.string());
  if (const auto document = read_document(text, file, problems))
    static_cast<void>(compile(*document, loader, problems));
  return sorted(problems);
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
  const auto of = [&](Severity severity) {
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [&](const Problem& p) { return p.severity == severity; }));
  };
  const std::size_t errors = of(Severity::error);
  if (format == CheckFormat::json) {
    out << to_json(all) << "\n";
  } else {
    for (const Problem& problem : all)
      out << to_string(problem) << "\n";
    const std::size_t notes = of(Severity::note);
    out << fmt::format("{}: {}, {}{}\n", count(files.size(), "file"), count(errors, "error"),
                       count(of(Severity::warning), "warning"), notes == 0 ? "" : ", " + count(notes, "note"));
  }
  return errors > 0 ? 1 : 0;
}

}  // namespace mechane::scenario
