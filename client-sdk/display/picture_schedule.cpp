#include "client-sdk/display/picture_schedule.hpp"

#include <algorithm>

namespace mechane::display {

std::string file_name(const std::string& text) {
  std::string out = text.substr(0, 100);
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  std::ranges::replace_if(
      out, [&](char c) { return !plain(c); }, '-');
  return out;
}

std::optional<std::string> PictureSchedule::due(TimePoint now, const client::WorldStatus& status) {
  if (status.activity.empty()) return {};
  const std::string name = file_name(status.activity) + "-" + (status.done ? "done" : file_name(status.step));
  if (name != present_) {
    if (!present_.empty() && !taken_.contains(present_)) missed_.insert(present_);
    present_ = name;
    since_ = now;
  }
  if (taken_.contains(name) || now - since_ < (status.done ? kSettleDone : kSettle)) return {};
  taken_.insert(name);
  missed_.erase(name);
  return name;
}

}  // namespace mechane::display
