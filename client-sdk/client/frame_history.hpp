// FrameHistory: the last frames of a world, and the scene at any moment between them.
#pragma once

#include <deque>

#include <mechane/client/types.hpp>

namespace mechane::client {

/// Estimates the offset between the sender's clock and ours from pairs of (sent, received). It is the smallest delay
/// seen; it rises slowly, to follow a drift of the clocks, and starts again after a jump. Jitter of the network has no
/// effect.
class ClockOffset {
 public:
  /// The moment of sending, on our clock plus the smallest delay.
  [[nodiscard]] TimePoint to_local(std::uint64_t sent_ns, TimePoint received);

 private:
  bool known_ = false;
  std::int64_t offset_ns_ = 0;
};

/// The scene at share `t` of the way from `a` (0) to `b` (1), beyond 1 extrapolated: positions and quantities linear,
/// rotations by slerp along the shorter arc. Everything else, and what is not in both, is taken from b. Pure.
void interpolate(const Frame& a, const Frame& b, double t, Frame& out);

/// One thread at a time.
class FrameHistory {
 public:
  static constexpr std::size_t kFrames = 32;
  static constexpr Duration kExtrapolateAtMost = std::chrono::milliseconds(50);

  /// Frames out of order are dropped.
  void add(const Frame& frame, std::uint64_t sent_ns);
  void clear();
  /// The scene at `at`, interpolated. Before the first known frame: the first frame; after the last: extrapolated by at
  /// most 50 ms. False when no frame is known.
  [[nodiscard]] bool at(TimePoint at, Frame& out) const;

 private:
  struct Entry {
    TimePoint time;
    Frame frame;
  };
  ClockOffset offset_;
  std::deque<Entry> frames_;
};

}  // namespace mechane::client
