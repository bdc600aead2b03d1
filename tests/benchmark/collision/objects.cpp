// The five kinds of objects. Lengths in units of about 14 cm, scaled at the end.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "server/base/assert.hpp"
#include "server/collision/samples.hpp"
#include "server/geometry/mesh_check.hpp"
#include "tests/benchmark/collision/scene.hpp"

namespace mechane::benchmark {
namespace {

using geometry::Mesh;

constexpr double kUnit_m = 0.14;
constexpr double kPressShare = 0.015;  // of the diagonal: no hand presses deeper
constexpr double kSpacing = 2.4;  // between neighbours on the table: a hand that grasps one does not touch the next

/// What the default seed has as it stands, the others draw from a range around.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed), fixed_(seed == kDefaultSeed) {}
  double real(double usual, double low, double high) {
    const double drawn = low + (high - low) * random_.unit();
    return fixed_ ? usual : drawn;
  }
  int whole(int usual, int low, int high) {
    const auto drawn = low + static_cast<int>(random_.below(static_cast<std::size_t>(high - low + 1)));
    return fixed_ ? usual : drawn;
  }
  /// Drawn for every seed.
  Random& random() { return random_; }

 private:
  Random random_;
  bool fixed_;
};

Vec3 on_sphere(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

/// A closed mesh around z from a point for each pair of angles: 2 around (bands - 1) triangles.
Mesh globe(int around, int bands, const std::function<Vec3(double polar, double azimuth)>& at) {
  Mesh mesh;
  mesh.vertices.push_back(at(0, 0));
  for (int band = 1; band < bands; ++band)
    for (int i = 0; i < around; ++i)
      mesh.vertices.push_back(at(kPi * band / bands, 2 * kPi * i / around));
  mesh.vertices.push_back(at(kPi, 0));
  const auto vertex = [&](int band, int i) { return static_cast<std::uint32_t>(1 + (band - 1) * around + i % around); };
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, vertex(1, i), vertex(1, i + 1)});
    for (int band = 1; band < bands - 1; ++band) {
      mesh.triangles.push_back({vertex(band, i), vertex(band + 1, i), vertex(band + 1, i + 1)});
      mesh.triangles.push_back({vertex(band, i), vertex(band + 1, i + 1), vertex(band, i + 1)});
    }
    mesh.triangles.push_back({last, vertex(bands - 1, i + 1), vertex(bands - 1, i)});
  }
  return mesh;
}

/// A closed mesh from rings of points of increasing z, all of the same count, with a fan at either end:
/// points (2 (rings - 1) + 2) triangles.
Mesh stack(int rings, int points, const std::function<Vec3(int ring, int point)>& at) {
  Mesh mesh;
  for (int ring = 0; ring < rings; ++ring)
    for (int i = 0; i < points; ++i)
      mesh.vertices.push_back(at(ring, i));
  const auto bottom = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 0, mesh.vertices.front().z());
  mesh.vertices.emplace_back(0, 0, mesh.vertices[bottom - 1].z());
  const auto vertex = [&](int ring, int i) { return static_cast<std::uint32_t>(ring * points + i % points); };
  for (int i = 0; i < points; ++i) {
    for (int ring = 0; ring + 1 < rings; ++ring) {
      mesh.triangles.push_back({vertex(ring, i), vertex(ring, i + 1), vertex(ring + 1, i + 1)});
      mesh.triangles.push_back({vertex(ring, i), vertex(ring + 1, i + 1), vertex(ring + 1, i)});
    }
    mesh.triangles.push_back({bottom, vertex(0, i + 1), vertex(0, i)});
    mesh.triangles.push_back({bottom + 1, vertex(rings - 1, i), vertex(rings - 1, i + 1)});
  }
  return mesh;
}

