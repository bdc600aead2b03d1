#include "client-sdk/assets/asset_address.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::assets {
namespace {

std::string address_of(const char* base, const std::string& name) {
  const auto address = AssetAddress::parse(base);
  if (!address) return "no base";
  const auto whole = address->of(name);
  if (!whole && whole.error().remedy.empty()) return "refused without a remedy";
  return whole ? *whole : "refused";
}

/// Why it is not the address of a scenario's folder.
ErrorCode fault_of(const char* base) {
  const auto address = AssetAddress::parse(base);
  EXPECT_FALSE(address.has_value()) << base;
  if (address) return {};
  EXPECT_NE(address.error().remedy, "");
  EXPECT_EQ(address.error().where, base);
  return address.error().code;
}

TEST(AssetAddress, names_are_relative_to_the_scenarios_folder) {
  EXPECT_EQ(address_of("http://museum:8000/a/screw", "audio/turn.el.wav"),
            "http://museum:8000/a/screw/audio/turn.el.wav");
  EXPECT_EQ(address_of("http://museum:8000/a/screw/", "../models/screw.glb"), "http://museum:8000/a/models/screw.glb");
  EXPECT_EQ(address_of("https://museum", "./x.glb"), "https://museum/x.glb");
  EXPECT_EQ(address_of("http://museum/screw", "a/../b.glb"), "http://museum/screw/b.glb");
}

TEST(AssetAddress, names_are_escaped) {
  EXPECT_EQ(address_of("http://m/s", "a b?c#d%2e.glb"), "http://m/s/a%20b%3Fc%23d%252e.glb");
  EXPECT_EQ(address_of("http://m/s", "κοχλίας.glb"), "http://m/s/%CE%BA%CE%BF%CF%87%CE%BB%CE%AF%CE%B1%CF%82.glb");
  EXPECT_EQ(address_of("http://m/s", "..\\..\\x"), "http://m/s/..%5C..%5Cx");
  EXPECT_EQ(address_of("http://m/s", "http:x"), "http://m/s/http%3Ax");
}

TEST(AssetAddress, no_name_leads_higher_than_beside_the_scenario) {
  for (const char* name : {"../../etc/passwd", "a/../../../x", "../..", "..", ".", "", "a/..", "/etc/passwd",
                           "//evil/x", "http://evil/x", "a//b", "a/", "a\nb", "../"}) {
    EXPECT_EQ(address_of("http://m/r/s", name), "refused") << name;
  }
  EXPECT_EQ(address_of("http://m", "../../x.glb"), "refused");
}

TEST(AssetAddress, the_root_of_a_web_server_serves_as_the_scenarios_folder_and_as_the_one_above_it) {
  for (const char* root : {"http://m:8000", "http://m:8000/"}) {
    EXPECT_EQ(address_of(root, "screw.glb"), "http://m:8000/screw.glb");
    EXPECT_EQ(address_of(root, "../models/screw.glb"), "http://m:8000/models/screw.glb");
    EXPECT_EQ(address_of(root, "a/../../models/./screw.glb"), "http://m:8000/models/screw.glb");
    for (const char* name : {"..", ".", "../", "a/..", "../..", "../../x.glb", "../a/../../x.glb"})
      EXPECT_EQ(address_of(root, name), "refused") << name;
  }
}

TEST(AssetAddress, what_is_no_address_is_told) {
  for (const char* base : {"", "ftp://m/s", "m/s", "http://user:word@m/s", "http://m/s?x=1", "http://m/s#x",
                           "http://m/../s", "http://m//s", "http://m/a b", "http://m/\x01", "file:///etc"})
    EXPECT_EQ(fault_of(base), ErrorCode::invalid_value) << base;
  for (const char* no_host : {"http://", "http:///x", "http://:80/x"})
    EXPECT_EQ(fault_of(no_host), ErrorCode::missing) << no_host;
  EXPECT_TRUE(is_web_address("https://m"));
  EXPECT_FALSE(is_web_address("scenarios/http"));
  EXPECT_TRUE(AssetAddress::parse("https://m/s")->secure());
}

RC_GTEST_PROP(AssetAddress, whatever_a_scenario_names_is_refused_or_stays_below_the_root, ()) {
  const auto part =
      rc::gen::oneOf(rc::gen::elementOf(std::vector<std::string>{"..", ".", "", "%2e%2e", "..\\", "a", "http:", "?"}),
                     rc::gen::arbitrary<std::string>());
  std::string name;
  for (const std::string& next : *rc::gen::container<std::vector<std::string>>(part))
    name += next + "/";
  name += *part;
  const bool at_root = *rc::gen::arbitrary<bool>();
  const auto whole = AssetAddress::parse(at_root ? "http://m/" : "http://m/root/scenario")->of(name);
  if (!whole) return;
  RC_ASSERT(whole->starts_with(at_root ? "http://m/" : "http://m/root/"));
  RC_ASSERT((*whole + "/").find("/../") == std::string::npos);
  RC_ASSERT((*whole + "/").find("/./") == std::string::npos);
  RC_ASSERT(whole->find("//", 7) == std::string::npos);
  RC_ASSERT(whole->find_first_of("?#\\@ ") == std::string::npos);
}

}  // namespace
}  // namespace mechane::assets
