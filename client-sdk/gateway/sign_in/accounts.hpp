// Who may sign in, and as what. One small JSON file, readable by its owner alone.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "server/base/error.hpp"

namespace mechane::gateway {

enum class Role { visitor, author, manager };
/// "visitor", "author", "operator".
[[nodiscard]] std::string_view word_of(Role role);
[[nodiscard]] std::optional<Role> role_of(std::string_view word);

struct Account {
  Role role = Role::visitor;
  std::string password_hash;
};

/// Not thread-safe: on the loop's thread.
class Accounts {
 public:
  static constexpr std::size_t kMost = 200;
  static constexpr std::size_t kLeastPassword = 10;  ///< letters

  /// If there is no file yet, makes the operator 'operator'; first_password() tells its password once. Slow.
  /// Errors: io_failure, damaged.
  [[nodiscard]] static Expected<Accounts> open(const std::filesystem::path& folder);
  [[nodiscard]] const std::string& first_password() const { return first_password_; }

  /// None if no user has this name.
  [[nodiscard]] const Account* find(const std::string& user) const;
  [[nodiscard]] const std::map<std::string, Account>& all() const { return accounts_; }
  /// Writes the file. Errors, with nothing changed: a bad name, too many, io_failure.
  [[nodiscard]] Expected<void> put(const std::string& user, Account account);
  /// Errors: not_found; conflict for the last operator.
  [[nodiscard]] Expected<void> remove(const std::string& user);

 private:
  explicit Accounts(std::filesystem::path file) : file_(std::move(file)) {}
  [[nodiscard]] Expected<void> write(const std::map<std::string, Account>& accounts) const;
  std::filesystem::path file_;
  std::map<std::string, Account> accounts_;
  std::string first_password_;
};

/// Reads the file's text. Errors: damaged.
[[nodiscard]] Expected<std::map<std::string, Account>> parse_accounts(std::string_view text);

}  // namespace mechane::gateway
