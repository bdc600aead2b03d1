// What the tests of the scenario room share: the shipped file as text, edits of it, and a loader that needs no mesh files.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "server/scenario/compiler.hpp"
#include "tests/support/source_files.hpp"

namespace mechane::scenario {

using test::shared_folder;
using test::shipped_file;
using test::source_folder;
using test::text_of;

/// The line on which `needle` first occurs.
inline int line_of(const std::string& text, const std::string& needle) {
  const std::size_t at = text.find(needle);
  EXPECT_NE(at, std::string::npos) << needle;
  return static_cast<int>(
             std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size())), '\n')) +
         1;
}

inline void replace_first(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the shipped file no longer holds: " << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
}

using Edits = std::vector<std::pair<std::string, std::string>>;

/// The shipped file with each first `from` replaced.
inline std::string with_edits(const Edits& edits) {
  std::string text = text_of(shipped_file());
  for (const auto& [from, to] : edits)
    replace_first(text, from, to);
  return text;
}

inline std::string edited(const std::string& from, const std::string& to) {
  return with_edits({{from, to}});
}

/// Makes empty objects and remembers what was asked of it.
class FakeLoader final : public ObjectLoader {
 public:
  Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path& file, const std::string& node,
                                                          const geometry::SolidChoice& solid) override {
    loaded.push_back(file.filename().string() + "#" + node);
    solids.push_back(solid);
    if (node == missing_node)
      return fail(ErrorCode::unknown_name, "the node does not exist", file.string(), "name one of: OUTER");
    return std::make_shared<collision::Object>();
  }
  Expected<std::string> content_hash(const std::filesystem::path& file) override {
    if (no_files) return fail(ErrorCode::not_found, "no such file", file.string(), "check the path");
    return hash;
  }

  Expected<std::optional<Solid>> solid(const std::filesystem::path&, const std::string&) override { return shape; }
  bool has_meshes_at_hand() const override { return true; }

  std::vector<std::string> loaded;
  std::vector<geometry::SolidChoice> solids;  // of what was loaded
  std::optional<Solid> shape;                 ///< of every body
  std::string hash = std::string(32, 'a');
  std::string missing_node;
  bool no_files = false;
};

/// Any line of the file; not 0, which is no line.
inline constexpr int kAnyLine = -1;

/// Whether a problem has this code and line, and holds in its text a name or number that tells it from others of its code.
inline bool is_problem(const x3d::Problem& problem, ErrorCode code, int line, const std::string& name) {
  return problem.code == code && (line == kAnyLine ? problem.line > 0 : problem.line == line) &&
         to_string(problem).find(name) != std::string::npos;
}

/// The first such problem, which must have a remedy; a test failure where none is such.
inline x3d::Problem find_problem(const std::vector<x3d::Problem>& problems, ErrorCode code, int line,
                                 const std::string& name = {}) {
  const auto found =
      std::ranges::find_if(problems, [&](const x3d::Problem& p) { return is_problem(p, code, line, name); });
  if (found != problems.end()) {
    EXPECT_FALSE(found->remedy.empty()) << to_string(*found);
    return *found;
  }
  std::string all;
  for (const x3d::Problem& p : problems)
    all += std::string(name_of(p.code)) + " " + to_string(p) + "\n";
  ADD_FAILURE() << "no problem is " << name_of(code) << " in line " << line << " with '" << name << "', but:\n" << all;
  return {};
}

struct Outcome {
  Expected<state::WorldDescription> world;
  std::vector<x3d::Problem> problems;

  [[nodiscard]] x3d::Problem find(ErrorCode code, int line, const std::string& name = {}) const {
    return find_problem(problems, code, line, name);
  }
};

inline Outcome compile_text(const std::string& text, FakeLoader& loader) {
  x3d::Problems problems("test.x3d");
  const auto document = x3d::read_document(text, shipped_file(), problems);
  if (!document) return {tl::unexpected(document.error()), problems.all()};
  auto world = compile(*document, loader, problems);
  return {std::move(world), problems.all()};
}

inline Outcome compile_text(const std::string& text) {
  FakeLoader loader;
  return compile_text(text, loader);
}

/// The file has this problem alone, a warning on the line that holds `at`.
inline void expect_one_warning(const std::string& text, const std::string& at, ErrorCode code, const std::string& name,
                               FakeLoader loader = {}) {
  const Outcome outcome = compile_text(text, loader);
  EXPECT_TRUE(outcome.world) << outcome.world.error().to_string();
  ASSERT_EQ(outcome.problems.size(), 1u) << (outcome.problems.empty() ? name : to_string(outcome.problems.back()));
  const x3d::Problem& problem = outcome.problems.front();
  EXPECT_EQ(problem.severity, x3d::Severity::warning);
  EXPECT_TRUE(is_problem(problem, code, line_of(text, at), name)) << name_of(problem.code) << " " << to_string(problem);
  EXPECT_FALSE(problem.node.empty());
  EXPECT_FALSE(problem.remedy.empty());
}

inline void expect_nothing(const std::string& text, FakeLoader loader = {}) {
  const Outcome outcome = compile_text(text, loader);
  EXPECT_TRUE(outcome.problems.empty()) << to_string(outcome.problems.front());
}

}  // namespace mechane::scenario
