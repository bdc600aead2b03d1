#include "server/app/live_edit.hpp"

#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "server/log/log.hpp"
#include "server/world/continuation.hpp"

namespace mechane::app {

std::optional<std::uint64_t> parse_edit_order(std::string_view line) {
  constexpr std::string_view kEdit = "edit ";
  if (!line.starts_with(kEdit)) return std::nullopt;
  std::uint64_t number = 0;
  const char* end = line.data() + line.size();
  const auto read = std::from_chars(line.data() + kEdit.size(), end, number);
  return read.ec == std::errc() && read.ptr == end ? std::optional(number) : std::nullopt;
}

std::string LiveEdit::look() {
  if (reading_.valid()) return is_ready(reading_) ? finish(reading_.get()) : std::string();
  if (!next_) return {};
  number_ = *std::exchange(next_, std::nullopt);
  reading_ = reader_.ask([file = scenarios_.file_of(scenarios_.first()->id), settings = settings_] {
    return load_scenario(file, settings);
  });
  return {};
}

std::string LiveEdit::finish(const Read& read) {
  const auto now = scenarios_.first();
  const auto failed = [this](const std::string& why) {
    log::warning("the edited exhibit is not taken: " + why);
    return fmt::format("edit {} failed", number_);
  };
  if (!read) return failed(read.error().to_string());
  if ((*read)->id != now->id) return failed(fmt::format("its id is '{}' now", (*read)->id));
  const auto obstacle = world::obstacle_between(now, *read, scenarios_.world_config());
  if (!obstacle) return failed(obstacle.error().to_string());
  if (obstacle->kind != world::Obstacle::Kind::none)
    return fmt::format("edit {} {} {}", number_, world::word_of(obstacle->kind), obstacle->name);
  if (now->content_hash != (*read)->content_hash) {
    scenarios_.put(*read, scenarios_.file_of(now->id));
    lobby_.carry_on(now->id);
  }
  return fmt::format("edit {} taken", number_);
}

}  // namespace mechane::app
