// What the world can do wrong (files, networks, devices, people) travels as a value: Expected<T>. Our own bugs go to assert.hpp.
#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace mechane {

/// An error that a person can act on. All three parts are for people; none is parsed by code.
struct Error {
  std::string what;    ///< what happened: "the mesh has no triangles"
  std::string where;   ///< where, as a place in the input: "models/screw.glb" or "screw.x3d:41, node HANDLE"
  std::string remedy;  ///< what to do next: "export the model with its faces"

  /// One line for a log or a terminal: "where: what; remedy".
  [[nodiscard]] std::string to_string() const {
    std::string line = where.empty() ? what : where + ": " + what;
    if (!remedy.empty()) line += "; " + remedy;
    return line;
  }
};

template <class T>
using Expected = tl::expected<T, Error>;

/// `return fail("what", "where", "remedy");` in any function that returns an Expected.
[[nodiscard]] inline tl::unexpected<Error> fail(std::string what, std::string where = {}, std::string remedy = {}) {
  return tl::unexpected<Error>(Error{std::move(what), std::move(where), std::move(remedy)});
}

}  // namespace mechane