Mesh bumpy_sphere(Draw& draw) {
  const double radius = draw.real(0.5, 0.4, 0.55);
  const double lobes = draw.whole(4, 3, 6);
  const double waves = draw.whole(5, 3, 6);
  const double side = draw.real(0.07, 0.04, 0.09);
  const double wave = draw.real(0.06, 0.03, 0.07);
  return globe(43, 19, [&](double polar, double azimuth) {
    const double sine = std::sin(polar);
    const double r = 1 + side * std::sin(lobes * azimuth) * sine * sine + wave * std::cos(waves * polar);
    return Vec3(radius * r * on_sphere(polar, azimuth));
  });
}

/// Two spheres of one radius around (0, 0, +-apart), as their union is seen from the middle.
Mesh peanut(Draw& draw) {
  const double radius = draw.real(0.4, 0.33, 0.45);
  const double apart = radius * draw.real(0.75, 0.5, 0.85);
  return globe(40, 20, [&](double polar, double azimuth) {
    const Vec3 direction = on_sphere(polar, azimuth);
    const double along = apart * std::abs(direction.z());
    return Vec3(direction * (along + std::sqrt(along * along + radius * radius - apart * apart)));
  });
}

Mesh gear(Draw& draw) {
  const int teeth = draw.whole(12, 9, 15);
  const double root = draw.real(0.42, 0.36, 0.44);
  const double tip = root * draw.real(0.55 / 0.42, 1.2, 1.35);
  const double half_width = draw.real(0.12, 0.08, 0.16);
  // One tooth: where along its pitch, and at which radius, each run of points begins.
  struct Run {
    double from, radius;
    int points;
  };
  const std::array<Run, 6> runs = {
      {{0, root, 4}, {0.30, root, 3}, {0.40, tip, 4}, {0.75, tip, 3}, {0.85, root, 2}, {1, root, 0}}};
  std::vector<Vec3> profile;
  for (int tooth = 0; tooth < teeth; ++tooth) {
    for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
      for (int i = 0; i < runs[r].points; ++i) {
        const double share = static_cast<double>(i) / runs[r].points;
        const double pitch = std::lerp(runs[r].from, runs[r + 1].from, share);
        const double radius = std::lerp(runs[r].radius, runs[r + 1].radius, share);
        const double angle = 2 * kPi * (tooth + pitch) / teeth;
        profile.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
      }
    }
  }
  const int rings = 4;
  return stack(rings, static_cast<int>(profile.size()), [&](int ring, int i) {
    return Vec3(profile[static_cast<std::size_t>(i)] + Vec3(0, 0, half_width * (2.0 * ring / (rings - 1) - 1)));
  });
}

/// A core with one helical ridge of triangular section.
Mesh screw(Draw& draw) {
  const double core = draw.real(0.25, 0.2, 0.3);
  const double ridge = draw.real(0.06, 0.04, 0.07);
  const double pitch = draw.real(0.24, 0.2, 0.32);
  const double length = draw.real(1.2, 1, 1.3);
  const int rings = 37;
  const int around = 24;
  return stack(rings, around, [&](int ring, int i) {
    const double z = length * (static_cast<double>(ring) / (rings - 1) - 0.5);
    const double turns = z / pitch - static_cast<double>(i) / around;
    const double height = 1 - std::abs(2 * (turns - std::floor(turns)) - 1);
    const double radius = core + ridge * height;
    const double angle = 2 * kPi * i / around;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
  });
}

/// Places -1..1 along an edge of the box so that a third of the cells lies in the two rounded ends.
double box_edge(double s, double half, double radius) {
  constexpr double kFlat = 2.0 / 3;
  const double a = std::abs(s);
  const double place =
      a < kFlat ? a / kFlat * (half - radius) : half - radius + radius * std::tan((a - kFlat) / (1 - kFlat) * kPi / 4);
  return std::copysign(place, s);
}

