// The search for pieces: cuts in two, the worst piece first; then plans of many cuts at once in place of branches with more pieces.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "server/geometry/concave_places.hpp"
#include "server/geometry/piece_region.hpp"

namespace mechane::geometry {

class CutTree {
 public:
  /// `model` must outlive the tree.
  explicit CutTree(const DecomposeModel& model);

  /// Cuts until every leaf is within the bound, or none can be cut further, or there are `most_leaves`. `heard` gets the share of
  /// leaves that are done.
  void grow(std::span<const ConcavePlace> places, std::size_t most_leaves, const std::function<void(double)>& heard);

  /// Replaces a branch by slices or sectors of its root where these are fewer pieces than its leaves.
  void replace_by_fans();

  /// Takes back cuts, those that did least first, until there are at most `most_leaves`.
  void collapse(std::size_t most_leaves);

  /// The pieces, neighbours in the tree side by side.
  [[nodiscard]] std::vector<PieceRegion> leaves() const;

 private:
  struct Branch {
    PieceRegion region;
    std::vector<std::size_t> children;
    bool stuck = false;  // no plane parts it
  };
  struct Cost {
    std::size_t unmet = 0;
    std::size_t leaves = 0;
  };
  [[nodiscard]] Cost cost_of(std::size_t branch) const;
  Cost replace_below(std::size_t branch);
  bool replace_one(std::size_t branch, const Cost& now);

  const DecomposeModel& model_;
  std::vector<Branch> branches_;
};

}  // namespace mechane::geometry
