// ExhibitGate: which requests about exhibits a server takes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <mechane/proto/exhibit_key.hpp>
#include <mechane/proto/topics.hpp>

namespace mechane::transport {

enum class ExhibitVerb : std::uint8_t { load, replace, retire };

/// A request of somebody who has the server's key.
struct ExhibitOrder {
  std::uint64_t id = 0;
  ExhibitVerb verb = ExhibitVerb::load;
  std::string exhibit;  ///< a name by proto::is_exhibit_name(), never a path
  bool now = false;     ///< visits in progress end, too
};

enum class ExhibitFault : std::uint8_t {
  none,
  not_for_us,  ///< another protocol, server or run of this server
  no_key,      ///< this server takes no requests
  forged,      ///< the seal is not of our key
  late,        ///< sealed, but another request with this counter came first
  replayed,    ///< taken before
  bad_value    ///< sealed, but with a verb or a name that cannot be
};
/// For the log: "it was sealed with a different key".
[[nodiscard]] std::string_view words_of(ExhibitFault fault);

/// Takes a request once, and only with a seal of the key. One thread.
class ExhibitGate {
 public:
  /// Without a key nothing is taken.
  ExhibitGate(std::optional<proto::ExhibitKey> key, std::string server, std::uint64_t incarnation);

  /// Fills `order` where the request is taken; its id, too, where it is late or has a bad value: these get an answer.
  [[nodiscard]] ExhibitFault take(const proto::ExhibitRequest& wire, ExhibitOrder& order);

  [[nodiscard]] bool is_open() const { return key_.has_value(); }
  /// Of the last request that was taken; 0: none.
  [[nodiscard]] std::uint64_t counter() const { return counter_; }
  /// Zeros without a key.
  [[nodiscard]] std::array<std::uint8_t, 16> key_mark() const;

 private:
  std::optional<proto::ExhibitKey> key_;
  std::string server_;
  std::uint64_t incarnation_;
  std::uint64_t counter_ = 0;
  std::array<std::uint64_t, 64> taken_{};  // ids, so that a replay gets no answer
  std::size_t next_taken_ = 0;
};

}  // namespace mechane::transport
