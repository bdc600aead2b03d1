// The fields of any X3D element as typed values, with X3D's defaults. Unlike scenario's Attributes, it has no ranges of our own.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/math.hpp"
#include "server/x3d/document.hpp"
#include "server/x3d/schema.hpp"

namespace mechane::x3d {

/// SFRotation: axis x y z, angle in radians. Without an angle, or without an axis, it turns nothing.
[[nodiscard]] Quat rotation_of(std::span<const double> four_numbers);

/// A faulty value reads as X3D's default: check_nodes() reports it. Reading a field that the element's type does not have is our own bug.
/// Any thread.
class NodeFields {
 public:
  /// Of the element itself, or of the one that its USE refers to; X3D must have its type. The document must outlive this.
  NodeFields(const Document& document, NodeId id);

  [[nodiscard]] std::string_view type() const { return type_.name; }
  [[nodiscard]] int line() const { return node_.line; }
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] bool boolean(std::string_view name) const;
  [[nodiscard]] Vec3 vector(std::string_view name) const;
  [[nodiscard]] Quat rotation(std::string_view name) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> strings(std::string_view name) const;
  /// Of an SFString.
  [[nodiscard]] std::string text(std::string_view name) const;
  /// The elements in a field that holds nodes, in the order written, resolved.
  [[nodiscard]] std::vector<NodeId> nodes(std::string_view slot) const;
  /// The first of them; none where the field is empty, or where the type has no such field.
  [[nodiscard]] NodeId node(std::string_view slot) const;

 private:
  /// The written text where it is right; X3D's default otherwise.
  [[nodiscard]] std::string_view value(std::string_view name) const;

  const Document& document_;
  NodeId id_;
  const Node& node_;
  const NodeType& type_;
};

}  // namespace mechane::x3d
