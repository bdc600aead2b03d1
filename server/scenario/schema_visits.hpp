// Tables to which those of schema.cpp refer.
#pragma once

#include "server/scenario/schema.hpp"

namespace mechane::scenario {

extern const Table kVisitTable;
extern const Table kMoveTable;

}  // namespace mechane::scenario
