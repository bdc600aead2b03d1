#include "client-sdk/gateway/sign_in/secrets.hpp"

#include <array>
#include <vector>

#include <sodium.h>

namespace mechane::gateway {

Expected<void> start_secrets() {
  if (sodium_init() < 0)
    return fail(ErrorCode::failed_process, "libsodium has no random numbers on this machine", {}, "see its log");
  return {};
}

std::string random_secret(std::size_t bytes) {
  std::vector<unsigned char> raw(bytes);
  randombytes_buf(raw.data(), raw.size());
  constexpr int kForm = sodium_base64_VARIANT_URLSAFE_NO_PADDING;
  std::string text(sodium_base64_encoded_len(bytes, kForm), '\0');
  sodium_bin2base64(text.data(), text.size(), raw.data(), raw.size(), kForm);
  text.pop_back();  // the end of a C string
  return text;
}

bool same_secret(std::string_view a, std::string_view b) {
  return a.size() == b.size() && !a.empty() && sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

Expected<std::string> hash_password(const std::string& password) {
  std::array<char, crypto_pwhash_STRBYTES> out{};
  if (crypto_pwhash_str_alg(out.data(), password.data(), password.size(), crypto_pwhash_OPSLIMIT_INTERACTIVE,
                            crypto_pwhash_MEMLIMIT_INTERACTIVE, crypto_pwhash_ALG_ARGON2ID13) != 0)
    return fail(ErrorCode::failed_process, "there is not enough memory to hash a password", {}, "free 64 MiB");
  return std::string(out.data());
}

bool is_password(const std::string& hash, const std::string& password) {
  if (hash.size() >= crypto_pwhash_STRBYTES) return false;
  return crypto_pwhash_str_verify(hash.c_str(), password.data(), password.size()) == 0;
}

}  // namespace mechane::gateway
