#include "server/app/overload.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace mechane::app {
namespace {

constexpr Duration kLogAgainAfter = std::chrono::minutes(1);

}  // namespace

bool OverloadWatch::look(const LoadCounts& counts, TimePoint now) {
  gap_so_far_ = std::max(gap_so_far_, counts.longest_gap);
  if (!begin_) {
    begin_ = counts;
    began_ = now;
    return false;
  }
  if (now - began_ < kWindow) return false;
  longest_gap_ = std::exchange(gap_so_far_, Duration{0});
  const Cause before = std::exchange(cause_, judge(counts));
  begin_ = counts;
  began_ = now;
  if (cause_ == before && (cause_ == Cause::none || now - logged_ < kLogAgainAfter)) return false;
  logged_ = now;
  return true;
}

OverloadWatch::Cause OverloadWatch::judge(const LoadCounts& counts) {
  const std::uint64_t ticks = counts.ticks - begin_->ticks;
  const std::uint64_t overruns = counts.overruns - begin_->overruns;
  const std::uint64_t held_up = counts.held_up - begin_->held_up;
  const std::uint64_t gaps = counts.input_gaps - begin_->input_gaps;
  const auto tolerated = static_cast<std::uint64_t>(kTolerated * static_cast<double>(ticks));
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(kWindow).count();
  if (overruns > tolerated) {
    words_ = fmt::format(
        "overload: in the last {} s {} of {} ticks needed more than 1 ms of processor time, so forces came late. Run "
        "fewer worlds on this machine (--worlds), or spread them over more processor cores (--loop-threads)",
        seconds, overruns, ticks);
    return Cause::worlds;
  }
  if (held_up > tolerated) {
    words_ = fmt::format(
        "overload: in the last {} s {} of {} ticks had to wait for a processor, so forces came late. Stop other "
        "programs on this machine, run fewer worlds (--worlds), or give the server real-time rights: see mechane "
        "doctor",
        seconds, held_up, ticks + held_up);
    return Cause::machine;
  }
  if (gaps > kToleratedGaps) {
    words_ = fmt::format(
        "samples of hands come late: in the last {} s there were {} pauses of more than 10 ms, the longest {} ms; "
        "forces "
        "fade during them. Check the load of the kiosks' machines, and the network",
        seconds, gaps, std::chrono::duration_cast<std::chrono::milliseconds>(longest_gap_).count());
    return Cause::inputs;
  }
  words_.clear();
  return Cause::none;
}

}  // namespace mechane::app
