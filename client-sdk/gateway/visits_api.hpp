// The API of visits: what visitors did and said, as figures, as a spreadsheet and one by one; observers' remarks. STREAM.md lists it.
#pragma once

#include "client-sdk/gateway/site.hpp"

namespace mechane::gateway {

/// False: nothing is at this address. For authors and operators. On the loop's thread, as the site.
[[nodiscard]] bool answer_visits_get(GatewaySite& site, const HttpRequest& request, const Site::Done& done);
/// The same of a POST, whose session, origin and CSRF header were checked; the role is checked here.
[[nodiscard]] bool answer_visits_post(GatewaySite& site, const Session& session, const HttpRequest& request,
                                      const Site::Done& done);

}  // namespace mechane::gateway
