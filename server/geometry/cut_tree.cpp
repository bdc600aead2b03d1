#include "server/geometry/cut_tree.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "server/base/parallel.hpp"
#include "server/geometry/cut_search.hpp"
#include "server/geometry/fan_plan.hpp"

namespace mechane::geometry {
namespace {

/// Of the bound: a plan rests on the region's few points, and its pieces are measured with points of their own; one that then fails
/// is tried again with less to spare.
constexpr std::array<double, 3> kFanBounds = {1.0, 0.85, 0.7};
constexpr std::size_t kMostFanPieces = 64;

}  // namespace

CutTree::CutTree(const DecomposeModel& model) : model_(model) {
  branches_.push_back({whole_region(model), {}, false});
  measure(model, branches_.front().region);
}

void CutTree::grow(std::span<const ConcavePlace> places, std::size_t most_leaves,
                   const std::function<void(double)>& heard) {
  std::size_t leaves = 1;
  while (leaves < most_leaves) {
    std::optional<std::size_t> worst;
    std::size_t done = 0;
    for (std::size_t i = 0; i < branches_.size(); ++i) {
      const Branch& branch = branches_[i];
      if (!branch.children.empty()) continue;
      const bool open = !branch.stuck && branch.region.needs_cut(model_);
      done += open ? 0 : 1;
      if (open && (!worst || branch.region.concavity_m > branches_[*worst].region.concavity_m)) worst = i;
    }
    heard(static_cast<double>(done) / static_cast<double>(leaves));
    if (!worst) return;
    const auto plane = best_cut(model_, branches_[*worst].region, places);
    if (!plane) {
      branches_[*worst].stuck = true;
      continue;
    }
    auto [within, beyond] = divide(model_, branches_[*worst].region, *plane);
    const std::array<PieceRegion*, 2> sides = {&within, &beyond};
    for_each_index(sides.size(), [&](std::size_t i) { measure(model_, *sides[i]); });
    for (PieceRegion* side : sides) {
      branches_[*worst].children.push_back(branches_.size());
      branches_.push_back({std::move(*side), {}, false});
    }
    ++leaves;
  }
}

CutTree::Cost CutTree::cost_of(std::size_t branch) const {
  const Branch& b = branches_[branch];
  if (b.children.empty()) return {b.region.concavity_m > model_.bound_m ? 1U : 0U, 1};
  Cost sum;
  for (const std::size_t child : b.children) {
    const Cost cost = cost_of(child);
    sum.unmet += cost.unmet;
    sum.leaves += cost.leaves;
  }
  return sum;
}

void CutTree::replace_by_fans() {
  replace_below(0);
}

CutTree::Cost CutTree::replace_below(std::size_t branch) {
  const std::vector<std::size_t> children = branches_[branch].children;
  for (const std::size_t child : children)
    replace_below(child);
  Cost cost = cost_of(branch);
  if (!children.empty() && (cost.leaves > 2 || cost.unmet > 0) && replace_one(branch, cost)) cost = cost_of(branch);
  return cost;
}

bool CutTree::replace_one(std::size_t branch, const Cost& now) {
  const std::size_t most = now.unmet > 0 ? kMostFanPieces : now.leaves - 1;
  for (const double share : kFanBounds) {
    const auto plan = find_fan(branches_[branch].region, share * model_.bound_m, most);
    if (!plan) return false;
    std::vector<PieceRegion> pieces(plan->size(), PieceRegion{{}, PieceSurface(model_.mesh), {}, {}, {}});
    for_each_index(pieces.size(), [&](std::size_t i) {
      pieces[i] = confined(model_, branches_[branch].region, (*plan)[i]);
      measure(model_, pieces[i]);
    });
    if (std::any_of(pieces.begin(), pieces.end(), [&](const PieceRegion& p) { return p.needs_cut(model_); })) continue;
    branches_[branch].children.clear();
    for (PieceRegion& piece : pieces) {
      branches_[branch].children.push_back(branches_.size());
      branches_.push_back({std::move(piece), {}, false});
    }
    return true;
  }
  return false;
}

void CutTree::collapse(std::size_t most_leaves) {
  while (cost_of(0).leaves > most_leaves) {
    std::optional<std::size_t> least;
    std::vector<std::size_t> reachable{0};
    for (std::size_t k = 0; k < reachable.size(); ++k) {
      const Branch& branch = branches_[reachable[k]];
      reachable.insert(reachable.end(), branch.children.begin(), branch.children.end());
      const bool over_leaves = !branch.children.empty() &&
                               std::all_of(branch.children.begin(), branch.children.end(),
                                           [&](std::size_t child) { return branches_[child].children.empty(); });
      if (over_leaves && (!least || branch.region.concavity_m < branches_[*least].region.concavity_m)) {
        least = reachable[k];
      }
    }
    branches_[*least].children.clear();
  }
}

std::vector<PieceRegion> CutTree::leaves() const {
  std::vector<PieceRegion> found;
  std::vector<std::size_t> stack{0};
  while (!stack.empty()) {
    const Branch& branch = branches_[stack.back()];
    stack.pop_back();
    if (branch.children.empty()) found.push_back(branch.region);
    stack.insert(stack.end(), branch.children.rbegin(), branch.children.rend());
  }
  return found;
}

}  // namespace mechane::geometry
