// Who may open a file of /dev, and who has it open. `root` is as in device_facts.hpp.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <sys/types.h>

#include "client-sdk/cli/device_facts.hpp"

namespace mechane::cli {

/// Who wants to open a device.
struct Account {
  std::string name;  ///< for messages: "ada"
  uid_t user = 0;
  std::vector<gid_t> groups;
};
[[nodiscard]] Account this_account();

/// Whether it may read and write. For the user of this process the system answers, which also knows access lists.
[[nodiscard]] bool may_open(const Account& who, const std::filesystem::path& file, const struct stat& status);

/// By etc/passwd or etc/group (`list`); a number that is not there stays one.
[[nodiscard]] std::string name_of_id(const std::filesystem::path& list, unsigned id);
[[nodiscard]] std::optional<gid_t> group_id(const std::filesystem::path& root, const std::string& name);

/// Which programs have which files of /dev open.
class OpenFiles {
 public:
  explicit OpenFiles(const std::filesystem::path& root);
  /// Programs' names by their process numbers.
  [[nodiscard]] Values users_of(const std::string& file) const;
  /// False: programs of other users may have more files open.
  [[nodiscard]] bool all_seen() const { return all_seen_; }

 private:
  std::map<std::string, Values> users_;
  bool all_seen_ = true;
};

}  // namespace mechane::cli
