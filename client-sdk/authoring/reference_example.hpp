// The example in the manual of the scenario format: a whole file, and additions to it. A test reads each.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace mechane::authoring {

/// What one chapter of the manual adds to the example.
struct Variation {
  /// Some lines to add to the file; or, where `instead` is not empty, to put in place of that text.
  struct Piece {
    std::string_view where;  ///< for people: "In `agents`, the agent that sees the finger"
    std::string_view into;   ///< the set to add it to, at its end: names of nested sets, "steps/once/text"
    std::string_view text;   ///< XML
    std::string_view instead = {};
  };
  std::string_view title;
  std::string_view introduction;
  std::span<const Piece> pieces;
};

/// The whole file with which the page begins: a scenario without problems, except that its mesh file does not exist.
[[nodiscard]] std::string reference_example();

/// A file without meshes and without our metadata, that runs as it is.
[[nodiscard]] std::string_view reference_shapes();

[[nodiscard]] std::span<const Variation> reference_variations();

/// The example with one variation in it: also without problems.
[[nodiscard]] std::string reference_example_with(const Variation& variation);

}  // namespace mechane::authoring
