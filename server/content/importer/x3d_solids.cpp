#include "server/content/importer/x3d_solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mechane::content {
namespace {

constexpr std::uint32_t kAround = 144;
constexpr std::uint32_t kUp = 36;             // of a sphere
constexpr double kRoundCrease_rad = kPi / 4;  // smooth around, with an edge to the ends
using Corner = Faces::Corner;

/// A point of an outline that turns about y, with the height in the image.
struct OutlinePoint {
  double radius = 0;
  double y = 0;
  double t = 0;
};

/// Image and corners begin at the back (-z) and run counter-clockwise seen from above.
Vec3 around(double radius, double y, std::uint32_t step) {
  const double angle = 2 * kPi * step / kAround;
  return {-radius * std::sin(angle), y, -radius * std::cos(angle)};
}

std::uint32_t add_uv(Faces& faces, double s, double t) {
  faces.uv.emplace_back(static_cast<float>(s), static_cast<float>(t));
  return static_cast<std::uint32_t>(faces.uv.size() - 1);
}

/// The outline, from below to above, turned about y.
void turn_outline(std::span<const OutlinePoint> outline, Faces& faces) {
  std::vector<std::uint32_t> first;  // point of each ring; a ring on the axis is one point
  for (const OutlinePoint& at : outline) {
    first.push_back(static_cast<std::uint32_t>(faces.points.size()));
    for (std::uint32_t j = 0; j < (at.radius > 0 ? kAround : 1); ++j)
      faces.points.push_back(around(at.radius, at.y, j));
  }
  const auto corner = [&](std::size_t ring, std::uint32_t j, double s) {
    const std::uint32_t step = outline[ring].radius > 0 ? j % kAround : 0;
    return Corner{first[ring] + step, add_uv(faces, s, outline[ring].t)};
  };
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double s = double(j) / kAround, next = double(j + 1) / kAround;
      std::vector<Corner> face;
      if (outline[i].radius > 0) {
        face = {corner(i, j, s), corner(i, j + 1, next)};
      } else {
        face = {corner(i, j, (s + next) / 2)};
      }
      if (outline[i + 1].radius > 0) {
        face.push_back(corner(i + 1, j + 1, next));
        face.push_back(corner(i + 1, j, s));
      } else {
        face.push_back(corner(i + 1, j, (s + next) / 2));
      }
      faces.add(face);
    }
  }
}

/// A disc that looks up or down, with a circle of the image.
void add_disc(double radius, double y, bool up, Faces& faces) {
  std::vector<Corner> face;
  for (std::uint32_t j = 0; j < kAround; ++j) {
    const Vec3 p = around(1, 0, j);
    faces.points.emplace_back(radius * p.x(), y, radius * p.z());
    face.push_back({static_cast<std::uint32_t>(faces.points.size() - 1),
                    add_uv(faces, 0.5 + 0.5 * p.x(), 0.5 + (up ? -0.5 : 0.5) * p.z())});
  }
  if (!up) std::reverse(face.begin(), face.end());
  faces.add(face);
}

Faces round_faces(const x3d::NodeFields& node) {
  Faces faces;
  faces.crease_rad = kRoundCrease_rad;
  faces.seen_from_both_sides = !node.boolean("solid");
  return faces;
}

struct Spine {
  std::vector<Vec3> points;
  bool closed = false;

  explicit Spine(const x3d::NodeFields& extrusion) {
    const std::vector<double> numbers = extrusion.numbers("spine");
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
      points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    closed = points.size() > 2 && points.front() == points.back();
  }
  /// The point before or behind another one; of an open spine's end, itself.
  [[nodiscard]] const Vec3& before(std::size_t i) const {
    return i > 0 ? points[i - 1] : points[closed ? points.size() - 2 : 0];
  }
  [[nodiscard]] const Vec3& behind(std::size_t i) const {
    return i + 1 < points.size() ? points[i + 1] : points[closed ? 1 : points.size() - 1];
  }
};

/// The directions in which X3D lays the cross-section at each point: y is along the spine, z across its bend. Where the spine does not
/// bend, the z of the point before holds; before the first bend, that of the first.
std::vector<Mat3> frames_along(const Spine& spine) {
  const std::size_t count = spine.points.size();
  std::vector<Vec3> along(count, Vec3::Zero()), across(count, Vec3::Zero());
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 d = spine.behind(i) - spine.before(i);
    if (d.norm() > 1e-12) along[i] = d.normalized();
    const Vec3 in = spine.points[i] - spine.before(i), out = spine.behind(i) - spine.points[i];
    const Vec3 bend = out.cross(-in);
    if (bend.norm() > 1e-9 * in.norm() * out.norm()) across[i] = bend.normalized();
  }
  const auto has_length = [](const Vec3& v) { return !v.isZero(); };
  const auto first_along = std::find_if(along.begin(), along.end(), has_length);
  const Vec3 start = first_along != along.end() ? *first_along : Vec3::UnitY();
  const auto bend = std::find_if(across.begin(), across.end(), has_length);
  // A straight spine turns the cross-section by the shortest way from y.
  const Vec3 z_start = bend != across.end() ? *bend : Vec3(Quat::FromTwoVectors(Vec3::UnitY(), start) * Vec3::UnitZ());
  std::vector<Mat3> frames(count);
  Vec3 y = start, z = z_start;
  for (std::size_t i = 0; i < count; ++i) {
    if (has_length(along[i])) y = along[i];
    if (has_length(across[i])) z = across[i].dot(z) < 0 ? Vec3(-across[i]) : across[i];
    Vec3 upright = z - y * y.dot(z);  // where the z of another point does not stand on this y
    if (!(upright.norm() > 1e-9)) upright = y.unitOrthogonal();
    upright.normalize();
    frames[i].col(0) = y.cross(upright);
    frames[i].col(1) = y;
    frames[i].col(2) = upright;
  }
  return frames;
}

