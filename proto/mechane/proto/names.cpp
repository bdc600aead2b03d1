#include <algorithm>

#include <mechane/proto/names.hpp>

namespace mechane::proto {

bool is_name(std::string_view name) {
  return !name.empty() && name.size() < kNameSize && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

Expected<void> check_name(std::string_view name, const std::string& what) {
  if (is_name(name)) return {};
  return fail(ErrorCode::invalid_value, "'" + std::string(name.substr(0, 64)) + "' is not a valid name for a " + what,
              what, "use 1 to 31 characters of A-Z a-z 0-9 - and _");
}

std::string kiosk_partition(std::string_view kiosk) {
  return "kiosk/" + std::string(kiosk);
}
std::string world_partition(std::string_view world) {
  return "world/" + std::string(world);
}

}  // namespace mechane::proto
