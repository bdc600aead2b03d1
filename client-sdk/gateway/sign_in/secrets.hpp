// Random secrets and passwords, by libsodium. Any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "server/base/error.hpp"

namespace mechane::gateway {

/// Call once, before the other functions here. Errors: the system has no random numbers.
[[nodiscard]] Expected<void> start_secrets();

/// So many random bytes, in letters that need no escape in an address or a cookie.
[[nodiscard]] std::string random_secret(std::size_t bytes);
/// Compares in a time that does not tell how much is equal.
[[nodiscard]] bool same_secret(std::string_view a, std::string_view b);

/// argon2id with its own salt and costs, as one line of text. Slow on purpose: about a tenth of a second and 64 MiB. Errors: no memory.
[[nodiscard]] Expected<std::string> hash_password(const std::string& password);
/// As slow. False for text that was not made by hash_password().
[[nodiscard]] bool is_password(const std::string& hash, const std::string& password);

}  // namespace mechane::gateway