Mesh rounded_box(Draw& draw) {
  const Vec3 half(draw.real(0.5, 0.4, 0.55), draw.real(0.35, 0.28, 0.42), draw.real(0.25, 0.2, 0.3));
  const double radius = draw.real(0.08, 0.05, 0.11);
  const int cells = 12;
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
          Vec3 p;
          p[axis] = side * half[axis];
          p[u] = box_edge(2.0 * i / cells - 1, half[u], radius);
          p[v] = box_edge(2.0 * j / cells - 1, half[v], radius);
          const Vec3 inner =
              p.cwiseMax(-half.array().matrix() + Vec3::Constant(radius)).cwiseMin(half - Vec3::Constant(radius));
          mesh.vertices.push_back(inner + radius * (p - inner).normalized());
        }
      }
      for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
          const std::uint32_t a = base + static_cast<std::uint32_t>(j * (cells + 1) + i);
          const std::uint32_t b = a + 1;
          const std::uint32_t d = a + static_cast<std::uint32_t>(cells) + 1;
          const std::uint32_t c = d + 1;
          mesh.triangles.push_back(side > 0 ? std::array{a, b, c} : std::array{a, c, b});
          mesh.triangles.push_back(side > 0 ? std::array{a, c, d} : std::array{a, d, c});
        }
      }
    }
  }
  return geometry::weld(mesh, 1e-9);
}

double volume_m3(const Mesh& mesh) {
  double six = 0;
  for (const auto& t : mesh.triangles)
    six += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return six / 6;
}

Quat any_rotation(Random& random) {
  // Shoemake 1992: uniform.
  const double u = random.unit();
  const double a = 2 * kPi * random.unit();
  const double b = 2 * kPi * random.unit();
  return Quat(std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a),
              std::sqrt(u) * std::sin(b));
}

SceneObject place(std::string name, Mesh mesh, std::size_t index, Random& random) {
  for (Vec3& v : mesh.vertices)
    v *= kUnit_m;
  MECHANE_ASSERT(geometry::open_edges(mesh) == 0);
  MECHANE_ASSERT(volume_m3(mesh) > 0);
  const double angle = 2 * kPi * static_cast<double>(index) / kSceneObjects;
  const double circle = 0.5 * kSpacing * kUnit_m / std::sin(kPi / kSceneObjects);
  const Vec3 p_WO = circle * Vec3(std::cos(angle), 0, std::sin(angle));
  return make_scene_object(std::move(name), std::move(mesh), {p_WO, any_rotation(random)});
}

}  // namespace

SceneObject make_scene_object(std::string name, Mesh mesh_O, const Pose& X_WO) {
  SceneObject object;
  object.name = std::move(name);
  object.mesh_O = std::move(mesh_O);
  const auto box = object.mesh_O.bounds();
  object.diagonal_m = box.diagonal().norm();
  object.probe_depth_m = kPressShare * object.diagonal_m;
  object.box_O = box.cast<float>();
  object.bound_O = collision::bounding_sphere(object.mesh_O.vertices);
  object.X_WO = X_WO;
  const Pose X_OW = object.X_WO.inverse();
  object.R_OW = X_OW.R.toRotationMatrix().cast<float>();
  object.p_OW = X_OW.p.cast<float>();
  return object;
}

std::vector<SceneObject> make_objects(std::uint64_t seed) {
  Draw draw(seed);
  std::vector<SceneObject> objects;
  objects.push_back(place("bumpy", bumpy_sphere(draw), 0, draw.random()));
  objects.push_back(place("peanut", peanut(draw), 1, draw.random()));
  objects.push_back(place("gear", gear(draw), 2, draw.random()));
  objects.push_back(place("screw", screw(draw), 3, draw.random()));
  objects.push_back(place("box", rounded_box(draw), 4, draw.random()));
  MECHANE_ASSERT(objects.size() == kSceneObjects);
  const std::size_t triangles =
      std::accumulate(objects.begin(), objects.end(), std::size_t{0},
                      [](std::size_t sum, const SceneObject& object) { return sum + object.mesh_O.triangles.size(); });
  MECHANE_ASSERT(seed != kDefaultSeed || triangles == kDefaultTriangles);
  return objects;
}

}  // namespace mechane::benchmark
