#include "client-sdk/cli/device_access.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

#include <fcntl.h>
#include <pwd.h>
#include <unistd.h>

namespace mechane::cli {

namespace fs = std::filesystem;

Account this_account() {
  const passwd* const user = getpwuid(geteuid());
  Account account{user == nullptr ? std::to_string(geteuid()) : user->pw_name, geteuid(), {}};
  std::array<gid_t, 256> groups{};
  const int count = getgroups(groups.size(), groups.data());
  account.groups.assign(groups.begin(), groups.begin() + std::max(0, count));
  account.groups.push_back(getegid());
  return account;
}

bool may_open(const Account& who, const fs::path& file, const struct stat& status) {
  if (who.user == geteuid()) return faccessat(AT_FDCWD, file.c_str(), R_OK | W_OK, AT_EACCESS) == 0;
  const auto allows = [&](mode_t bits) { return (status.st_mode & bits) == bits; };
  if (who.user == status.st_uid) return allows(S_IRUSR | S_IWUSR);
  if (std::ranges::count(who.groups, status.st_gid) > 0) return allows(S_IRGRP | S_IWGRP);
  return allows(S_IROTH | S_IWOTH);
}

std::string name_of_id(const fs::path& list, unsigned id) {
  std::ifstream in(list);
  for (std::string line; std::getline(in, line);) {
    const auto fields = split(line, ':');
    if (fields.size() > 2 && fields[2] == std::to_string(id)) return fields[0];
  }
  return std::to_string(id);
}

std::optional<gid_t> group_id(const fs::path& root, const std::string& name) {
  std::ifstream in(root / "etc/group");
  for (std::string line; std::getline(in, line);) {
    const auto fields = split(line, ':');
    if (fields.size() > 2 && fields[0] == name) return static_cast<gid_t>(std::strtoul(fields[2].c_str(), nullptr, 10));
  }
  return std::nullopt;
}

OpenFiles::OpenFiles(const fs::path& root) {
  for (const fs::path& process : entries_of(root / "proc")) {
    const std::string pid = process.filename().string();
    if (!is_number(pid)) continue;
    std::error_code unreadable;
    fs::directory_iterator it(process / "fd", unreadable);
    if (unreadable == std::errc::permission_denied) all_seen_ = false;
    for (const fs::directory_iterator end; !unreadable && it != end; it.increment(unreadable)) {
      std::error_code gone;
      const std::string file = fs::read_symlink(it->path(), gone).string();
      if (file.starts_with("/dev/")) users_[file][pid] = first_line(process / "comm");
    }
  }
}

Values OpenFiles::users_of(const std::string& file) const {
  const auto found = users_.find(file);
  return found == users_.end() ? Values{} : found->second;
}

}  // namespace mechane::cli
