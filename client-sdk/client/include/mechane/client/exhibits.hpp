// The exhibits of a running server, for operators' and authors' tools: what there is, and requests to load, replace or retire one.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"

namespace mechane::client {

/// An exhibit that a server can open.
struct OpenableExhibit {
  std::string id;
  std::string content_hash;
  std::map<std::string, std::string> title{};  ///< by language
  std::uint32_t worlds = 0;                    ///< that run it as it is now
  std::uint32_t former_worlds = 0;             ///< that run a former content of it, until their visits end
};

/// The answer to a request.
struct ExhibitAnswer {
  std::uint64_t id = 0;
  std::string refusal;  ///< what is wrong; empty: done
  std::string place;    ///< where: file and line
  std::string remedy;   ///< what to do
};

struct ExhibitStatus {
  std::string server;
  std::uint64_t incarnation = 0;
  bool changeable = false;  ///< it takes requests
  std::array<std::uint8_t, 16> key_mark{};
  std::uint64_t counter = 0;
  std::string preparing;                    ///< the exhibit that it is reading now; empty: none
  std::vector<OpenableExhibit> exhibits{};  ///< home first
  std::vector<std::string> loadable{};      ///< in its folder, not loaded
  std::vector<ExhibitAnswer> answers{};     ///< to the last requests
};

enum class ExhibitVerb : std::uint8_t { load, replace, retire };
/// Of "load", "replace" or "retire"; none: it is another word.
[[nodiscard]] std::optional<ExhibitVerb> exhibit_verb(std::string_view word);

struct ExhibitRequest {
  ExhibitVerb verb = ExhibitVerb::load;
  std::string exhibit;  ///< its id
  bool now = false;     ///< visits in progress end; their forces go to zero first
};

/// Servers' exhibits. Any thread, one at a time.
class ExhibitWatch {
 public:
  static constexpr std::size_t kMostServers = 16;  ///< further ones are not heard

  /// Errors: a domain over 230, a configuration of the network that cannot be used.
  [[nodiscard]] static Expected<std::unique_ptr<ExhibitWatch>> open(std::uint32_t domain);
  virtual ~ExhibitWatch() = default;

  /// Waits until something changes, at most `timeout`.
  virtual void wait(Duration timeout) = 0;
  /// The servers that run, by name.
  [[nodiscard]] virtual std::vector<ExhibitStatus> servers() = 0;
  /// What a server has answered to the request with this id; none: nothing yet.
  [[nodiscard]] std::optional<ExhibitAnswer> answer(std::uint64_t id);
  /// Sends a request, sealed with the key of the file: the server's own, or a copy of it. Returns the id with which the server answers.
  /// Errors: unknown_name (no such server), invalid_value (the exhibit's name), not_supported (the server takes no requests), conflict
  /// (another server's key), io_failure (it could not be sent), and those of the key's file.
  [[nodiscard]] virtual Expected<std::uint64_t> request(const std::string& server, const ExhibitRequest& request,
                                                        const std::filesystem::path& key_file) = 0;
};

}  // namespace mechane::client
