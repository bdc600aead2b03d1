#include "client-sdk/display/spare_memory.hpp"

#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include "tests/support/sanitizers.hpp"

namespace mechane::display {
namespace {

/// Of this process.
double resident_mib() {
  std::ifstream file("/proc/self/statm");
  double size = 0, resident = 0;
  file >> size >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// As a display's from its start on: what is tested here is set for the whole process.
class SpareMemory : public testing::Test {
 protected:
  void SetUp() override {
#ifndef __GLIBC__
    GTEST_SKIP() << "another allocator";
#endif
    MECHANE_NOT_SANITIZED("the sanitizer's allocator");
    keep_large_blocks_apart();
    before_mib_ = resident_mib();
  }

  /// 100 MiB in blocks of this size, of which one in sixteen stays, the last among them, so that a heap's end cannot simply come down.
  void hold_sixteenth(std::size_t block) {
    const std::size_t count = (100 << 20) / block / 16 * 16;
    for (std::size_t i = 0; i < count; ++i) {
      blocks_.push_back(std::make_unique<char[]>(block));
      std::memset(blocks_.back().get(), 1, block);
    }
    most_mib_ = resident_mib() - before_mib_;
    for (std::size_t i = 0; i < count; ++i)
      if (i % 16 != 15) blocks_[i].reset();
  }

  /// What earlier tests left free in the heap takes such blocks first.
  void fill_holes(std::size_t block) {
    for (std::size_t apart = mallinfo2().hblks; mallinfo2().hblks == apart;) {
      fillings_.push_back(std::make_unique<char[]>(block));
      std::memset(fillings_.back().get(), 1, block);
    }
    before_mib_ = resident_mib();
  }

  std::vector<std::unique_ptr<char[]>> fillings_;
  std::vector<std::unique_ptr<char[]>> blocks_;
  double before_mib_ = 0;
  double most_mib_ = 0;
};

TEST_F(SpareMemory, what_lies_between_things_that_stay_goes_back) {
  hold_sixteenth(32 << 10);
  EXPECT_GT(resident_mib() - before_mib_, 60) << "else there is nothing to give back";
  give_spare_memory_back();
  EXPECT_LT(resident_mib() - before_mib_, 25);
}

TEST_F(SpareMemory, a_picture_s_triangles_go_back_by_themselves) {
  fill_holes(64 << 10);
  hold_sixteenth(64 << 10);
  EXPECT_GT(most_mib_, 60);
  EXPECT_LT(resident_mib() - before_mib_, 25);
}

}  // namespace
}  // namespace mechane::display
