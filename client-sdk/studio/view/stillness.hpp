// Why the bodies of a draft stand still while it is tried.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/state/description.hpp"

namespace mechane::studio {

/// What a client sees of a running world.
struct SeenWorld {
  std::string step;                         ///< name; empty: none
  std::vector<std::string> enabled_agents;  ///< names
  std::vector<Pose> X_WB;                   ///< by body, all of them
  std::vector<std::uint8_t> visible;        ///< by body
  std::vector<std::uint8_t> moves;          ///< by body: whether it has moved a moment ago
};

/// One reason, for an author.
struct StillReason {
  std::string kind;  ///< hidden, fixed, off, not_graspable, heavy, snapped, fell
  state::Texts text;
  state::Texts remedy{};
  std::string path{};  ///< of the value to look at, as the commands write paths; empty: none
};

struct StillBody {
  std::string def;
  std::vector<StillReason> reasons;
};

/// Bodies that do not move now and that hands or other parts cannot move either, with all reasons that can be told from what is seen; in
/// the order of the description. What only the server's memory knows, as which steps came before, is not guessed. Pure.
[[nodiscard]] std::vector<StillBody> still_bodies(const state::WorldDescription& world, const SeenWorld& seen);

}  // namespace mechane::studio
