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

std::optional<std::string> PictureSchedule::due(TimePoint now, const client::WorldStatus& status, bool whole) {
  if (status.activity.empty()) return {};
  std::string name = file_name(status.activity) + "-" + (status.done ? "done" : file_name(status.step));
  // Steps of different exhibits may have the same name: the first keeps it, for the next the exhibit's name is put in
  // front.
  const std::string& owner = owner_.try_emplace(name, status.scenario).first->second;
  if (owner != status.scenario) name = file_name(status.scenario) + "-" + name;
  if (name != present_) {
    if (!present_.empty() && !taken_.contains(present_)) missed_.insert(present_);
    present_ = name;
    since_ = now;
  }
  if (taken_.contains(name) || now - since_ < (status.done ? kSettleDone : kSettle)) return {};
  if (!whole && now - since_ < kPatience) return {};
  taken_.insert(name);
  missed_.erase(name);
  return name;
}

}  // namespace mechane::display
