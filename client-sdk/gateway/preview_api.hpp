// The API of previews: authors try drafts. COMMANDS.md has the requests.
#pragma once

#include <string>

#include "client-sdk/gateway/site.hpp"

namespace mechane::gateway {

// What the studio's API does for addresses that end so: "preview", "preview/pace", "preview/visit", "preview/device",
// "preview/stop". The caller checks roles and writes the audit log. On the loop's thread, as the site.

[[nodiscard]] bool is_preview_verb(const std::string& verb);
/// Whether it asks for nothing that is worth a line of the audit log.
[[nodiscard]] bool is_passing(const std::string& verb);
/// False: nothing is there.
[[nodiscard]] bool answer_preview_get(GatewaySite& site, const std::string& draft, const std::string& verb,
                                      const Site::Done& done);
void answer_preview_post(GatewaySite& site, const std::string& draft, const std::string& verb, const std::string& body,
                         const Site::Done& done);

/// {"pace": 0..1} or {"ticks": 1..10000}.
struct PaceRequest {
  double pace = 1;
  std::uint32_t ticks = 0;  ///< 0: a pace
};
/// Errors: invalid_value.
[[nodiscard]] Expected<PaceRequest> parse_pace(const std::string& body);
/// {"visit": NAME}; the name may be empty. Errors: invalid_value.
[[nodiscard]] Expected<std::string> parse_visit_order(const std::string& body);

}  // namespace mechane::gateway
