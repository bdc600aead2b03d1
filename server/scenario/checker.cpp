#include "server/scenario/checker.hpp"

#include <algorithm>
#include <map>
#include <ostream>

#include <fmt/format.h>

#include "server/scenario/mesh_finder.hpp"

namespace mechane::scenario {
namespace {

std::string count(std::size_t number, std::string_view word) {
  return fmt::format("{} {}{}", number, word, number == 1 ? "" : "s");
}

namespace fs = std::filesystem;

std::vector<x3d::Problem> sorted(const x3d::Problems& problems) {
  std::vector<x3d::Problem> all = problems.all();
  std::stable_sort(all.begin(), all.end(),
                   [](const x3d::Problem& a, const x3d::Problem& b) { return a.line < b.line; });
  return all;
}

struct Checked {
  std::vector<x3d::Problem> problems;
  std::string id;            ///< empty where the file could not be compiled
  std::size_t left_out = 0;  ///< nodes that are not used
};

Checked check_one(const fs::path& file) {
  x3d::Problems problems(file.string());
  MeshFinder finder;
  const auto world = read_scenario(file, finder, problems);
  return {sorted(problems), world ? world->id : std::string(), problems.left_out()};
}

/// For a folder in place of a scenario: the remedy names the scenarios in it.
x3d::Problem about_folder(const fs::path& folder) {
  for (const char* depth : {"", "*"}) {
    std::error_code code;
    fs::recursive_directory_iterator at(folder, code);
    for (const fs::recursive_directory_iterator end; !code && at != end; at.increment(code)) {
      if (at.depth() >= 1) at.disable_recursion_pending();
      if (at.depth() == (*depth == '\0' ? 0 : 1) && at->path().extension() == ".x3d") {
        return {x3d::Severity::error,
                ErrorCode::invalid_value,
                folder.string(),
                0,
                "",
                "this is a folder",
                fmt::format("write: mechane check {}", (folder / depth / "*.x3d").lexically_normal().string())};
      }
    }
  }
  return {
      x3d::Severity::error,      ErrorCode::not_found, folder.string(), 0, "", "this folder holds no scenario (.x3d)",
      "name the scenario's file"};
}

/// One server cannot have two scenarios with the same id. `ids` holds those of the files checked so far, each with its first file.
void check_ids(const std::string& file, Checked& checked, std::map<std::string, std::string>& ids) {
  if (checked.id.empty()) return;
  const auto [it, first] = ids.emplace(checked.id, file);
  std::error_code code;
  if (first || fs::equivalent(it->second, file, code)) return;
  checked.problems.push_back({x3d::Severity::error, ErrorCode::duplicate, file, 0, "",
                              fmt::format("its id '{}' is also the id of {}", checked.id, it->second),
                              "give it another id: a server cannot have two scenarios with the same id"});
}

}  // namespace

std::vector<x3d::Problem> check(const fs::path& file) {
  return check_one(file).problems;
}

std::vector<x3d::Problem> check_text(std::string_view text, const fs::path& file, ObjectLoader& loader) {
  x3d::Problems problems(file.string());
  if (const auto document = x3d::read_document(text, file, problems))
    static_cast<void>(compile(*document, loader, problems));
  return sorted(problems);
}

int run_check(std::span<const std::string> files, std::ostream& out, CheckFormat format) {
  if (files.empty()) {
    out << "mechane check: no file is given; write: mechane check scenarios/NAME/NAME.x3d\n";
    return 2;
  }
  std::vector<x3d::Problem> all;
  std::map<std::string, std::string> ids;
  std::size_t left_out = 0;
  for (const std::string& file : files) {
    std::error_code code;
    if (fs::is_directory(file, code)) {
      all.push_back(about_folder(file));
      continue;
    }
    Checked checked = check_one(file);
    check_ids(file, checked, ids);
    left_out += checked.left_out;
    all.insert(all.end(), checked.problems.begin(), checked.problems.end());
  }
  const auto of = [&](x3d::Severity severity) {
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [&](const x3d::Problem& p) { return p.severity == severity; }));
  };
  const std::size_t errors = of(x3d::Severity::error);
  if (format == CheckFormat::json) {
    out << x3d::to_json(all) << "\n";
  } else {
    for (const x3d::Problem& problem : all)
      out << to_string(problem) << "\n";
    const std::size_t notes = of(x3d::Severity::note);
    out << fmt::format("{}: {}, {}{}{}\n", count(files.size(), "file"), count(errors, "error"),
                       count(of(x3d::Severity::warning), "warning"), notes == 0 ? "" : ", " + count(notes, "note"),
                       left_out == 0 ? "" : ", " + count(left_out, "node") + " not used");
  }
  return errors > 0 ? 1 : 0;
}

}  // namespace mechane::scenario
