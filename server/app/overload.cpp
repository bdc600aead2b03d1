#include "server/app/overload.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace mechane::app {
namespace {

constexpr Duration kSayAgainAfter = std::chrono::minutes(1);

}  // namespace

bool OverloadWatch::look(const LoadCounts& counts, TimePoint now) {
  longest_gap_ = std::max(longest_gap_, counts.longest_gap);
  if (!begin_) {
    begin_ = counts;
    began_ = now;
    return false;
  }
  if (now - began_ < kWindow) return false;
  const Cause cause = judge(counts, std::exchange(longest_gap_, Duration{0}));
  begin_ = counts;
  began_ = now;
  const bool told = cause == std::exchange(cause_, cause) && (cause == Cause::none || now - told_ < kSayAgainAfter);
  if (!told) told_ = now;
  return !told;
}

OverloadWatch::Cause OverloadWatch::judge(const LoadCounts& counts, Duration longest_gap) {
  const std::uint64_t ticks = counts.ticks - begin_->ticks;
  const std::uint64_t overruns = counts.overruns - begin_->overruns;
  const std::uint64_t held_up = counts.held_up - begin_->held_up;
  const std::uint64_t gaps = counts.input_gaps - begin_->input_gaps;
  const auto tolerated = static_cast<std::uint64_t>(kTolerated * static_cast<double>(ticks));
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(kWindow).count();
  if (overruns > tolerated) {
    words_ = fmt::format(
        "overload: in the last {} s {} of {} ticks needed more than their millisecond, so forces come late. Run fewer "
        "worlds on this "
        "machine (--worlds), or share them among more processor cores (--loop-threads)",
        seconds, overruns, ticks);
    return Cause::worlds;
  }
  if (held_up > tolerated) {
    words_ = fmt::format(
        "overload: in the last {} s {} of {} ticks had to wait for a processor, so forces come late. Stop other "
        "programs on this "
        "machine, or give the server real-time rights: see mechane doctor",
        seconds, held_up, ticks + held_up);
    return Cause::machine;
  }
  if (gaps > kToleratedGaps) {
    words_ = fmt::format(
        "hands arrive late: in the last {} s {} gaps of more than 10 ms, the longest {} ms, and forces fade meanwhile. "
        "Look at the load of "
        "the kiosks' machines and at the network",
        seconds, gaps, std::chrono::duration_cast<std::chrono::milliseconds>(longest_gap).count());
    return Cause::inputs;
  }
  words_.clear();
  return Cause::none;
}

}  // namespace mechane::app
