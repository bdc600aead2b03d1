#include "server/base/suggestion.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace mechane {
namespace {

// Longer names are not compared: the cost grows with the product of the lengths, and a file may hold many names.
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

}  // namespace

std::string nearest(const std::string& name, std::span<const std::string> candidates) {
  if (name.empty() || name.size() > kLongestName) return {};
  std::string best;
  std::size_t best_edits = std::max<std::size_t>(1, (name.size() + 1) / 3) + 1;
  for (const std::string& candidate : candidates.first(std::min(candidates.size(), kMostCompared))) {
    if (candidate.empty() || candidate.size() > kLongestName) continue;
    // An abbreviated name counts as near, however much of it is missing.
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
  if (!near.empty()) return "did you mean '" + near + "'?";
  std::string list = "use one of: ";
  for (std::size_t i = 0; i < std::min(candidates.size(), kMostShown); ++i)
    list += (i == 0 ? "" : ", ") + candidates[i];
  return list + (candidates.size() > kMostShown ? ", ..." : "");
}

}  // namespace mechane
