// The output of `mechane displays`: a table, remarks for the technician, JSON.
#pragma once

#include <string>
#include <vector>

#include "server/base/error.hpp"
#include <mechane/client/displays.hpp>

namespace mechane::cli {

/// The faults of one display, and what to do; empty: all is well.
[[nodiscard]] std::vector<std::string> remarks_of(const client::DisplayStatus& display);

/// Whether a display has these names of kiosk and display; empty names match any.
[[nodiscard]] bool is_meant(const client::DisplayStatus& display, const std::string& kiosk, const std::string& name);

/// The error when none of `all` has these names of kiosk and display (empty: any).
[[nodiscard]] Error no_display(const std::vector<client::DisplayStatus>& all, const std::string& kiosk,
                               const std::string& display);

/// One line per display, then the remarks.
[[nodiscard]] std::string displays_table(const std::vector<client::DisplayStatus>& displays);

/// One JSON object per display, each on a line of its own, with its remarks. Numbers are rounded to the wire's
/// precision.
[[nodiscard]] std::string displays_json(const std::vector<client::DisplayStatus>& displays);

}  // namespace mechane::cli
