// The options of a device: "port=/dev/ttyUSB0,baud=115200".
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <mechane/driver.h>

namespace mechane::drivers {

static_assert(MECHANE_HAND_RIGHT == 0 && MECHANE_HAND_LEFT == 1);

/// Of a mechane_hand_side, for people.
[[nodiscard]] constexpr const char* name_of_side(std::uint32_t side) noexcept {
  return side == MECHANE_HAND_LEFT ? "left" : "right";
}

/// Reads options by name. The first fault stays until it is asked for: a malformed list, a value that is not a number or
/// out of its range, and a name that was given and that the driver does not know. One thread.
class Options {
 public:
  /// `known` names what the driver understands, as people read it: "port=FILE hand=left|right|none". Its names count.
  Options(std::string_view text, std::string_view known);

  [[nodiscard]] std::string text(const std::string& name, const std::string& otherwise);
  [[nodiscard]] double number(const std::string& name, double otherwise, double least, double most);
  /// One of `choices`, by its index; the first is what holds without the option.
  [[nodiscard]] std::size_t choice(const std::string& name, const std::vector<std::string>& choices);

  /// The option hand=right|left: a mechane_hand_side.
  [[nodiscard]] std::uint32_t hand_side() { return static_cast<std::uint32_t>(choice("hand", {"right", "left"})); }

  /// In words for a person; empty when there is none.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

 private:
  void note(std::string fault);

  std::map<std::string, std::string, std::less<>> values_;
  std::string fault_;
};

}  // namespace mechane::drivers
