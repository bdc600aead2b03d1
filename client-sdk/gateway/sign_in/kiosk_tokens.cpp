#include "client-sdk/gateway/sign_in/kiosk_tokens.hpp"

#include <algorithm>

#include "client-sdk/gateway/sign_in/secrets.hpp"

namespace mechane::gateway {

std::string KioskTokens::token_for(const std::string& kiosk, TimePoint now) {
  std::erase_if(tokens_, [&](const auto& entry) { return valid(entry.first, now) == nullptr; });
  std::erase_if(current_, [&](const auto& entry) { return !tokens_.contains(entry.second); });
  const auto current = current_.find(kiosk);
  if (current != current_.end() && now - tokens_[current->second].issued < kRotates) {
    tokens_[current->second].used = now;
    return current->second;
  }
  if (tokens_.size() >= kMost)
    tokens_.erase(std::ranges::min_element(tokens_, {}, [](const auto& entry) { return entry.second.used; }));
  std::string token = random_secret(18);
  tokens_[token] = {kiosk, now, now};
  current_[kiosk] = token;
  return token;
}

const KioskTokens::Token* KioskTokens::valid(const std::string& token, TimePoint now) const {
  const auto found = tokens_.find(token);
  return found != tokens_.end() && now - found->second.used <= idle_ ? &found->second : nullptr;
}

bool KioskTokens::opens(const std::string& token, const std::string& kiosk, TimePoint now) const {
  const Token* known = valid(token, now);
  return known != nullptr && known->kiosk == kiosk;
}

bool KioskTokens::opens_any(const std::string& token, TimePoint now) const {
  return valid(token, now) != nullptr;
}

void KioskTokens::end(const std::string& kiosk) {
  std::erase_if(tokens_, [&](const auto& entry) { return entry.second.kiosk == kiosk; });
  current_.erase(kiosk);
}

void KioskTokens::use(const std::string& token, TimePoint now) {
  if (valid(token, now) != nullptr) tokens_[token].used = now;
}

}  // namespace mechane::gateway
