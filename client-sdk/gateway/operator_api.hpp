// The API of operators and authors: kiosks, displays, the server, visits, accounts, the audit log. STREAM.md lists it.
#pragma once

#include "client-sdk/gateway/site.hpp"

namespace mechane::gateway {

/// False: nothing is at this address. On the loop's thread, as the site.
[[nodiscard]] bool answer_api_get(GatewaySite& site, const Session& session, const HttpRequest& request,
                                  const Site::Done& done);
/// The same of a POST, whose session, origin and CSRF header were checked.
[[nodiscard]] bool answer_api_post(GatewaySite& site, const Session& session, const HttpRequest& request,
                                   const Site::Done& done);

[[nodiscard]] HttpAnswer unknown_kiosk(const std::string& kiosk);
/// Opens an exhibit at a kiosk; "" is home. `done` is told when the kiosk is there, or why not.
void open_at_kiosk(GatewaySite& site, const std::string& kiosk, const std::string& scenario, const Site::Done& done);

}  // namespace mechane::gateway
