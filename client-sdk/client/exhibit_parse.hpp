// From a sample of ExhibitStatus to the client's own struct.
#pragma once

#include <mechane/client/exhibits.hpp>
#include <mechane/proto/topics.hpp>

namespace mechane::client {

inline constexpr std::size_t kMaxExhibits = 256;  ///< of each list of a status
inline constexpr std::size_t kMaxExhibitAnswers = 64;

/// False, with `out` in an unspecified state, for another protocol version, a server without a valid name, or a count beyond its limit.
/// Texts are without control characters.
[[nodiscard]] bool parse(const proto::ExhibitStatus& wire, ExhibitStatus& out);

}  // namespace mechane::client
