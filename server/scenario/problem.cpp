#include "server/scenario/problem.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "server/base/assert.hpp"

namespace mechane::scenario {
namespace {

// Names longer than this are not compared: the cost grows with the product of the lengths, and a file may hold many.
constexpr std::size_t kLongestName = 64;
constexpr std::size_t kMostCompared = 1000;

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Letters to add, drop, change, or swap with their neighbour (the optimal string alignment distance), compared without case.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  std::vector<std::size_t> above = row;
  std::vector<std::size_t> above_that = row;
  const auto same = [&](std::size_t i, std::size_t j) { return lower(a[i - 1]) == lower(b[j - 1]); };
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(above_that, above);
    std::swap(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same(i, j) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i, j - 1) && same(i - 1, j)) row[j] = std::min(row[j], above_that[j - 2] + 1);
    }
  }
  return row.back();
}

std::string place(const Problem& problem) {
  std::string text = problem.file;
  if (problem.line > 0) text += fmt::format(":{}", problem.line);
  return text;
}

}  // namespace

void Problems::add(Severity severity, int line, std::string node, std::string what, std::string remedy) {
  // An error is never lost: the first one may come after as many warnings.
  if (full() && !(severity == Severity::error && errors_ == 0)) return;
  problems_.push_back({severity, file_, line, std::move(node), std::move(what), std::move(remedy)});
}

void Problems::error(int line, std::string node, std::string what, std::string remedy) {
  add(Severity::error, line, std::move(node), std::move(what), std::move(remedy));
  ++errors_;
}

void Problems::warning(int line, std::string node, std::string what, std::string remedy) {
  add(Severity::warning, line, std::move(node), std::move(what), std::move(remedy));
}

void Problems::unknown(int line, std::string node, std::string what, const std::string& word,
                       std::span<const std::string> candidates) {
  if (full() && errors_ > 0) return;
  const bool near = !nearest(word, candidates).empty();
  add(near ? Severity::error : Severity::warning, line, std::move(node), std::move(what),
      near ? suggest(word, candidates, "") : "remove it; " + suggest(word, candidates, "nothing may be written here"));
  if (near) ++errors_;
}

void Problems::note(int line, std::string node, std::string what, std::string remedy) {
  add(Severity::note, line, std::move(node), std::move(what), std::move(remedy));
}

Error Problems::first_error() const {
  const auto first =
      std::find_if(problems_.begin(), problems_.end(), [](const Problem& p) { return p.severity == Severity::error; });
  MECHANE_ASSERT(first != problems_.end());
  std::string where = place(*first);
  if (!first->node.empty()) where += ", " + first->node;
  std::string remedy = first->remedy;
  if (errors_ > 1) remedy += fmt::format(" (and {} more: run `mechane check {}`)", errors_ - 1, file_);
  return {first->what, where, remedy};
}

std::string_view word_of(Severity severity) {
  if (severity == Severity::note) return "note";
  return severity == Severity::error ? "error" : "warning";
}

std::string to_string(const Problem& problem) {
  std::string text = fmt::format("{}: {}: ", place(problem), word_of(problem.severity));
  if (!problem.node.empty()) text += problem.node + ": ";
  text += problem.what;
  if (!problem.remedy.empty()) text += "; " + problem.remedy;
  return text;
}

std::string to_json(std::span<const Problem> problems) {
  nlohmann::json list = nlohmann::json::array();
  for (const Problem& p : problems) {
    list.push_back({{"severity", word_of(p.severity)},
                    {"file", p.file},
                    {"line", p.line},
                    {"node", p.node},
                    {"what", p.what},
                    {"remedy", p.remedy}});
  }
  // File names and garbled attributes may be of any bytes: a byte that is not UTF-8 is shown as such, not thrown.
  return list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string nearest(const std::string& name, std::span<const std::string> candidates) {
  if (name.empty() || name.size() > kLongestName) return {};
  std::string best;
  std::size_t best_edits = std::max<std::size_t>(1, (name.size() + 1) / 3) + 1;
  for (const std::string& candidate : candidates.first(std::min(candidates.size(), kMostCompared))) {
    if (candidate.empty() || candidate.size() > kLongestName) continue;
    // A name that was cut short is near, however much is missing.
    const bool begins = name.size() >= 3 && candidate.starts_with(name);
    const std::size_t distance = begins ? 1 : edits(name, candidate);
    if (distance < best_edits) {
      best = candidate;
      best_edits = distance;
    }
  }
  return best;
}

std::string suggest(const std::string& name, std::span<const std::string> candidates, const std::string& if_none) {
  constexpr std::size_t kMostShown = 12;
  if (candidates.empty()) return if_none;
  const std::string near = nearest(name, candidates);
  if (!near.empty()) return fmt::format("did you mean '{}'?", near);
  const auto shown = candidates.first(std::min(candidates.size(), kMostShown));
  return fmt::format("there is: {}{}", fmt::join(shown, ", "), candidates.size() > kMostShown ? ", ..." : "");
}

}  // namespace mechane::scenario
