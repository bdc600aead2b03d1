#include "server/log/repeats.hpp"

#include <algorithm>

namespace mechane::log {

bool Repeats::pass(std::string_view text, int level, Time now) {
  const auto same =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.counted.text == text; });
  if (same == entries_.end()) {
    entries_.push_back({{std::string(text), level, 0}, now});
    return true;
  }
  ++same->counted.repeats;
  return false;
}

std::vector<Repeats::Counted> Repeats::take_over(Time now) {
  // One place stays free, for the text that comes next.
  auto end =
      entries_.begin() + static_cast<std::ptrdiff_t>(entries_.size() < kTexts ? 0 : entries_.size() - kTexts + 1);
  while (end != entries_.end() && now - end->shown >= kWindow)
    ++end;
  std::vector<Counted> over;
  for (auto entry = entries_.begin(); entry != end; ++entry) {
    if (entry->counted.repeats > 0) over.push_back(std::move(entry->counted));
  }
  entries_.erase(entries_.begin(), end);
  return over;
}

}  // namespace mechane::log
