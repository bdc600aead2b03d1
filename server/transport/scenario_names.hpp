// The ids of the scenarios that a kiosk may ask for, which change while the server runs.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mechane::transport {

/// The main thread changes it; command listeners look into it without a lock. A number is never given to another id: a request that is on
/// its way to the main thread means what it meant when it came.
class ScenarioNames {
 public:
  static constexpr std::size_t kMost = 256;  ///< different ids in the life of a server

  /// Main thread: these can be asked for from now on, home first. Further new ids than kMost are left out.
  void set(const std::vector<std::string>& ids) {
    std::uint32_t count = count_.load(std::memory_order_relaxed);
    for (const std::string& id : ids) {
      if (number_of(id, count) || count == kMost) continue;
      names_[count] = id;
      count_.store(++count, std::memory_order_release);
    }
    for (std::uint32_t i = 0; i < count; ++i)
      open_[i].store(std::ranges::find(ids, names_[i]) != ids.end(), std::memory_order_release);
  }
  /// Main thread: whether set() has room for this id.
  [[nodiscard]] bool has_room_for(std::string_view id) const {
    const std::uint32_t count = count_.load(std::memory_order_relaxed);
    return count < kMost || number_of(id, count);
  }
  /// Any thread: the number of an id that can be asked for; an empty one means home.
  [[nodiscard]] std::optional<std::uint32_t> find(std::string_view id) const noexcept {
    const std::uint32_t count = count_.load(std::memory_order_acquire);
    if (count == 0) return std::nullopt;
    const auto number = id.empty() ? std::optional<std::uint32_t>(0) : number_of(id, count);
    return number && open_[*number].load(std::memory_order_acquire) ? number : std::nullopt;
  }
  /// Any thread; of a number that find() gave.
  [[nodiscard]] const std::string& name(std::uint32_t number) const noexcept { return names_[number]; }

 private:
  [[nodiscard]] std::optional<std::uint32_t> number_of(std::string_view id, std::uint32_t count) const noexcept {
    for (std::uint32_t i = 0; i < count; ++i)
      if (names_[i] == id) return i;
    return std::nullopt;
  }

  std::array<std::string, kMost> names_;  // the first count_ never change
  std::array<std::atomic<bool>, kMost> open_{};
  std::atomic<std::uint32_t> count_{0};
};

}  // namespace mechane::transport
