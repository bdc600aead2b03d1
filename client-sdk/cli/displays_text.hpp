// What `mechane displays` prints: a table, what a technician should look at, JSON.
#pragma once

#include <string>
#include <vector>

#include "server/base/error.hpp"
#include <mechane/client/displays.hpp>

namespace mechane::cli {

/// What is not as it should be with one display, and what to do; empty: all is well.
[[nodiscard]] std::vector<std::string> remarks_of(const client::DisplayStatus& display);

/// This kiosk's, and this display of it; empty names mean any.
[[nodiscard]] bool is_meant(const client::DisplayStatus& display, const std::string& kiosk, const std::string& name);

/// Why no display is meant by this kiosk's name and this display's (empty: any), where `all` live.
[[nodiscard]] Error no_display(const std::vector<client::DisplayStatus>& all, const std::string& kiosk,
                               const std::string& display);

/// A line a display, then the remarks.
[[nodiscard]] std::string displays_table(const std::vector<client::DisplayStatus>& displays);

/// One JSON object a display, each on a line of its own, with its remarks. The wire's numbers are rounded to what they mean.
[[nodiscard]] std::string displays_json(const std::vector<client::DisplayStatus>& displays);

}  // namespace mechane::cli
