// What each answer tells the browser to allow a page: only what comes from here.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mechane::gateway {

/// `host`: the request's Host header, as the browser sent it; what cannot be a host's name is left out. `framed`: pages of this host may
/// show it in a frame. `program`: the port of a program on the browser's own machine that pages may talk to; 0: none.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> security_headers(bool secure, std::string_view host,
                                                                                bool framed, std::uint16_t program);

/// Whether a request with this Origin comes from a page of this host: both from the browser. An empty origin: no.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host, bool secure);

}  // namespace mechane::gateway
