// What the shelf refuses, and why.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client-sdk/studio/draft/draft_files.hpp"
#include "server/base/error.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::studio {

/// Why a request came to nothing.
struct ShelfFault {
  Error error;
  bool stale = false;                      ///< the draft has another revision than the one that the request is for
  std::optional<std::int64_t> revision{};  ///< of the draft, where `stale`
  std::optional<std::size_t> command{};    ///< that was refused
  std::vector<x3d::Problem> problems{};    ///< that keep it from being published or shown
  std::vector<FileUse> uses{};             ///< that keep a file from being deleted
};
/// As one JSON object: what is wrong, what to do, and where, as far as it is known.
[[nodiscard]] std::string fault_json(const ShelfFault& fault);

template <class T>
using ShelfResult = tl::expected<T, ShelfFault>;

}  // namespace mechane::studio
