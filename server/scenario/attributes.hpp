// An X3D element's fields as typed values. What is not a value is a problem with its line, and reads as the default.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/math.hpp"
#include "server/scenario/document.hpp"

namespace mechane::scenario {

class Attributes {
 public:
  /// All must outlive this.
  Attributes(const Document& document, NodeId id, Problems& problems);

  [[nodiscard]] bool given(std::string_view name) const;
  [[nodiscard]] double number(std::string_view name, double otherwise);
  [[nodiscard]] Vec3 vector(std::string_view name, const Vec3& otherwise);
  /// SFRotation: axis x y z, angle in radians. Default: none.
  [[nodiscard]] Quat rotation(std::string_view name);
  /// SFMatrix3f. X3D writes it by columns; what we read is symmetric, or a problem.
  [[nodiscard]] Mat3 symmetric_matrix(std::string_view name, const Mat3& otherwise);
  [[nodiscard]] bool boolean(std::string_view name, bool otherwise);
  /// MFString.
  [[nodiscard]] std::vector<std::string> strings(std::string_view name);
  [[nodiscard]] std::string text(std::string_view name) const;

  /// An error about this element.
  void error(std::string what, std::string remedy);
  void warning(std::string what, std::string remedy);
  [[nodiscard]] int line() const { return node_.line; }

 private:
  std::optional<std::vector<double>> numbers(std::string_view name, std::size_t count);

  const Node& node_;
  std::string where_;
  Problems& problems_;
};

}  // namespace mechane::scenario
