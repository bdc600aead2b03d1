#include "client-sdk/studio/draft/text_delta.hpp"

#include <algorithm>

#include "server/base/utf8.hpp"

namespace mechane::studio {
namespace {

bool begins_letter_at(std::string_view text, std::size_t at) {
  return at >= text.size() || begins_letter(text[at]);
}

}  // namespace

TextDelta delta_between(std::string_view from, std::string_view to) {
  const std::size_t shorter = std::min(from.size(), to.size());
  const auto split = std::mismatch(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(shorter), to.begin());
  auto same = static_cast<std::size_t>(split.first - from.begin());
  while (same > 0 && !(begins_letter_at(from, same) && begins_letter_at(to, same)))
    --same;
  std::size_t tail = 0;
  while (tail < shorter - same && from[from.size() - 1 - tail] == to[to.size() - 1 - tail])
    ++tail;
  while (tail > 0 && !begins_letter_at(from, from.size() - tail))
    --tail;
  return {same, std::string(from.substr(same, from.size() - tail - same)),
          std::string(to.substr(same, to.size() - tail - same))};
}

std::optional<std::string> applied(std::string_view text, const TextDelta& delta) {
  if (delta.at > text.size() || text.substr(delta.at, delta.before.size()) != delta.before) return std::nullopt;
  std::string out;
  out.reserve(text.size() + delta.after.size());
  out += text.substr(0, delta.at);
  out += delta.after;
  out += text.substr(delta.at + delta.before.size());
  return out;
}

}  // namespace mechane::studio
