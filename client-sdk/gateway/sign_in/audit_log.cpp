#include "client-sdk/gateway/sign_in/audit_log.hpp"

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <span>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "server/base/whole_file.hpp"

namespace mechane::gateway {
namespace {

using AuditJson = nlohmann::json;

std::string time_text() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday,
                     parts.tm_hour, parts.tm_min, parts.tm_sec);
}

std::filesystem::path old_file(const std::filesystem::path& file, int number) {
  return file.string() + "." + std::to_string(number);
}

void rotate(const std::filesystem::path& file) {
  std::error_code ignored;  // what cannot be renamed stays, and grows
  for (int number = AuditLog::kOldFiles - 1; number >= 1; --number)
    std::filesystem::rename(old_file(file, number), old_file(file, number + 1), ignored);
  std::filesystem::rename(file, old_file(file, 1), ignored);
}

}  // namespace

Expected<void> AuditLog::add(std::string_view user, std::string_view address, std::string_view action,
                             std::string_view detail) {
  std::error_code unknown;
  if (const auto size = std::filesystem::file_size(file_, unknown); !unknown && size >= kMostBytes) rotate(file_);
  const AuditJson entry{
      {"time", time_text()}, {"user", user}, {"address", address}, {"action", action}, {"detail", detail}};
  const std::string line = entry.dump(-1, ' ', true, AuditJson::error_handler_t::replace) + "\n";
  const int fd = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (fd < 0) return tl::unexpected(file_error("the audit log cannot be written", file_, errno));
  const int error = write_all(fd, std::as_bytes(std::span(line)));
  ::close(fd);
  if (error != 0) return tl::unexpected(file_error("the audit log cannot be written", file_, error));
  return {};
}

std::vector<AuditEntry> newest_entries(const std::filesystem::path& file, std::size_t most) {
  std::vector<AuditEntry> entries;
  for (int number = 0; number <= AuditLog::kOldFiles && entries.size() < most; ++number) {
    std::ifstream in(number == 0 ? file : old_file(file, number));
    std::vector<AuditEntry> of_file;
    for (std::string line; std::getline(in, line);) {
      const AuditJson json = AuditJson::parse(line, nullptr, false);
      if (!json.is_object()) continue;
      const auto text = [&](const char* key) {
        const auto found = json.find(key);
        return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
      };
      of_file.push_back({text("time"), text("user"), text("address"), text("action"), text("detail")});
    }
    std::ranges::reverse(of_file);
    for (AuditEntry& entry : of_file)
      if (entries.size() < most) entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace mechane::gateway
