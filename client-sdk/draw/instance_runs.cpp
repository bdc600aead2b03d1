#include "client-sdk/draw/instance_runs.hpp"

#include <map>
#include <tuple>

namespace mechane::draw {

std::vector<InstanceRun> runs_of(const std::vector<picture::Instance>& instances,
                                 const std::vector<ShownPieces>& shown) {
  std::vector<InstanceRun> out;
  std::map<std::tuple<float, std::uint32_t, std::uint32_t, std::vector<std::uint32_t>>, std::size_t> begun;
  for (const ShownPieces& one : shown) {
    const picture::Instance& instance = instances[one.instance];
    const auto [run, is_new] = begun.try_emplace({one.order, instance.mesh, instance.material, one.pieces}, out.size());
    if (is_new) out.push_back({instance.mesh, instance.material, one.pieces, {}});
    out[run->second].X_WM.push_back(instance.X_WM);
  }
  return out;
}

}  // namespace mechane::draw
