#include "client-sdk/gateway/http/security_headers.hpp"

#include <algorithm>

#include "server/base/utf8.hpp"

namespace mechane::gateway {
namespace {

bool is_host(std::string_view host) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
           c == ':' || c == '[' || c == ']';
  };
  return !host.empty() && host.size() <= 255 && std::ranges::all_of(host, fits);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> security_headers(bool secure, std::string_view host, bool framed,
                                                                  std::uint16_t program) {
  // Older browsers do not count a WebSocket of the same host as 'self'.
  const std::string socket = is_host(host) ? (secure ? " wss://" : " ws://") + std::string(host) : std::string();
  const std::string beside = program > 0 ? " ws://127.0.0.1:" + std::to_string(program) : std::string();
  return {
      {"Content-Security-Policy",
       "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' blob: data:; "
       "media-src 'self' blob:; worker-src 'self' blob:; connect-src 'self' blob:" +
           socket + beside + "; object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors " +
           (framed ? "'self'" : "'none'")},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", framed ? "SAMEORIGIN" : "DENY"},
      {"Referrer-Policy", "no-referrer"},  // an address has a token in it
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Permissions-Policy", "camera=(self), xr-spatial-tracking=(self), microphone=(), geolocation=(), payment=()"},
  };
}

bool is_own_origin(std::string_view origin, std::string_view host, bool secure) {
  if (!is_host(host)) return false;
  return lower_case(std::string(origin)) == (secure ? "https://" : "http://") + lower_case(std::string(host));
}

}  // namespace mechane::gateway
