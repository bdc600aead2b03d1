#include "client-sdk/assets/asset_address.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "server/base/markup.hpp"
#include "server/base/utf8.hpp"

namespace mechane::assets {
namespace {

constexpr std::string_view kPlain = "http://";
constexpr std::string_view kSecure = "https://";
constexpr const char* kAddressRemedy =
    "write the address of the scenario's folder, as in http://server:8000/archimedes-screw";

std::vector<std::string_view> parts_of(std::string_view path) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    parts.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

bool is_dots(std::string_view part) {
  return part == "." || part == "..";
}

}  // namespace

bool is_web_address(std::string_view text) {
  return text.starts_with(kPlain) || text.starts_with(kSecure);
}

Expected<AssetAddress> AssetAddress::parse(std::string_view text) {
  const std::string where(text);
  if (!is_web_address(text))
    return fail(ErrorCode::invalid_value, "the address does not begin with http:// or https://", where, kAddressRemedy);
  const bool secure = text.starts_with(kSecure);
  const std::size_t host_at = (secure ? kSecure : kPlain).size();
  const bool odd = std::ranges::any_of(text, [](char c) {
    return is_control(c) || static_cast<unsigned char>(c) > 0x7e ||
           std::string_view(" \"<>\\^`{|}?#@").find(c) != std::string_view::npos;
  });
  if (odd)
    return fail(ErrorCode::invalid_value,
                "the address contains a user name, a query, a fragment or a character that must be escaped", where,
                kAddressRemedy);
  while (text.size() > host_at && text.ends_with('/'))
    text.remove_suffix(1);
  std::vector<std::string_view> parts = parts_of(text.substr(host_at));
  if (parts.front().empty() || parts.front().front() == ':')
    return fail(ErrorCode::missing, "the address has no host name", where, kAddressRemedy);
  const bool bad_part =
      std::any_of(parts.begin() + 1, parts.end(), [](std::string_view part) { return part.empty() || is_dots(part); });
  if (bad_part)
    return fail(ErrorCode::invalid_value, "the path of the address has an empty part, or '.' or '..'", where,
                kAddressRemedy);
  std::string folder;
  if (parts.size() > 1) {
    folder = parts.back();
    parts.pop_back();
  }
  std::string root(secure ? kSecure : kPlain);
  for (const std::string_view part : parts)
    root.append(part) += '/';
  return AssetAddress(secure, std::move(root), std::move(folder));
}

Expected<std::string> AssetAddress::of(std::string_view name) const {
  const std::string where = fmt::format("'{}'", name);
  if (name.empty())
    return fail(ErrorCode::missing, "a file without a name cannot be fetched", text(), "name a file in the scenario");
  if (std::ranges::any_of(name, [](char c) { return is_control(c); }))
    return fail(ErrorCode::invalid_value, "the file's name contains control characters", text(), "rename the file");
  std::vector<std::string> path;
  path.push_back(folder_);  // empty at the root of a server, whose ".." is the root itself
  for (const std::string_view part : parts_of(name)) {
    if (part.empty())
      return fail(ErrorCode::invalid_value, "the name is not a relative path, or has an empty part", where,
                  "name files as in ../models/screw.glb");
    if (part == "..") {
      if (path.empty())
        return fail(ErrorCode::invalid_value, "the name leads out of " + root_, where,
                    "let the scenario name files in its own folder or in one beside it, and give the address of the "
                    "scenario's folder");
      path.pop_back();
    } else if (part != ".") {
      path.push_back(escape_percent(part));
    }
  }
  if (path.empty() || is_dots(parts_of(name).back()))
    return fail(ErrorCode::invalid_value, "this is the name of a folder, not of a file", where, "name a file");
  if (path.front().empty()) path.erase(path.begin());
  return fmt::format("{}{}", root_, fmt::join(path, "/"));
}

}  // namespace mechane::assets
