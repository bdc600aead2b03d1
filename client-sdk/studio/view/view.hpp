// A draft as pages and scripts see it, as JSON: COMMANDS.md has the form.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "client-sdk/studio/draft/history.hpp"
#include "server/x3d/document.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::studio {

/// What a view shows.
struct Viewed {
  std::string name;
  const History& history;
  const x3d::Document& document;  ///< of the history's text
  std::string by;                 ///< who changed it last
  std::string notice;             ///< of a history that was damaged; empty: nothing
  std::vector<x3d::Problem> problems;
  std::vector<std::string> added;  ///< DEFs that the last commands added
};

/// Any thread.
[[nodiscard]] std::string view_json(const Viewed& viewed);

/// Problems alone, a list in the form of the view.
[[nodiscard]] std::string problems_json(const x3d::Document* document, std::span<const x3d::Problem> problems);

/// How many of them are errors.
[[nodiscard]] std::size_t count_errors(std::span<const x3d::Problem> problems);

}  // namespace mechane::studio
