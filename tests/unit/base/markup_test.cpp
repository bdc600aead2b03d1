#include "server/base/markup.hpp"

#include <gtest/gtest.h>

namespace mechane {
namespace {

TEST(Markup, APartOfAnAddressHasNoReservedBytes) {
  EXPECT_EQ(escape_percent("a-Z_0.~"), "a-Z_0.~");
  EXPECT_EQ(escape_percent("models/α b?.glb"), "models%2F%CE%B1%20b%3F.glb");
  EXPECT_EQ(escape_percent("/museum/visits 1.db", "/"), "/museum/visits%201.db");
}

}  // namespace
}  // namespace mechane
