// Marks for tests that sanitized builds leave to the others. They stand in the test itself, so that they go along when it is renamed.
#pragma once

#include <gtest/gtest.h>

#include "server/base/sanitized.hpp"

/// The first line of a test, or of a fixture's SetUp(). deploy/test knows these tests by this text (results.py), and counts them apart from
/// those that the machine cannot run. The thread sanitizer does run it.
#define MECHANE_NOT_UNDER_ADDRESS_SANITIZER(reason) \
  if constexpr (::mechane::kAddressSanitized) GTEST_SKIP() << "left to other builds: " << (reason)

/// For what no sanitizer can run.
#define MECHANE_NOT_SANITIZED(reason) \
  if constexpr (::mechane::kSanitized) GTEST_SKIP() << "left to other builds: " << (reason)
