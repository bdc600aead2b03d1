// The API of the studio: authors' drafts of exhibits. STREAM.md lists it; client-sdk/studio/COMMANDS.md has its JSON.
#pragma once

#include "client-sdk/gateway/site.hpp"
#include "client-sdk/studio/shelf/shelf.hpp"

namespace mechane::gateway {

/// False: nothing is at this address. For authors and operators; the caller has checked it. On the loop's thread, as the site.
[[nodiscard]] bool answer_studio_get(GatewaySite& site, const HttpRequest& request, const Site::Done& done);
/// The same of a POST, whose session, origin and CSRF header were checked; the role is checked here.
[[nodiscard]] bool answer_studio_post(GatewaySite& site, const Session& session, const HttpRequest& request,
                                      const Site::Done& done);

/// A refusal of the shelf, with its status.
[[nodiscard]] HttpAnswer fault_answer(const studio::ShelfFault& fault);
/// How many bytes a POST to this address may have, whose body is a file: /api/studio/drafts/NAME/files/FILE or NAME/import. 0: it has JSON.
[[nodiscard]] std::size_t longest_studio_upload(const std::string& path);

}  // namespace mechane::gateway
