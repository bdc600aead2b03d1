#include "server/geometry/pieces/cut_tree.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <utility>

#include "server/base/parallel.hpp"
#include "server/geometry/pieces/cut_search.hpp"

namespace mechane::geometry {
namespace {

/// Shares of the bound: a plan rests on the region's few points, but its pieces are then measured with points of their own. A plan that
/// fails then is made again for a smaller share.
constexpr std::array<double, 3> kFanBounds = {1.0, 0.85, 0.7};
constexpr std::size_t kMostFanPieces = 64;

}  // namespace

CutTree::CutTree(const DecomposeModel& model) : model_(model) {
  branches_.push_back({whole_region(model), {}, false, {}});
  measure(model, branches_.front().region);
}

std::optional<std::size_t> CutTree::worst_leaf(const std::function<void(double)>& heard) const {
  std::optional<std::size_t> worst;
  std::size_t leaves = 0;
  std::size_t done = 0;
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    const Branch& branch = branches_[i];
    if (!branch.children.empty()) continue;
    const bool open = !branch.stuck && branch.region.needs_cut(model_);
    ++leaves;
    done += open ? 0 : 1;
    if (open && (!worst || branch.region.concavity_m > branches_[*worst].region.concavity_m)) worst = i;
  }
  heard(static_cast<double>(done) / static_cast<double>(leaves));
  return worst;
}

void CutTree::grow(std::span<const ConcavePlace> places, std::size_t most_leaves,
                   const std::function<void(double)>& heard) {
  std::size_t most = most_leaves;
  if (most > 1 && branches_.front().region.needs_cut(model_)) {
    seek_fan(0);
    while (branches_.front().fan.plan && !prove_fan(0)) {
    }
    const std::size_t fan = branches_.front().fan.pieces.size();
    if (fan > 0) most = std::min(most, fan + fan / 2 + 4);
  }
  for (std::size_t leaves = 1; leaves < most;) {
    const std::optional<std::size_t> worst = worst_leaf(heard);
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
      branches_.push_back({std::move(*side), {}, false, {}});
    }
    ++leaves;
  }
}

CutTree::Cost CutTree::cost_of(std::size_t branch) const {
  const Branch& b = branches_[branch];
  if (b.children.empty()) return {b.region.concavity_m > model_.bound_m ? 1U : 0U, 1, false};
  Cost sum;
  for (const std::size_t child : b.children) {
    const Cost cost = cost_of(child);
    sum.unmet += cost.unmet;
    sum.leaves += cost.leaves;
  }
  if (b.fan.plan && (sum.unmet > 0 || b.fan.plan->size() < sum.leaves)) return {0, b.fan.plan->size(), true};
  return sum;
}

void CutTree::seek_fan(std::size_t branch) {
  Fan& fan = branches_[branch].fan;
  fan.sought = true;
  fan.plan = find_fan(branches_[branch].region, kFanBounds[fan.bound] * model_.bound_m, kMostFanPieces);
}

bool CutTree::prove_fan(std::size_t branch) {
  Fan& fan = branches_[branch].fan;
  std::vector<PieceRegion> pieces(fan.plan->size(), PieceRegion{{}, PieceSurface(model_.mesh), {}, {}, {}});
  std::atomic<bool> failed{false};
  for_each_index(pieces.size(), [&](std::size_t i) {
    if (failed) return;
    pieces[i] = confined(model_, branches_[branch].region, (*fan.plan)[i]);
    measure(model_, pieces[i]);
    if (pieces[i].needs_cut(model_)) failed = true;
  });
  if (!failed) {
    fan.pieces = std::move(pieces);
    return true;
  }
  fan.plan.reset();
  if (++fan.bound < kFanBounds.size()) seek_fan(branch);
  return false;
}

void CutTree::replace_by_fans() {
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    if (!branches_[i].children.empty() && !branches_[i].fan.sought) seek_fan(i);
  }
  // A plan promises a number of pieces. If a plan that is chosen does not keep it, the choice is made anew.
  for (bool settled = false; !settled;) {
    settled = true;
    std::vector<std::size_t> used{0};
    for (std::size_t k = 0; k < used.size() && settled; ++k) {
      const Branch& branch = branches_[used[k]];
      if (!cost_of(used[k]).by_fan) {
        used.insert(used.end(), branch.children.begin(), branch.children.end());
      } else if (branch.fan.pieces.empty()) {
        settled = prove_fan(used[k]);
      }
    }
  }
  std::vector<std::size_t> used{0};
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (cost_of(used[k]).by_fan) {
      branches_[used[k]].children.clear();
      for (PieceRegion& piece : std::exchange(branches_[used[k]].fan.pieces, {})) {
        branches_[used[k]].children.push_back(branches_.size());
        branches_.push_back({std::move(piece), {}, false, {}});
      }
      continue;
    }
    const std::vector<std::size_t>& children = branches_[used[k]].children;
    used.insert(used.end(), children.begin(), children.end());
  }
  for (Branch& branch : branches_)
    branch.fan.plan.reset();
}

void CutTree::collapse(std::size_t most_leaves) {
  while (cost_of(0).leaves > most_leaves) {
    std::optional<std::size_t> least;
    std::vector<std::size_t> reachable{0};
    for (std::size_t k = 0; k < reachable.size(); ++k) {
      const Branch& branch = branches_[reachable[k]];
      reachable.insert(reachable.end(), branch.children.begin(), branch.children.end());
      const bool over_leaves =
          !branch.children.empty() && std::all_of(branch.children.begin(), branch.children.end(),
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