/// A list of an Extrusion has one value for all points, or one for each; where it has fewer, the last one holds.
const double* value_at(const std::vector<double>& list, std::size_t width, std::size_t i) {
  return list.data() + width * std::min(i, list.size() / width - 1);
}

void add_cap(std::uint32_t first, std::uint32_t count, bool reversed, Faces& faces) {
  std::vector<Corner> face;
  const auto begin = static_cast<std::uint32_t>(faces.points.size());
  for (std::uint32_t j = 0; j < count; ++j) {
    faces.points.push_back(Vec3(faces.points[first + j]));
    face.push_back({begin + j});
  }
  if (reversed) std::reverse(face.begin(), face.end());
  faces.add(face);
}

}  // namespace

Faces faces_of_box(const x3d::NodeFields& box) {
  Faces faces;
  faces.seen_from_both_sides = !box.boolean("solid");
  const Vec3 half = box.vector("size") / 2;
  for (int i = 0; i < 8; ++i)
    faces.points.push_back(half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  for (const auto& [s, t] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
    add_uv(faces, s, t);
  // Each from its lower left corner, seen from outside: front, back, right, left, top, bottom.
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
      {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7}, {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}}};
  for (const auto& side : kSides) {
    std::array<Corner, 4> face;
    for (std::uint32_t k = 0; k < 4; ++k)
      face[k] = {side[k], k};
    faces.add(face);
  }
  return faces;
}

Faces faces_of_sphere(const x3d::NodeFields& sphere) {
  Faces faces = round_faces(sphere);
  const double radius = sphere.number("radius");
  std::vector<OutlinePoint> outline;
  for (std::uint32_t i = 0; i <= kUp; ++i) {
    const double t = double(i) / kUp;
    const bool pole = i == 0 || i == kUp;
    outline.push_back({pole ? 0 : radius * std::sin(kPi * t), -radius * std::cos(kPi * t), t});
  }
  turn_outline(outline, faces);
  return faces;
}

Faces faces_of_cone(const x3d::NodeFields& cone) {
  Faces faces = round_faces(cone);
  const double radius = cone.number("bottomRadius"), half = cone.number("height") / 2;
  if (cone.boolean("side")) turn_outline(std::array{OutlinePoint{radius, -half, 0}, OutlinePoint{0, half, 1}}, faces);
  if (cone.boolean("bottom")) add_disc(radius, -half, false, faces);
  return faces;
}

Faces faces_of_cylinder(const x3d::NodeFields& cylinder) {
  Faces faces = round_faces(cylinder);
  const double radius = cylinder.number("radius"), half = cylinder.number("height") / 2;
  if (cylinder.boolean("side"))
    turn_outline(std::array{OutlinePoint{radius, -half, 0}, OutlinePoint{radius, half, 1}}, faces);
  if (cylinder.boolean("top")) add_disc(radius, half, true, faces);
  if (cylinder.boolean("bottom")) add_disc(radius, -half, false, faces);
  return faces;
}

Faces faces_of_extrusion(const x3d::NodeFields& extrusion) {
  Faces faces;
  const Spine spine(extrusion);
  const std::vector<double> section = extrusion.numbers("crossSection"), scale = extrusion.numbers("scale"),
                            turns = extrusion.numbers("orientation");
  const auto points = static_cast<std::uint32_t>(section.size() / 2);
  const bool closed = points > 3 && section[0] == section[2 * points - 2] && section[1] == section[2 * points - 1];
  const std::uint32_t round = closed ? points - 1 : points;  // points of a ring that differ
  const auto rings = static_cast<std::uint32_t>(spine.points.size()) - (spine.closed ? 1 : 0);
  const std::vector<Mat3> frames = frames_along(spine);
  for (std::uint32_t i = 0; i < rings; ++i) {
    const double* wide = value_at(scale, 2, i);
    const Mat3 R = frames[i] * x3d::rotation_of({value_at(turns, 4, i), 4}).toRotationMatrix();
    for (std::uint32_t j = 0; j < round; ++j)
      faces.points.push_back(spine.points[i] + R * Vec3(section[std::size_t{2} * j] * wide[0], 0,
                                                        section[std::size_t{2} * j + 1] * wide[1]));
  }
  const auto steps = static_cast<std::uint32_t>(spine.points.size()) - 1;
  for (std::uint32_t i = 0; i <= steps; ++i) {
    for (std::uint32_t j = 0; j < points; ++j)
      add_uv(faces, double(j) / (points - 1), double(i) / steps);
  }
  const auto corner = [&](std::uint32_t i, std::uint32_t j) {
    return Corner{i % rings * round + j % round, i * points + j};
  };
  for (std::uint32_t i = 0; i < steps; ++i) {
    for (std::uint32_t j = 0; j + 1 < points; ++j)
      faces.add(std::array{corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)});
  }
  if (!spine.closed && extrusion.boolean("beginCap")) add_cap(0, round, true, faces);
  if (!spine.closed && extrusion.boolean("endCap")) add_cap((rings - 1) * round, round, false, faces);
  faces.crease_rad = extrusion.number("creaseAngle");
  faces.counter_clockwise = extrusion.boolean("ccw");
  faces.seen_from_both_sides = !extrusion.boolean("solid");
  return faces;
}

}  // namespace mechane::content
