// The gateway's own key and certificate, made at the first start where none are given.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::gateway {

struct CertificateFiles {
  std::filesystem::path certificate;
  std::filesystem::path key;
  bool made = false;  ///< just now
};

/// `folder`/tls-cert.pem and tls-key.pem (only the owner can read the key). Where they are missing, or the certificate ends within a month,
/// makes them: an elliptic key (P-256), signed by itself, for these names and addresses in digits, for 800 days, which is as long as
/// browsers accept. Errors: io_failure.
[[nodiscard]] Expected<CertificateFiles> own_certificate(const std::filesystem::path& folder,
                                                         const std::vector<std::string>& names,
                                                         const std::vector<std::string>& addresses);

/// This machine's addresses in digits, those of the loopback too.
[[nodiscard]] std::vector<std::string> own_addresses();

}  // namespace mechane::gateway
