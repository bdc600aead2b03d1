#include "server/x3d/problem.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "server/base/assert.hpp"
#include "server/base/suggestion.hpp"

namespace mechane::x3d {
namespace {

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

}  // namespace mechane::x3d
