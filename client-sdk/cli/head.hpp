// `mechane head`: tells a kiosk's displays where the visitor's head is. A bridge for any tracker whose program can print lines.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/base/math.hpp"

namespace mechane::cli {

struct HeadOptions {
  std::string kiosk = "kiosk-1";
  std::string display;  ///< empty: all of the kiosk
  std::uint32_t domain = 0;
  std::vector<double> at;  ///< metres, in S; empty: lines are read
  double seconds = 0;      ///< 0: no end
};

/// A line of a tracker: "x y z", "x y z qw qx qy qz" (metres and a unit quaternion in S), or "nobody", which gives no pose.
/// Errors: other words, numbers that are none, a rotation that is none.
[[nodiscard]] Expected<std::optional<Pose>> read_head(const std::string& line);

/// Returns the exit status: 2 where a name or a pose is bad, 1 where the network cannot be joined or a line was wrong (it is told, and the next is
/// read). Until the input ends, or Ctrl-C.
[[nodiscard]] int run_head(const HeadOptions& options, std::istream& in, std::ostream& err);

}  // namespace mechane::cli
