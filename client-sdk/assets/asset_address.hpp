// From an asset's name to its address on the web: names come from a scenario, which nobody vouches for.
#pragma once

#include <string>
#include <string_view>

#include "server/base/error.hpp"

namespace mechane::assets {

/// True for what is to be fetched rather than read from a folder: it begins with http:// or https://.
[[nodiscard]] bool is_web_address(std::string_view text);

/// The address of a scenario's folder on an HTTP server.
class AssetAddress {
 public:
  /// Reads "http://host:port/path/of/scenario", already percent-encoded. Errors: neither http nor https; no host; a user's name (it
  /// would stand in logs), a query, a fragment, '.' or '..' or a character that no address may have.
  [[nodiscard]] static Expected<AssetAddress> parse(std::string_view text);

  /// The address of a file, named relative to the scenario's folder, with '/' between its parts; each part is escaped. As exhibits share
  /// models, a name may lead to the folder that the scenario's folder stands in ("../models/screw.glb"), and no higher; at the root of a
  /// web server, which has nothing above it, both are that root, as a browser reads it. Errors: it leads higher, or it is empty, absolute,
  /// has an empty part or a control character.
  [[nodiscard]] Expected<std::string> of(std::string_view name) const;

  /// https: then a redirect must not lead to plain http.
  [[nodiscard]] bool secure() const { return secure_; }
  /// For people.
  [[nodiscard]] std::string text() const { return root_ + folder_; }

 private:
  AssetAddress(bool secure, std::string root, std::string folder)
      : secure_(secure), root_(std::move(root)), folder_(std::move(folder)) {}

  bool secure_;
  std::string root_;    ///< no name leads out of it; ends with '/'
  std::string folder_;  ///< the scenario's folder in it, without '/'; empty: the root itself
};

}  // namespace mechane::assets
