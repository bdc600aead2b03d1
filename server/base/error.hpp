// Faults of the world (files, networks, devices, people) are returned as values: Expected<T>. Our own bugs go to assert.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <tl/expected.hpp>

namespace mechane {

/// What kind of thing is wrong: for code, editors and tests. The words of an Error are for people, and may change.
enum class ErrorCode : std::uint8_t {
  invalid_value,   ///< a value of the wrong kind, out of its range, not finite, or malformed
  missing,         ///< something required is not given
  unknown_name,    ///< a name, key or option that does not exist here
  duplicate,       ///< given or declared twice
  conflict,        ///< each statement is right, but they contradict each other or the present state
  too_large,       ///< over a limit of size, count, depth or memory
  not_found,       ///< a file, folder, device, program or server that is not there
  io_failure,      ///< the system refused to open, read, write or send: permission, disk full, network
  damaged,         ///< bytes that break their format: cut short, wrong checksum, not well-formed
  wrong_version,   ///< made by, or speaking to, another version
  not_supported,   ///< valid, but this program, machine or library cannot do it
  busy,            ///< in use by somebody else, or full; it may work later
  timed_out,       ///< no answer, or not finished, in the time allowed
  failed_process,  ///< a process or thread of ours could not be started, or died
  cancelled,       ///< stopped on request before it was done
};

/// "invalid_value": as `mechane check --json` writes it.
[[nodiscard]] std::string_view name_of(ErrorCode code);
inline constexpr ErrorCode kLastErrorCode = ErrorCode::cancelled;

/// Where in an input something is wrong.
struct Place {
  std::string text;  ///< for people: "models/screw.glb" or "line 41, geometry.hinge HANDLE"
  int line = 0;      ///< from 1; 0 where no line can be named

  // Implicit: a place is most often a text.
  Place() = default;
  Place(const char* place) : text(place) {}
  Place(std::string place) : text(std::move(place)) {}
  Place(std::string place, int its_line) : text(std::move(place)), line(its_line) {}
};

/// An error that a person can act on.
struct Error {
  ErrorCode code = ErrorCode::invalid_value;
  std::string what;    ///< what happened: "the mesh has no triangles"
  std::string where;   ///< where, as a place in the input: "models/screw.glb" or "screw.x3d:41, node HANDLE"
  std::string remedy;  ///< what to do next: "export the model with its faces"
  int line = 0;        ///< of the input, from 1; 0 where no line can be named

  /// One line for a log or a terminal: "where: what; remedy".
  [[nodiscard]] std::string to_string() const {
    std::string text = where.empty() ? what : where + ": " + what;
    if (!remedy.empty()) text += "; " + remedy;
    return text;
  }
  /// The same error, with a file around its place: "models/screw.glb, node HANDLE".
  [[nodiscard]] Error in(const std::string& file) const {
    Error error = *this;
    error.where = where.empty() ? file : file + ", " + where;
    return error;
  }
};

template <class T>
using Expected = tl::expected<T, Error>;

/// `return fail(ErrorCode::missing, "what", "where", "remedy");` in any function that returns an Expected.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string what, Place where = {},
                                                std::string remedy = {}) {
  return tl::unexpected<Error>(Error{code, std::move(what), std::move(where.text), std::move(remedy), where.line});
}

}  // namespace mechane
