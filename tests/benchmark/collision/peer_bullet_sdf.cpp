// Bullet's btSdfCollisionShape: a grid of cubic cells of 32 nodes each. Bullet brings no tool to make one; its loader reads the bytes
// of Discregrid's files, which are written here from exact distances.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <BulletCollision/CollisionShapes/btSdfCollisionShape.h>

#include "server/base/assert.hpp"
#include "tests/benchmark/collision/culling.hpp"
#include "tests/benchmark/collision/exact_grid.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/resolution.hpp"

namespace mechane::benchmark {
namespace {

/// Where the nodes of a cell lie, in thirds of the cell: its corners, then two on each of the twelve edges, in the order of the shape
/// functions.
std::array<std::array<int, 3>, 32> cell_nodes() {
  std::array<std::array<int, 3>, 32> nodes{};
  std::size_t at = 0;
  for (int i = 0; i < 8; ++i)
    nodes[at++] = {i % 2 * 3, i / 2 % 2 * 3, i / 4 * 3};
  for (int edge = 0; edge < 4; ++edge)  // along x: z is the faster
    for (int third = 1; third <= 2; ++third)
      nodes[at++] = {third, edge / 2 * 3, edge % 2 * 3};
  for (int edge = 0; edge < 4; ++edge)  // along y: x is the faster
    for (int third = 1; third <= 2; ++third)
      nodes[at++] = {edge % 2 * 3, third, edge / 2 * 3};
  for (int edge = 0; edge < 4; ++edge)  // along z: y is the faster
    for (int third = 1; third <= 2; ++third)
      nodes[at++] = {edge / 2 * 3, edge % 2 * 3, third};
  return nodes;
}

class Bytes {
 public:
  template <class T>
  void put(const T& value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
  }
  void put_count(std::size_t count) { put(static_cast<unsigned long long>(count)); }
  [[nodiscard]] const std::vector<char>& bytes() const { return bytes_; }

 private:
  std::vector<char> bytes_;
};

struct Layout {
  std::array<int, 3> cells{};
  std::array<std::vector<double>, 3> thirds;  // coordinates of all nodes, in steps of a third of a cell
  double cell_m = 0;
};

Layout layout_of(const SceneObject& object, int cells) {
  const auto box = object.mesh_O.bounds();
  Layout layout;
  layout.cell_m = box.sizes().maxCoeff() / cells;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>(i);
    const double room = box.sizes()[i] + 2e-3 * layout.cell_m;
    layout.cells[a] = static_cast<int>(std::ceil(room / layout.cell_m));
    const double begin = box.center()[i] - 0.5 * layout.cell_m * layout.cells[a];
    for (int k = 0; k <= 3 * layout.cells[a]; ++k)
      layout.thirds[a].push_back(begin + layout.cell_m * k / 3);
  }
  return layout;
}

/// Distances at the nodes: those with no coordinate, or one, between corners. Sampled plane by plane of a dense grid would be seven
/// times too many, so each of the four families is sampled as a grid of its own.
class NodeTable {
 public:
  NodeTable(const Layout& layout, const SolidQuery& query) : layout_(layout) {
    for (std::size_t family = 0; family < 4; ++family) {  // 0: corners; 1 to 3: along x, y, z
      GridAxes axes;
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t k = 0; k < layout.thirds[a].size(); ++k)
          if ((k % 3 != 0) == (family == a + 1)) axes[a].push_back(layout.thirds[a][k]);
      counts_[family] = {axes[0].size(), axes[1].size()};
      first_[family] = values_.size();
      const auto distances = exact_distances(query, axes);
      values_.insert(values_.end(), distances.begin(), distances.end());
    }
  }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

  /// The index of the node at these thirds.
  [[nodiscard]] unsigned index(const std::array<int, 3>& thirds) const {
    std::size_t family = 0;
    std::array<std::size_t, 3> at{};
    for (std::size_t a = 0; a < 3; ++a)
      if (thirds[a] % 3 != 0) family = a + 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto third = static_cast<std::size_t>(thirds[a]);
      at[a] = family == a + 1 ? third - third / 3 - 1 : third / 3;
    }
    return static_cast<unsigned>(first_[family] + at[0] + counts_[family][0] * (at[1] + counts_[family][1] * at[2]));
  }

 private:
  const Layout& layout_;
  std::array<std::array<std::size_t, 2>, 4> counts_{};
  std::array<std::size_t, 4> first_{};
  std::vector<double> values_;
};

