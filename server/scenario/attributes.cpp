#include "server/scenario/attributes.hpp"

#include <fmt/format.h>

#include "server/scenario/values.hpp"

namespace mechane::scenario {

Attributes::Attributes(const Document& document, NodeId id, Problems& problems)
    : node_(document[id]), where_(document.describe(id)), problems_(problems) {}

bool Attributes::given(std::string_view name) const {
  return node_.attribute(name) != nullptr;
}

void Attributes::error(std::string what, std::string remedy) {
  problems_.error(node_.line, where_, std::move(what), std::move(remedy));
}

void Attributes::warning(std::string what, std::string remedy) {
  problems_.warning(node_.line, where_, std::move(what), std::move(remedy));
}

std::optional<std::vector<double>> Attributes::numbers(std::string_view name, std::size_t count) {
  const std::string* text = node_.attribute(name);
  if (text == nullptr) return std::nullopt;
  auto values = parse_numbers(*text);
  if (!values) {
    error(fmt::format("{}: {}", name, values.error().what), values.error().remedy);
    return std::nullopt;
  }
  if (values->size() != count) {
    error(fmt::format("{} has {} numbers", name, values->size()), fmt::format("write {}", count));
    return std::nullopt;
  }
  return std::move(*values);
}

double Attributes::number(std::string_view name, double otherwise) {
  const auto values = numbers(name, 1);
  return values ? values->front() : otherwise;
}

Vec3 Attributes::vector(std::string_view name, const Vec3& otherwise) {
  const auto values = numbers(name, 3);
  return values ? Vec3((*values)[0], (*values)[1], (*values)[2]) : otherwise;
}

Quat Attributes::rotation(std::string_view name) {
  const auto values = numbers(name, 4);
  if (!values || (*values)[3] == 0) return Quat::Identity();
  const Vec3 axis((*values)[0], (*values)[1], (*values)[2]);
  if (axis.norm() < 1e-9) {
    error(fmt::format("the axis of {} has no length", name),
          "write axis x y z and an angle in radians, like 0 1 0 1.57");
    return Quat::Identity();
  }
  return Quat(Eigen::AngleAxisd((*values)[3], axis.normalized()));
}

Mat3 Attributes::symmetric_matrix(std::string_view name, const Mat3& otherwise) {
  const auto values = numbers(name, 9);
  if (!values) return otherwise;
  const Mat3 matrix = Eigen::Map<const Mat3>(values->data());
  if (!matrix.isApprox(matrix.transpose(), 1e-6)) {
    error(fmt::format("{} is not symmetric", name), "write the same number on both sides of the diagonal");
    return otherwise;
  }
  return matrix;
}

bool Attributes::boolean(std::string_view name, bool otherwise) {
  const std::string* text = node_.attribute(name);
  if (text == nullptr) return otherwise;
  const auto values = parse_booleans(*text);
  if (!values || values->size() != 1) {
    error(fmt::format("{} is neither true nor false", name), "write true or false");
    return otherwise;
  }
  return values->front();
}

std::vector<std::string> Attributes::strings(std::string_view name) {
  const std::string* text = node_.attribute(name);
  if (text == nullptr) return {};
  auto values = parse_strings(*text);
  if (!values) {
    error(fmt::format("{}: {}", name, values.error().what), values.error().remedy);
    return {};
  }
  return std::move(*values);
}

std::string Attributes::text(std::string_view name) const {
  const std::string* text = node_.attribute(name);
  return text != nullptr ? *text : std::string();
}

}  // namespace mechane::scenario
