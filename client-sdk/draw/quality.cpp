#include "client-sdk/draw/quality.hpp"

#include <algorithm>

namespace mechane::draw {

const std::vector<std::pair<std::string_view, Quality>>& quality_names() {
  static const std::vector<std::pair<std::string_view, Quality>> kNames{
      {"high", Quality::high}, {"medium", Quality::medium}, {"low", Quality::low}, {"cached", Quality::cached}};
  return kNames;
}

std::string_view quality_name(Quality quality) {
  return quality_names()[static_cast<std::size_t>(quality)].first;
}

std::optional<Quality> quality_of(std::string_view name) {
  for (const auto& [known, quality] : quality_names())
    if (known == name) return quality;
  return std::nullopt;
}

}  // namespace mechane::draw
