#include "client-sdk/display/spare_memory.hpp"

#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "server/base/sanitized.hpp"

namespace mechane::display {
namespace {

/// Of this process.
double resident_mib() {
  std::ifstream file("/proc/self/statm");
  double size = 0, resident = 0;
  file >> size >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

TEST(SpareMemory, WhatLiesBetweenThingsThatStayGoesBack) {
#ifndef __GLIBC__
  GTEST_SKIP() << "another allocator";
#endif
  if (kSanitized) GTEST_SKIP() << "the sanitizer's allocator";
  constexpr std::size_t kBlock = 64 << 10;
  constexpr std::size_t kBlocks = 1600;  // 100 MiB
  std::vector<std::unique_ptr<char[]>> blocks;
  const double before = resident_mib();
  for (std::size_t i = 0; i < kBlocks; ++i) {
    blocks.push_back(std::make_unique<char[]>(kBlock));
    std::memset(blocks.back().get(), 1, kBlock);
  }
  // One in sixteen stays, the last among them, so that the heap's end cannot simply come down.
  for (std::size_t i = 0; i < kBlocks; ++i)
    if (i % 16 != 15) blocks[i].reset();
  const double held = resident_mib();
  EXPECT_GT(held - before, 60) << "else there is nothing to give back";
  give_spare_memory_back();
  EXPECT_LT(resident_mib() - before, 25);
}

}  // namespace
}  // namespace mechane::display
