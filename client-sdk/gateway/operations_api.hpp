// The API of what operators order: opening hours, messages, maintenance, changes that end by themselves, restarting and
// waking. On the loop's thread, as the site.
#pragma once

#include "client-sdk/gateway/site.hpp"

namespace mechane::gateway {

/// GET /api/operations.
[[nodiscard]] HttpAnswer operations_answer(GatewaySite& site);
/// A POST of an operator, already in the audit log. False: this address is another one's.
[[nodiscard]] bool answer_operations_post(GatewaySite& site, const HttpRequest& request, const Site::Done& done);

/// For "open" and "settings" whose request says when they end: `done`, which then also notes what was before. Otherwise
/// `done`; a change without an end takes the place of one with an end. Errors: invalid_value, too_large.
[[nodiscard]] Expected<Site::Done> with_end(GatewaySite& site, const std::string& kiosk, const std::string& verb,
                                            const std::string& body, const Site::Done& done);

}  // namespace mechane::gateway
