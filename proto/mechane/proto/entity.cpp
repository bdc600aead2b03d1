#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <vector>

#include <net/if.h>

#include <mechane/proto/entity.hpp>

namespace mechane::proto {
namespace {

constexpr std::uint32_t kLastDomain = 230;  // of higher ones, the ports of the RTPS mapping would exceed 65535

std::string interfaces_here() {
  std::string names;
  struct if_nameindex* const list = if_nameindex();
  for (const struct if_nameindex* i = list; i != nullptr && i->if_index != 0; ++i) {
    names += (names.empty() ? "" : ", ") + std::string(i->if_name);
  }
  if (list != nullptr) if_freenameindex(list);
  return names;
}

/// ${NAME} and ${NAME:-value}, as Cyclone expands them.
std::string with_environment(std::string text) {
  static const std::regex variable(R"(\$\{(\w+)(?::-([^}]*))?\})");
  std::smatch match;
  while (std::regex_search(text, match, variable)) {
    const char* value = std::getenv(match[1].str().c_str());
    text = match.prefix().str() + (value != nullptr ? std::string(value) : match[2].str()) + match.suffix().str();
  }
  return text;
}

/// What is wrong with a configuration that Cyclone refused; nothing where we cannot tell.
std::optional<Error> fault_of(const std::string& uri) {
  std::string xml = uri;
  if (uri.find('<') == std::string::npos) {
    const std::string path = uri.rfind("file://", 0) == 0 ? uri.substr(7) : uri;
    std::ifstream file(path);
    if (!file) {
      return Error{ErrorCode::not_found, "the DDS configuration cannot be read", path,
                   "set CYCLONEDDS_URI to an existing file"};
    }
    xml.assign(std::istreambuf_iterator<char>(file), {});
  }
  static const std::regex interface_name(R"re(<NetworkInterface\s[^>]*name\s*=\s*"([^"]*)")re", std::regex::icase);
  for (std::sregex_iterator i(xml.begin(), xml.end(), interface_name), end; i != end; ++i) {
    const std::string name = with_environment((*i)[1].str());
    if (if_nametoindex(name.c_str()) == 0) {
      return Error{ErrorCode::unknown_name, "there is no network interface '" + name + "'",
                   "CYCLONEDDS_URI, NetworkInterface", "name one of: " + interfaces_here()};
    }
  }
  return std::nullopt;
}

}  // namespace

Error dds_error(dds_return_t code, const std::string& doing, const std::string& where) {
  return {ErrorCode::io_failure, "DDS: " + doing + " failed: " + dds_strretcode(code), where,
          "Cyclone DDS has written its reason to stderr; check CYCLONEDDS_URI and the network"};
}

Expected<Participant> Participant::create(std::uint32_t domain) {
  const std::string where = "DDS domain " + std::to_string(domain);
  if (domain > kLastDomain)
    return fail(ErrorCode::invalid_value, "there is no such domain", where, "choose one of 0 to 230");
  const dds_entity_t handle = dds_create_participant(domain, nullptr, nullptr);
  if (handle > 0) return Participant(Entity(handle));
  const char* uri = std::getenv("CYCLONEDDS_URI");
  if (uri != nullptr && *uri != '\0') {
    if (auto fault = fault_of(uri)) return tl::unexpected<Error>(*std::move(fault));
  }
  return tl::unexpected<Error>(dds_error(handle, "joining the network", where));
}

}  // namespace mechane::proto
