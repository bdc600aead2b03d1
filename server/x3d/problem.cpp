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

void Problems::add(Severity severity, ErrorCode code, int line, std::string node, std::string what,
                   std::string remedy) {
  // The first error is always kept, even behind that many warnings.
  if (full() && !(severity == Severity::error && errors_ == 0)) return;
  problems_.push_back({severity, code, file_, line, std::move(node), std::move(what), std::move(remedy)});
}

void Problems::error(ErrorCode code, int line, std::string node, std::string what, std::string remedy) {
  add(Severity::error, code, line, std::move(node), std::move(what), std::move(remedy));
  ++errors_;
}

void Problems::warning(ErrorCode code, int line, std::string node, std::string what, std::string remedy) {
  add(Severity::warning, code, line, std::move(node), std::move(what), std::move(remedy));
}

void Problems::unknown(int line, std::string node, std::string what, const std::string& word,
                       std::span<const std::string> candidates) {
  if (full() && errors_ > 0) return;
  const bool near = !nearest(word, candidates).empty();
  std::string remedy = suggest(word, candidates, "remove it; nothing may be written here");
  if (!near && !candidates.empty()) remedy = "remove it, or " + remedy;
  add(near ? Severity::error : Severity::warning, ErrorCode::unknown_name, line, std::move(node), std::move(what),
      std::move(remedy));
  if (near) ++errors_;
}

void Problems::note(int line, std::string node, std::string what, std::string remedy) {
  add(Severity::note, ErrorCode::not_supported, line, std::move(node), std::move(what), std::move(remedy));
}

Error Problems::first_error() const {
  const auto first =
      std::find_if(problems_.begin(), problems_.end(), [](const Problem& p) { return p.severity == Severity::error; });
  MECHANE_ASSERT(first != problems_.end());
  std::string where = place(*first);
  if (!first->node.empty()) where += ", " + first->node;
  std::string remedy = first->remedy;
  if (errors_ > 1) remedy += fmt::format(" (and {} more: run `mechane check {}`)", errors_ - 1, file_);
  return {first->code, first->what, std::move(where), std::move(remedy), first->line};
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
                    {"code", name_of(p.code)},
                    {"file", p.file},
                    {"line", p.line},
                    {"node", p.node},
                    {"what", p.what},
                    {"remedy", p.remedy}});
  }
  // File names and garbled attributes may hold any bytes: a byte that is not UTF-8 is replaced, where dump() would else throw.
  return list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace mechane::x3d
