#include "client-sdk/display/spare_memory.hpp"

#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>
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

/// That needed no disk, of this process.
long page_faults() {
  ::rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return used.ru_minflt;
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

TEST_F(SpareMemory, images_go_back_by_themselves) {
  hold_sixteenth(256 << 10);
  EXPECT_GT(most_mib_, 60);
  EXPECT_LT(resident_mib() - before_mib_, 25);
}

TEST_F(SpareMemory, a_picture_s_triangles_take_the_pages_of_the_last_picture_s) {
  // As Mesa's software rasteriser does: 8 MiB in blocks of 64 KiB, freed when the picture is done.
  const auto draw = [] {
    std::vector<std::unique_ptr<char[]>> blocks(128);
    for (auto& block : blocks) {
      block = std::make_unique<char[]>(64 << 10);
      std::memset(block.get(), 1, 64 << 10);
    }
  };
  draw();
  const long faults = page_faults();
  for (int picture = 0; picture < 10; ++picture)
    draw();
  EXPECT_LT(page_faults() - faults, 2048) << "of the pages of one picture";
}

}  // namespace
}  // namespace mechane::display
