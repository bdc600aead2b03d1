#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/scratch_folder.hpp"
#include <mechane/proto/exhibit_key.hpp>
#include <mechane/proto/names.hpp>

namespace mechane::proto {
namespace {

namespace fs = std::filesystem;

class ExhibitKeyTest : public testing::Test {
 protected:
  const test::ScratchFolder scratch_;
  const fs::path folder_ = scratch_.path();
  fs::path file_ = folder_ / "records" / "exhibits.key";

  static ExhibitRequest request() {
    ExhibitRequest wire{};
    set_text(wire.server, "server-1");
    wire.incarnation = 7;
    wire.counter = 3;
    wire.id = 99;
    wire.verb = mechane_exhibit_replace;
    set_text(wire.exhibit, "odometer");
    return wire;
  }
};

TEST_F(ExhibitKeyTest, IsMadeForItsUserAloneAndStays) {
  const auto made = ExhibitKey::read_or_make(file_);
  ASSERT_TRUE(made) << made.error().to_string();
  struct stat facts {};
  ASSERT_EQ(::stat(file_.c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777U, 0600U);
  EXPECT_EQ(ExhibitKey::read_or_make(file_)->mark(), made->mark());
  EXPECT_NE(ExhibitKey::read_or_make(folder_ / "other.key")->mark(), made->mark());
}

TEST_F(ExhibitKeyTest, RefusesAFileThatOthersReadOrThatIsNoKey) {
  ASSERT_TRUE(ExhibitKey::read_or_make(file_));
  fs::permissions(file_, fs::perms::group_read, fs::perm_options::add);
  EXPECT_EQ(ExhibitKey::read(file_).error().code, ErrorCode::conflict);
  fs::permissions(file_, fs::perms::owner_read | fs::perms::owner_write);
  for (const char* text : {"", "00ff", "not a key"}) {
    std::ofstream(file_) << text;
    EXPECT_EQ(ExhibitKey::read(file_).error().code, ErrorCode::damaged) << text;
    EXPECT_FALSE(ExhibitKey::read(file_).error().remedy.empty());
  }
  EXPECT_EQ(ExhibitKey::read(folder_ / "none.key").error().code, ErrorCode::not_found);
}

TEST_F(ExhibitKeyTest, ASealFitsItsRequestAndNoOther) {
  const auto key = ExhibitKey::read_or_make(file_);
  ASSERT_TRUE(key);
  ExhibitRequest wire = request();
  EXPECT_FALSE(key->fits(wire)) << "not sealed yet";
  key->seal(wire);
  EXPECT_TRUE(key->fits(wire));
  const auto changed = [&](auto change) {
    ExhibitRequest other = wire;
    change(other);
    return key->fits(other);
  };
  EXPECT_FALSE(changed([](auto& w) { set_text(w.server, "server-2"); }));
  EXPECT_FALSE(changed([](auto& w) { ++w.incarnation; }));
  EXPECT_FALSE(changed([](auto& w) { ++w.counter; }));
  EXPECT_FALSE(changed([](auto& w) { ++w.id; }));
  EXPECT_FALSE(changed([](auto& w) { w.verb = mechane_exhibit_retire; }));
  EXPECT_FALSE(changed([](auto& w) { set_text(w.exhibit, "village"); }));
  EXPECT_FALSE(changed([](auto& w) { w.now = true; }));
  EXPECT_FALSE(changed([](auto& w) { w.seal[31] ^= 1; }));
  EXPECT_FALSE(ExhibitKey::read_or_make(folder_ / "other.key")->fits(wire));
}

TEST(ExhibitName, IsNeverAPath) {
  EXPECT_TRUE(is_exhibit_name("ktesibios-pump_2"));
  for (const std::string name : {"", "..", "../odometer", "a/b", "a.x3d", "a b", "a*"})
    EXPECT_FALSE(is_exhibit_name(name)) << name;
  EXPECT_TRUE(is_exhibit_name(std::string(63, 'a')));
  EXPECT_FALSE(is_exhibit_name(std::string(64, 'a')));
}

}  // namespace
}  // namespace mechane::proto
