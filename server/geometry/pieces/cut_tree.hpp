// The search for pieces: cuts in two, the worst piece first; then plans of many cuts at once in place of branches with more pieces.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "server/geometry/pieces/concave_places.hpp"
#include "server/geometry/pieces/fan_plan.hpp"
#include "server/geometry/pieces/piece_region.hpp"

namespace mechane::geometry {

class CutTree {
 public:
  /// `model` must outlive the tree.
  explicit CutTree(const DecomposeModel& model);

  /// Cuts until every leaf is within the bound, or no leaf can be cut further, or there are `most_leaves`, or many more than a plan for
  /// the whole would need. `heard` gets the share of leaves that are done.
  void grow(std::span<const ConcavePlace> places, std::size_t most_leaves, const std::function<void(double)>& heard);

  /// Replaces branches by slices or sectors of their roots where that makes fewer pieces in all.
  void replace_by_fans();

  /// Takes back cuts, those that gained least first, until there are at most `most_leaves`.
  void collapse(std::size_t most_leaves);

  /// The pieces, neighbours in the tree side by side.
  [[nodiscard]] std::vector<PieceRegion> leaves() const;

 private:
  /// Slices or sectors of a branch: a plan, and its pieces once they have been checked against the bound.
  struct Fan {
    std::optional<FanPlan> plan;
    std::size_t bound = 0;  ///< which of the bounds it was made for
    bool sought = false;
    std::vector<PieceRegion> pieces;  ///< empty until they have been measured and found good
  };
  struct Branch {
    PieceRegion region;
    std::vector<std::size_t> children;
    bool stuck = false;  ///< no plane parts it
    Fan fan;
  };
  struct Cost {
    std::size_t unmet = 0;
    std::size_t leaves = 0;
    bool by_fan = false;
  };
  [[nodiscard]] Cost cost_of(std::size_t branch) const;
  void seek_fan(std::size_t branch);
  bool prove_fan(std::size_t branch);
  [[nodiscard]] std::optional<std::size_t> worst_leaf(const std::function<void(double)>& heard) const;

  const DecomposeModel& model_;
  std::vector<Branch> branches_;
};

}  // namespace mechane::geometry
