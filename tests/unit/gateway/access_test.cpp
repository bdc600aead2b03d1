// Passwords, accounts, sessions, tokens, limits, the audit log.
#include <fstream>

#include <gtest/gtest.h>

#include "client-sdk/gateway/http/certificate.hpp"
#include "client-sdk/gateway/http/rate_limit.hpp"
#include "client-sdk/gateway/sign_in/accounts.hpp"
#include "client-sdk/gateway/sign_in/audit_log.hpp"
#include "client-sdk/gateway/sign_in/kiosk_tokens.hpp"
#include "client-sdk/gateway/sign_in/secrets.hpp"
#include "client-sdk/gateway/sign_in/sessions.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::gateway {
namespace {

using namespace std::chrono_literals;

const TimePoint kBegan{1000h};

TEST(Secrets, AreDifferentAndNeedNoEscape) {
  ASSERT_TRUE(start_secrets());
  const std::string one = random_secret(18), other = random_secret(18);
  EXPECT_EQ(one.size(), 24U);
  EXPECT_NE(one, other);
  EXPECT_EQ(one.find_first_of("+/=\n") + 1, 0U);
  EXPECT_TRUE(same_secret(one, one));
  EXPECT_FALSE(same_secret(one, other));
  EXPECT_FALSE(same_secret("", "")) << "nothing is no secret";
}

TEST(AccountsFile, TellsTheFirstPasswordOnce) {
  ASSERT_TRUE(start_secrets());
  const test::ScratchFolder folder;
  auto first = Accounts::open(folder.path());
  ASSERT_TRUE(first);
  const Account* account = first->find("operator");
  ASSERT_NE(account, nullptr);
  EXPECT_EQ(account->role, Role::manager);
  EXPECT_TRUE(is_password(account->password_hash, first->first_password()));
  EXPECT_FALSE(is_password(account->password_hash, first->first_password() + "x"));
  EXPECT_EQ(account->password_hash.rfind("$argon2id$", 0), 0U);
  EXPECT_FALSE(is_password("no hash", ""));

  ASSERT_TRUE(first->put("eva", {Role::author, "hash"}));
  auto again = Accounts::open(folder.path());
  ASSERT_TRUE(again);
  EXPECT_EQ(again->first_password(), "");
  EXPECT_EQ(again->find("eva")->role, Role::author);
  EXPECT_EQ(again->put("Eva!", {Role::author, "hash"}).error().code, ErrorCode::invalid_value);
  EXPECT_EQ(again->remove("nobody").error().code, ErrorCode::not_found);
  EXPECT_EQ(again->remove("operator").error().code, ErrorCode::conflict) << "the last operator stays";
  const auto rights = std::filesystem::status(folder.path() / "accounts.json").permissions();
  EXPECT_EQ(rights, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(AccountsFile, WhatIsDamagedIsNotTakenForNone) {
  const test::ScratchFolder folder;
  std::ofstream(folder.path() / "accounts.json") << R"({"accounts":[{"user":"operator"}]})";
  EXPECT_EQ(Accounts::open(folder.path()).error().code, ErrorCode::damaged);
}

TEST(SessionsInMemory, EndWhenIdleAndAfterADay) {
  ASSERT_TRUE(start_secrets());
  Sessions sessions;
  const std::string manager = sessions.begin("operator", Role::manager, kBegan);
  const std::string visitor = sessions.begin("tablet", Role::visitor, kBegan);
  EXPECT_EQ(sessions.find("", kBegan), nullptr);
  TimePoint now = kBegan;
  for (; now < kBegan + Sessions::kLongest; now += 1h)
    ASSERT_NE(sessions.find(manager, now), nullptr);
  EXPECT_EQ(sessions.find(manager, now + 1h), nullptr) << "in use, but for a day";
  EXPECT_NE(sessions.find(visitor, kBegan + 24h * 29), nullptr);
  EXPECT_EQ(sessions.find(visitor, kBegan + 24h * 60), nullptr);
  const std::string idle = sessions.begin("operator", Role::manager, kBegan);
  EXPECT_EQ(sessions.find(idle, kBegan + Sessions::kIdle + 1s), nullptr);
}

TEST(SessionsInMemory, EndWithTheirUser) {
  ASSERT_TRUE(start_secrets());
  Sessions sessions;
  const std::string one = sessions.begin("eva", Role::author, kBegan),
                    other = sessions.begin("tom", Role::author, kBegan);
  EXPECT_NE(sessions.find(one, kBegan)->csrf, sessions.find(other, kBegan)->csrf);
  sessions.end_of("eva");
  EXPECT_EQ(sessions.find(one, kBegan), nullptr);
  EXPECT_NE(sessions.find(other, kBegan), nullptr);
}

TEST(SessionCookie, IsFoundAmongOthers) {
  EXPECT_EQ(session_cookie("a=b; mechane_session=xyz; c=d"), "xyz");
  EXPECT_EQ(session_cookie("xmechane_session=xyz"), "");
  EXPECT_EQ(session_cookie(""), "");
  EXPECT_NE(set_session_cookie("xyz", true).find("; Secure"), std::string::npos);
  EXPECT_EQ(set_session_cookie("xyz", false).find("Secure"), std::string::npos);
}

TEST(SignIns, AreSlowedDownAfterFiveFailures) {
  SignInGuard guard;
  for (int k = 0; k < 5; ++k) {
    EXPECT_FALSE(guard.wait_of("eva", kBegan));
    guard.failed("eva", kBegan);
  }
  EXPECT_EQ(guard.wait_of("eva", kBegan), Duration(1s));
  EXPECT_FALSE(guard.wait_of("tom", kBegan));
  EXPECT_FALSE(guard.wait_of("eva", kBegan + 1s));
  for (int k = 0; k < 20; ++k)
    guard.failed("eva", kBegan);
  EXPECT_EQ(guard.wait_of("eva", kBegan), Duration(5min));
  guard.succeeded("eva");
  EXPECT_FALSE(guard.wait_of("eva", kBegan));
}

TEST(KioskTokensInUse, OpenOneKioskUntilTheyAreIdle) {
  ASSERT_TRUE(start_secrets());
  KioskTokens tokens(30min);
  const std::string token = tokens.token_for("kiosk-1", kBegan);
  EXPECT_TRUE(tokens.opens(token, "kiosk-1", kBegan));
  EXPECT_FALSE(tokens.opens(token, "kiosk-2", kBegan));
  EXPECT_FALSE(tokens.opens("", "kiosk-1", kBegan));
  tokens.use(token, kBegan + 29min);
  EXPECT_TRUE(tokens.opens_any(token, kBegan + 58min));
  EXPECT_FALSE(tokens.opens(token, "kiosk-1", kBegan + 60min));
  tokens.use(token, kBegan + 60min);
  EXPECT_FALSE(tokens.opens(token, "kiosk-1", kBegan + 60min)) << "what has ended does not come back";
}

TEST(KioskTokensInUse, Rotate) {
  ASSERT_TRUE(start_secrets());
  KioskTokens tokens(30min);
  const std::string first = tokens.token_for("kiosk-1", kBegan);
  EXPECT_EQ(tokens.token_for("kiosk-1", kBegan + 9min), first);
  const std::string second = tokens.token_for("kiosk-1", kBegan + 11min);
  EXPECT_NE(second, first);
  EXPECT_TRUE(tokens.opens(first, "kiosk-1", kBegan + 11min)) << "who is there stays";
}

TEST(KioskTokensInUse, EndForOneKiosk) {
  ASSERT_TRUE(start_secrets());
  KioskTokens tokens(30min);
  const std::string ended = tokens.token_for("studio-mine", kBegan), other = tokens.token_for("kiosk-1", kBegan);
  tokens.end("studio-mine");
  EXPECT_FALSE(tokens.opens_any(ended, kBegan));
  EXPECT_TRUE(tokens.opens(other, "kiosk-1", kBegan));
  EXPECT_NE(tokens.token_for("studio-mine", kBegan), ended);
}

TEST(RateLimitOfAnAddress, FillsSteadily) {
  RateLimits limits(2, 3);
  for (int k = 0; k < 3; ++k)
    EXPECT_TRUE(limits.take("a", kBegan));
  EXPECT_FALSE(limits.take("a", kBegan));
  EXPECT_TRUE(limits.take("b", kBegan));
  EXPECT_TRUE(limits.take("a", kBegan + 1s));
  EXPECT_TRUE(limits.take("a", kBegan + 1s));
  EXPECT_FALSE(limits.take("a", kBegan + 1s));
}

TEST(AuditLogFiles, AreAppendedToAndRotated) {
  const test::ScratchFolder folder;
  AuditLog log(folder.path());
  ASSERT_TRUE(log.add("eva", "10.0.0.1", "open", "line\nbreak"));
  const std::string long_detail(1U << 19U, 'x');
  ASSERT_TRUE(log.add("eva", "10.0.0.1", "settings", long_detail));
  ASSERT_TRUE(log.add("eva", "10.0.0.1", "settings", long_detail));
  ASSERT_TRUE(log.add("tom", "10.0.0.2", "picture", ""));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "audit.log.1"));
  std::ofstream(log.file(), std::ios::app) << "no entry\n";
  const auto entries = newest_entries(log.file(), 10);
  ASSERT_EQ(entries.size(), 4U);
  EXPECT_EQ(entries[0].user, "tom");
  EXPECT_EQ(entries[3].detail, "line\nbreak");
  EXPECT_EQ(newest_entries(log.file(), 1).size(), 1U);
  EXPECT_FALSE(AuditLog(folder.path() / "nowhere").add("eva", "", "open", ""));
}

TEST(OwnCertificate, IsMadeOnceAndKept) {
  const test::ScratchFolder folder;
  const auto first = own_certificate(folder.path(), {"museum"}, own_addresses());
  ASSERT_TRUE(first) << first.error().to_string();
  EXPECT_TRUE(first->made);
  const auto rights = std::filesystem::status(first->key).permissions();
  EXPECT_EQ(rights, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  const auto again = own_certificate(folder.path(), {"museum"}, own_addresses());
  ASSERT_TRUE(again);
  EXPECT_FALSE(again->made);
  std::ofstream(first->certificate) << "damaged";
  EXPECT_TRUE(own_certificate(folder.path(), {"museum"}, own_addresses())->made);
}

}  // namespace
}  // namespace mechane::gateway
