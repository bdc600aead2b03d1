// From an asset's name to its address on the web. Names come from a scenario, which is not trusted.
#pragma once

#include <string>
#include <string_view>

#include "server/base/error.hpp"

namespace mechane::assets {

/// True for an address, which is fetched and not read from a folder: it begins with http:// or https://.
[[nodiscard]] bool is_web_address(std::string_view text);

/// The address of a scenario's folder on an HTTP server.
class AssetAddress {
 public:
  /// Reads "http://host:port/path/of/scenario", already percent-encoded. Errors: neither http nor https; no host; a
  /// user name (it would appear in logs), a query, a fragment, '.' or '..', a character that must be escaped.
  [[nodiscard]] static Expected<AssetAddress> parse(std::string_view text);

  /// The address of a file whose name is relative to the scenario's folder, with '/' between its parts; each part is
  /// escaped. As exhibits share models, a name may lead to the parent of the scenario's folder ("../models/screw.glb"),
  /// but no higher; at the root of a web server, ".." is the root itself, as in a browser. Errors: the name leads
  /// higher, is empty or absolute, or has an empty part or a control character.
  [[nodiscard]] Expected<std::string> of(std::string_view name) const;

  /// Whether it is https; then a redirect must not lead to plain http.
  [[nodiscard]] bool secure() const { return secure_; }
  /// For people.
  [[nodiscard]] std::string text() const { return root_ + folder_; }

 private:
  AssetAddress(bool secure, std::string root, std::string folder)
      : secure_(secure), root_(std::move(root)), folder_(std::move(folder)) {}

  bool secure_;
  std::string root_;    ///< no name may lead out of it; ends with '/'
  std::string folder_;  ///< the scenario's folder in it, without '/'; empty: the root itself
};

}  // namespace mechane::assets
