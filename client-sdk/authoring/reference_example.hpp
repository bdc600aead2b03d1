// The example of the manual of the scenario format: a whole file, and what may be added to it. A test reads each.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace mechane::authoring {

/// What one chapter of the manual adds to the example.
struct Variation {
  /// Some lines of the file. Where a piece stands alone (`instead` is not empty) it takes that line's place.
  struct Piece {
    std::string_view where;  ///< for people: "In `agents`, who sees the finger"
    std::string_view
        into;  ///< names of sets, each in the one before: "steps/once/text"; the piece goes to the end of the last
    std::string_view text;  ///< XML
    std::string_view instead = {};
  };
  std::string_view title;
  std::string_view introduction;
  std::span<const Piece> pieces;
};

/// The whole file that the page begins with: a scenario that checks without fault but for its mesh file.
[[nodiscard]] std::string reference_example();

[[nodiscard]] std::span<const Variation> reference_variations();

/// The example with one of them in it: without fault as well.
[[nodiscard]] std::string reference_example_with(const Variation& variation);

}  // namespace mechane::authoring
