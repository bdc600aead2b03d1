// For a text that the parser refuses as XML: what its author did wrong, and what to write instead.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "server/x3d/document.hpp"
#include "server/x3d/start_tag.hpp"

namespace mechane::x3d {

/// What the parser reports.
struct Refusal {
  std::size_t begin = 0;   ///< the beginning of the tag, text or comment that it could not read
  std::size_t offset = 0;  ///< where it stopped
  std::string_view words;
};

/// `nodes` are those read so far, `open` is the innermost element that is not closed yet; may be none.
[[nodiscard]] XmlFault explain(std::string_view text, const std::vector<Node>& nodes, NodeId open,
                               const Refusal& refusal);

}  // namespace mechane::x3d
