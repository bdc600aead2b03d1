// Counts repeated warnings: a fault that lasts may send thousands of them a minute.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mechane::log {

/// Lets a text through once in kWindow, and counts it in between. The caller passes the time in. Not thread-safe.
class Repeats {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kWindow{60};
  static constexpr std::size_t kTexts = 64;  ///< how many are remembered; then take_over() gives out the oldest

  struct Counted {
    std::string text;
    int level = 0;              ///< as it was given
    std::uint64_t repeats = 0;  ///< beyond the one that was let through
  };

  /// Whether the text is to be shown. Call take_over() first.
  bool pass(std::string_view text, int level, Time now);
  /// Takes out the texts whose window is over, or for which there is no room any more. Returns those that were repeated.
  [[nodiscard]] std::vector<Counted> take_over(Time now);
  /// All that were repeated, at the end of the program.
  [[nodiscard]] std::vector<Counted> take_all() { return take_over(Time::max()); }

 private:
  struct Entry {
    Counted counted;
    Time shown;
  };
  std::vector<Entry> entries_;  ///< the oldest first
};

}  // namespace mechane::log
