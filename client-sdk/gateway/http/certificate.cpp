#include "client-sdk/gateway/http/certificate.hpp"

#include <array>
#include <memory>
#include <span>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include "server/base/whole_file.hpp"

namespace mechane::gateway {
namespace {

constexpr long kDay_s = 24L * 3600;
constexpr long kValid_s = 800 * kDay_s;
constexpr int kRenewedDays = 30;

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* thing) const {
    Free(thing);
  }
};
void free_bio(BIO* bio) {
  BIO_free(bio);
}
using Key = std::unique_ptr<EVP_PKEY, Freed<&EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<&X509_free>>;
using Memory = std::unique_ptr<BIO, Freed<&free_bio>>;

tl::unexpected<Error> no_certificate() {
  return fail(ErrorCode::failed_process, "OpenSSL cannot make a certificate", {},
              "give one with --tls-cert and --tls-key");
}

std::string text_in(BIO* memory) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(memory, &data);
  return {data, static_cast<std::size_t>(size)};
}

bool add_extension(X509* certificate, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str());
  if (extension == nullptr) return false;
  const bool added = X509_add_ext(certificate, extension, -1) == 1;
  X509_EXTENSION_free(extension);
  return added;
}

Certificate signed_certificate(EVP_PKEY* key, const std::string& name, const std::string& others) {
  Certificate certificate(X509_new());
  std::array<unsigned char, 16> serial{};
  if (!certificate || RAND_bytes(serial.data(), serial.size()) != 1) return nullptr;
  serial[0] &= 0x7F;
  const std::unique_ptr<BIGNUM, Freed<&BN_free>> number(BN_bin2bn(serial.data(), serial.size(), nullptr));
  X509* const x = certificate.get();
  X509_NAME* const subject = X509_get_subject_name(x);
  const auto* common = reinterpret_cast<const unsigned char*>(name.c_str());
  const bool done = number && X509_set_version(x, 2) == 1 &&
                    BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(x)) != nullptr &&
                    X509_gmtime_adj(X509_getm_notBefore(x), -kDay_s) != nullptr &&
                    X509_gmtime_adj(X509_getm_notAfter(x), kValid_s) != nullptr &&
                    X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8, common, -1, -1, 0) == 1 &&
                    X509_set_issuer_name(x, subject) == 1 && X509_set_pubkey(x, key) == 1 &&
                    add_extension(x, NID_subject_alt_name, others) &&
                    add_extension(x, NID_basic_constraints, "critical,CA:TRUE,pathlen:0") &&
                    add_extension(x, NID_ext_key_usage, "serverAuth") && X509_sign(x, key, EVP_sha256()) > 0;
  if (!done) return nullptr;
  return certificate;
}

/// Whether there is a certificate that is valid for a while.
bool is_still_valid(const std::filesystem::path& file) {
  const auto bytes = read_whole(file, 1U << 20U);
  if (!bytes) return false;
  const Memory memory(BIO_new_mem_buf(bytes->data(), static_cast<int>(bytes->size())));
  const Certificate certificate(PEM_read_bio_X509(memory.get(), nullptr, nullptr, nullptr));
  int days = 0, seconds = 0;
  return certificate && ASN1_TIME_diff(&days, &seconds, nullptr, X509_get0_notAfter(certificate.get())) == 1 &&
         days >= kRenewedDays;
}

}  // namespace

Expected<CertificateFiles> own_certificate(const std::filesystem::path& folder, const std::vector<std::string>& names,
                                           const std::vector<std::string>& addresses) {
  CertificateFiles files{folder / "tls-cert.pem", folder / "tls-key.pem"};
  std::error_code unknown;
  if (is_still_valid(files.certificate) && std::filesystem::exists(files.key, unknown)) return files;
  std::string others;
  for (const std::string& name : names)
    others += (others.empty() ? "DNS:" : ",DNS:") + name;
  for (const std::string& address : addresses)
    others += (others.empty() ? "IP:" : ",IP:") + address;
  const Key key(EVP_EC_gen("P-256"));
  const Certificate certificate = key ? signed_certificate(key.get(), "Mechane " + names.front(), others) : nullptr;
  const Memory key_text(BIO_new(BIO_s_mem())), certificate_text(BIO_new(BIO_s_mem()));
  if (!certificate || !key_text || !certificate_text ||
      PEM_write_bio_PrivateKey(key_text.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) != 1 ||
      PEM_write_bio_X509(certificate_text.get(), certificate.get()) != 1)
    return no_certificate();
  const std::string key_pem = text_in(key_text.get()), certificate_pem = text_in(certificate_text.get());
  if (auto ok = write_whole(files.key, std::as_bytes(std::span(key_pem)), WholeFile::shared); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = write_whole(files.certificate, std::as_bytes(std::span(certificate_pem)), WholeFile::shared); !ok)
    return tl::unexpected(ok.error());
  files.made = true;
  return files;
}

std::vector<std::string> own_addresses() {
  std::vector<std::string> out;
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {"127.0.0.1", "::1"};
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || (one->ifa_flags & IFF_UP) == 0) continue;
    std::array<char, INET6_ADDRSTRLEN> text{};
    const void* address = nullptr;
    if (one->ifa_addr->sa_family == AF_INET) address = &reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr;
    if (one->ifa_addr->sa_family == AF_INET6)
      address = &reinterpret_cast<const sockaddr_in6*>(one->ifa_addr)->sin6_addr;
    if (address != nullptr && inet_ntop(one->ifa_addr->sa_family, address, text.data(), text.size()) != nullptr)
      out.emplace_back(text.data());
  }
  freeifaddrs(first);
  return out;
}

}  // namespace mechane::gateway
