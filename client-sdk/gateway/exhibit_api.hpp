// The operators' API of exhibits: what a server has, and to load, replace and retire. STREAM.md lists it.
#pragma once

#include "client-sdk/gateway/site.hpp"

namespace mechane::gateway {

/// GET /api/exhibits. False: the address is another one. For operators; the caller has checked it. On the loop's thread.
[[nodiscard]] bool answer_exhibits_get(GatewaySite& site, const HttpRequest& request, const Site::Done& done);

/// POST /api/exhibits/NAME/load, replace or retire, with {"now": true} where visits in progress shall end. False: the address is another
/// one. For operators, whose session, origin and CSRF header were checked, and whose request is in the audit log.
[[nodiscard]] bool answer_exhibits_post(GatewaySite& site, const HttpRequest& request, bool now,
                                        const Site::Done& done);

}  // namespace mechane::gateway
