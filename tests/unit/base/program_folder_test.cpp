#include "server/base/program_folder.hpp"

#include <gtest/gtest.h>

namespace mechane {
namespace {

TEST(ProgramFolder, HasThisProgram) {
  EXPECT_TRUE(program_folder().is_absolute());
  EXPECT_TRUE(std::filesystem::exists(program_folder() / "test_unit_base"));
}

}  // namespace
}  // namespace mechane
