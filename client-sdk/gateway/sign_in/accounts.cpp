#include "client-sdk/gateway/sign_in/accounts.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "client-sdk/gateway/sign_in/secrets.hpp"
#include "server/base/whole_file.hpp"

namespace mechane::gateway {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::pair<Role, std::string_view>, 3> kRoles{
    {{Role::visitor, "visitor"}, {Role::author, "author"}, {Role::manager, "operator"}}};
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 20U;

bool is_user(std::string_view name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
  };
  return !name.empty() && name.size() <= 31 && std::ranges::all_of(name, fits);
}

std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

std::string_view word_of(Role role) {
  return std::ranges::find(kRoles, role, &std::pair<Role, std::string_view>::first)->second;
}

std::optional<Role> role_of(std::string_view word) {
  const auto found = std::ranges::find(kRoles, word, &std::pair<Role, std::string_view>::second);
  if (found == kRoles.end()) return std::nullopt;
  return found->first;
}

Expected<std::map<std::string, Account>> parse_accounts(std::string_view text) {
  const auto damaged = [] {
    return fail(ErrorCode::damaged, "this is not a file of accounts", {},
                "put the file back from a copy, or move it away: a new operator is made at the next start");
  };
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("accounts") || !json["accounts"].is_array()) return damaged();
  std::map<std::string, Account> accounts;
  for (const Json& entry : json["accounts"]) {
    if (!entry.is_object()) return damaged();
    const std::string user = text_of(entry, "user"), hash = text_of(entry, "password");
    const auto role = role_of(text_of(entry, "role"));
    if (!is_user(user) || !role || hash.empty() || accounts.size() >= Accounts::kMost) return damaged();
    accounts[user] = {*role, hash};
  }
  return accounts;
}

Expected<Accounts> Accounts::open(const std::filesystem::path& folder) {
  Accounts made(folder / "accounts.json");
  const auto bytes = read_whole(made.file_, kMostBytes);
  if (bytes) {
    auto read = parse_accounts(as_text(*bytes));
    if (!read) return tl::unexpected(read.error().in(made.file_.string()));
    made.accounts_ = std::move(*read);
    return made;
  }
  if (bytes.error().code != ErrorCode::not_found) return tl::unexpected(bytes.error());
  std::string password = random_secret(12);
  auto hash = hash_password(password);
  if (!hash) return tl::unexpected(hash.error());
  if (auto put = made.put("operator", {Role::manager, *hash}); !put) return tl::unexpected(put.error());
  made.first_password_ = std::move(password);
  return made;
}

const Account* Accounts::find(const std::string& user) const {
  const auto found = accounts_.find(user);
  return found == accounts_.end() ? nullptr : &found->second;
}

Expected<void> Accounts::put(const std::string& user, Account account) {
  if (!is_user(user))
    return fail(ErrorCode::invalid_value, "this cannot be a user's name", "user",
                "take 1 to 31 small letters, digits, '-', '_' and '.'");
  auto changed = accounts_;
  changed[user] = std::move(account);
  if (changed.size() > kMost)
    return fail(ErrorCode::too_large, "there are too many accounts", "user", "remove one that is not needed");
  if (auto written = write(changed); !written) return written;
  accounts_ = std::move(changed);
  return {};
}

Expected<void> Accounts::remove(const std::string& user) {
  if (find(user) == nullptr)
    return fail(ErrorCode::not_found, "no user has this name", user, "GET /api/accounts lists them");
  auto changed = accounts_;
  changed.erase(user);
  if (std::ranges::none_of(changed, [](const auto& entry) { return entry.second.role == Role::manager; }))
    return fail(ErrorCode::conflict, "this is the last operator", user, "make another operator first");
  if (auto written = write(changed); !written) return written;
  accounts_ = std::move(changed);
  return {};
}

Expected<void> Accounts::write(const std::map<std::string, Account>& accounts) const {
  Json list = Json::array();
  for (const auto& [user, account] : accounts)
    list.push_back({{"user", user}, {"role", word_of(account.role)}, {"password", account.password_hash}});
  const std::string text = Json{{"accounts", list}}.dump(2) + "\n";
  return write_whole(file_, std::as_bytes(std::span(text)), WholeFile::shared);
}

}  // namespace mechane::gateway
