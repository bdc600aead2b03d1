// Finds a visit in the journals: which one it is in, and from which tick to which.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/state/description.hpp"
#include "server/visits/visit_record.hpp"

namespace mechane::app {

struct VisitTicks {
  std::filesystem::path journal;
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

/// A step that began, as a journal tells of it.
struct BegunStep {
  std::string name;
  std::uint64_t tick = 0;
};

/// When the visit began, by its steps: the tick for which most of `begun` are where the record says, among those from `earliest` to
/// `latest`; in doubt the earlier one. None of them: `expected`. Ticks are milliseconds.
[[nodiscard]] std::uint64_t beginning_of(const visits::VisitRecord& visit, const std::vector<BegunStep>& begun,
                                         std::uint64_t earliest, std::uint64_t latest, std::uint64_t expected);

/// A record tells the minute only, for it must not tell who the visitor was; to the tick, a visit is found by its steps. Reads the heads of
/// all journals of the folder, and one journal whole. Errors: not_found (its journal was deleted, or never written), io_failure.
[[nodiscard]] Expected<VisitTicks> find_visit(const std::filesystem::path& records, const visits::VisitRecord& visit,
                                              const state::WorldDescription& description);

}  // namespace mechane::app
