// Where a trial begins: at the exhibit's beginning, or at a step.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "server/base/error.hpp"
#include "server/state/description.hpp"

namespace mechane::studio {

/// The text of an exhibit that begins at a step, "use/lift": activity and step. `world` is what the text describes; `path` as
/// x3d::read_document(). Its activity is the first one, and begins with a new step "before-lift", which lasts a tick. It does at once what
/// the steps on the shortest way there say of agents and bodies; what visitors and machines would have done on that way is not done.
/// Errors: unknown_name.
[[nodiscard]] Expected<std::string> begin_at(std::string_view text, const std::filesystem::path& path,
                                             const state::WorldDescription& world, const std::string& step);

}  // namespace mechane::studio
