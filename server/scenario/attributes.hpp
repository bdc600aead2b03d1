// An X3D element's fields as typed values: the fields that our schema lists, with X3D's own defaults.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/base/math.hpp"
#include "server/scenario/schema.hpp"
#include "server/x3d/document.hpp"
#include "server/x3d/schema.hpp"

namespace mechane::scenario {

/// A faulty value reads as X3D's default: check_nodes() has reported it. Reading a field that the element's table in schema.hpp does not
/// have is our own bug.
class Attributes {
 public:
  /// All must outlive this.
  Attributes(const x3d::Document& document, x3d::NodeId id, x3d::Problems& problems);

  [[nodiscard]] bool given(std::string_view name) const;
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] Vec3 vector(std::string_view name) const;
  /// SFRotation: axis x y z, angle in radians.
  [[nodiscard]] Quat rotation(std::string_view name) const;
  /// SFMatrix3f. A matrix that is not symmetric is a problem, so X3D's order by columns does not matter.
  [[nodiscard]] Mat3 symmetric_matrix(std::string_view name);
  [[nodiscard]] bool boolean(std::string_view name) const;
  /// MFString.
  [[nodiscard]] std::vector<std::string> strings(std::string_view name) const;
  /// SFString, and DEF.
  [[nodiscard]] std::string text(std::string_view name) const;

  /// Problems of this element, at its line.
  void error(ErrorCode code, std::string what, std::string remedy);
  void warning(ErrorCode code, std::string what, std::string remedy);
  [[nodiscard]] int line() const { return node_.line; }

 private:
  /// The written text where it is right; X3D's default otherwise.
  std::string_view value(std::string_view name) const;
  std::vector<double> numbers(std::string_view name) const;

  const x3d::Node& node_;
  const Table& table_;
  const x3d::NodeType& type_;
  std::string where_;
  x3d::Problems& problems_;
};

/// What is wrong with an attribute's text by X3D's rules and by our own; none where it is right. `key` may be null.
[[nodiscard]] std::optional<x3d::BadValue> attribute_fault(const x3d::Field& field, const Key* key,
                                                           std::string_view text);

}  // namespace mechane::scenario
