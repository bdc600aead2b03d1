// The key with which requests to load, replace or retire exhibits are sealed. DDS carries them in the clear, and anybody on the network can
// send some; only somebody who can read the server's key file can seal one that the server takes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "server/base/error.hpp"
#include <mechane/proto/topics.hpp>

namespace mechane::proto {

/// Whether this can name an exhibit in a request: 1 to 63 characters of A-Z a-z 0-9 - and _, so that it never is a path.
[[nodiscard]] bool is_exhibit_name(std::string_view name);

/// 256 random bits, by libsodium. Any thread.
class ExhibitKey {
 public:
  /// Of a file of 64 hex digits that nobody but its user may read or write. Errors: not_found, io_failure, damaged, conflict (others
  /// may).
  [[nodiscard]] static Expected<ExhibitKey> read(const std::filesystem::path& file);
  /// The same; where there is no such file, it is made first, with its folder. Errors: also io_failure.
  [[nodiscard]] static Expected<ExhibitKey> read_or_make(const std::filesystem::path& file);

  /// Tells whether two keys are the same, and nothing else of them.
  [[nodiscard]] std::array<std::uint8_t, 16> mark() const;
  /// Fills the seal: HMAC-SHA-512-256 of the server, its run, the request's counter, id, verb, exhibit and `now`.
  void seal(ExhibitRequest& request) const;
  /// Whether the seal is right. Takes the same time wherever it differs.
  [[nodiscard]] bool fits(const ExhibitRequest& request) const;

 private:
  ExhibitKey() = default;
  std::array<std::uint8_t, 32> bytes_{};
};

}  // namespace mechane::proto
