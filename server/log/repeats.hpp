// Equal warnings, which a fault that stays may send some thousand times a minute.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mechane::log {

/// Lets a text through once in kWindow, and counts it in between. Pure: the caller brings the time. Not thread-safe.
class Repeats {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kWindow{60};
  static constexpr std::size_t kTexts = 64;  ///< remembered at most; the oldest goes, and its count is told

  struct Counted {
    std::string text;
    int level = 0;              ///< as it was given
    std::uint64_t repeats = 0;  ///< beyond the one that was let through
  };

  /// Whether the text is to be shown. Call take_over() first.
  bool pass(std::string_view text, int level, Time now);
  /// Texts whose window is over, or for which there is no more room, and that came again in it. They are forgotten.
  [[nodiscard]] std::vector<Counted> take_over(Time now);
  /// All that came again, at the end of the program.
  [[nodiscard]] std::vector<Counted> take_all() { return take_over(Time::max()); }

 private:
  struct Entry {
    Counted counted;
    Time shown;
  };
  std::vector<Entry> entries_;  ///< the oldest first
};

}  // namespace mechane::log
