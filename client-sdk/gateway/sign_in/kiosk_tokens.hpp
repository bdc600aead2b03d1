// The secret in a kiosk's address. Whoever has it may steer this kiosk, and only this one, until nobody has used it for a
// while: a code that was photographed in the museum is worth nothing at home. On the loop's thread; time is an argument.
#pragma once

#include <map>
#include <string>

#include "server/base/clock.hpp"

namespace mechane::gateway {

class KioskTokens {
 public:
  /// After this time a kiosk gets another token for new addresses; the old one stays valid while it is used.
  static constexpr Duration kRotates = std::chrono::minutes(10);
  static constexpr std::size_t kMost = 1000;

  explicit KioskTokens(Duration idle) : idle_(idle) {}

  /// For a new address of this kiosk.
  [[nodiscard]] std::string token_for(const std::string& kiosk, TimePoint now);
  /// Whether the token opens this kiosk now.
  [[nodiscard]] bool opens(const std::string& token, const std::string& kiosk, TimePoint now) const;
  /// Whether it opens any: for mesh files.
  [[nodiscard]] bool opens_any(const std::string& token, TimePoint now) const;
  /// None opens this kiosk any more.
  void end(const std::string& kiosk);
  /// Somebody joined or touched with it.
  void use(const std::string& token, TimePoint now);

 private:
  struct Token {
    std::string kiosk;
    TimePoint issued;
    TimePoint used;
  };
  [[nodiscard]] const Token* valid(const std::string& token, TimePoint now) const;
  Duration idle_;
  std::map<std::string, Token> tokens_;
  std::map<std::string, std::string> current_;  ///< by kiosk
};

}  // namespace mechane::gateway