std::vector<char> discregrid_bytes(const SceneObject& object, const SolidQuery& query, int cells) {
  const Layout layout = layout_of(object, cells);
  const NodeTable nodes(layout, query);
  const auto count = [&](std::size_t a) { return static_cast<unsigned>(layout.cells[a]); };
  Bytes out;
  for (std::size_t a = 0; a < 3; ++a)
    out.put(layout.thirds[a].front());
  for (std::size_t a = 0; a < 3; ++a)
    out.put(layout.thirds[a].back());
  for (std::size_t a = 0; a < 3; ++a)
    out.put(count(a));
  for (int a = 0; a < 3; ++a)
    out.put(layout.cell_m);
  for (int a = 0; a < 3; ++a)
    out.put(1 / layout.cell_m);
  const std::size_t all = std::size_t{count(0)} * count(1) * count(2);
  out.put_count(all);
  out.put_count(1);  // fields
  out.put_count(1);
  out.put_count(nodes.values().size());
  for (const double value : nodes.values())
    out.put(value);
  out.put_count(1);
  out.put_count(all);
  const auto corners = cell_nodes();
  for (std::size_t cell = 0; cell < all; ++cell) {
    const std::array<int, 3> at = {static_cast<int>(cell % count(0)), static_cast<int>(cell / count(0) % count(1)),
                                   static_cast<int>(cell / count(0) / count(1))};
    for (const auto& node : corners)
      out.put(nodes.index({3 * at[0] + node[0], 3 * at[1] + node[1], 3 * at[2] + node[2]}));
  }
  out.put_count(1);
  out.put_count(all);
  for (std::size_t cell = 0; cell < all; ++cell)
    out.put(static_cast<unsigned>(cell));
  return out.bytes();
}

struct Sdf {
  std::unique_ptr<btSdfCollisionShape> shape;
  std::size_t bytes = 0;
  float cell_m = 0;
};

Sdf make_sdf(const SceneObject& object, const SolidQuery& query, int cells) {
  const std::vector<char> bytes = discregrid_bytes(object, query, cells);
  Sdf sdf{std::make_unique<btSdfCollisionShape>(), bytes.size(),
          static_cast<float>(object.mesh_O.bounds().sizes().maxCoeff() / cells)};
  const bool good = sdf.shape->initializeSDF(bytes.data(), static_cast<int>(bytes.size()));
  MECHANE_ASSERT(good);
  return sdf;
}

/// False outside the grid.
bool query_sdf(const Sdf& sdf, const Vec3f& p_O, float& distance_m, Vec3f& gradient) {
  btScalar distance = 0;
  btVector3 g(0, 0, 0);
  const btVector3 p(static_cast<btScalar>(p_O.x()), static_cast<btScalar>(p_O.y()), static_cast<btScalar>(p_O.z()));
  if (!sdf.shape->queryPoint(p, distance, g)) return false;
  distance_m = static_cast<float>(distance);
  gradient = {static_cast<float>(g.x()), static_cast<float>(g.y()), static_cast<float>(g.z())};
  return true;
}

class BulletSdf final : public Method {
 public:
  BulletSdf(const Scene& scene, const Accuracy& accuracy) : scene_(scene) {
    for (std::size_t k = 0; k < kSceneObjects; ++k) {
      const SceneObject& object = scene.objects[k];
      const SolidQuery query(object);
      cells_.push_back(fewest_cells(accuracy.p99_m[k], [&](int cells) {
        const Sdf sdf = make_sdf(object, query, cells);
        return p99_error_m(accuracy.points[k], [&](const Vec3f& p_O) -> double {
          float distance = 1;
          Vec3f gradient;
          return query_sdf(sdf, p_O, distance, gradient) ? distance : 1;
        });
      }));
    }
    const Stopwatch watch;
    for (std::size_t k = 0; k < kSceneObjects; ++k)
      shapes_.push_back(make_sdf(scene.objects[k], SolidQuery(scene.objects[k]), cells_[k]));
    build_s_ = watch.seconds();
  }

  [[nodiscard]] std::string name() const override { return "bt_sdf"; }
  [[nodiscard]] std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const Sdf& sdf : shapes_)
      sum += sdf.bytes;
    return sum;
  }
  [[nodiscard]] double build_s() const override { return build_s_; }
  [[nodiscard]] std::vector<int> cells() const override { return cells_; }

  void step(const HandStep& hand, Hits& out) override {
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      const SceneObject& object = scene_.objects[k];
      const Sdf& sdf = shapes_[k];
      const Eigen::Matrix3f R_WO = object.R_OW.transpose();
      float distance = 0;
      Vec3f gradient = Vec3f::Zero();
      visit_near_clusters(hand, object, [&](std::size_t cluster, const Vec3f& c_O, float radius) {
        if (query_sdf(sdf, c_O, distance, gradient) && distance > radius + 0.25F * sdf.cell_m) return;
        for (std::size_t i = cluster * kClusterPoints; i < (cluster + 1) * kClusterPoints; ++i) {
          if (!query_sdf(sdf, point_O(hand, object, i), distance, gradient) || distance >= 0) continue;
          out.add(i, k, -distance, R_WO * gradient.normalized());
        }
      });
    }
  }

 private:
  const Scene& scene_;
  double build_s_ = 0;
  std::vector<int> cells_;
  std::vector<Sdf> shapes_;
};

}  // namespace

MethodPtr make_bt_sdf(const Scene& scene, const Accuracy& accuracy) {
  return std::make_unique<BulletSdf>(scene, accuracy);
}

}  // namespace mechane::benchmark
