// The strongest rival: a dense brick of 16-bit distances, with the same culling. The hierarchy of spheres asks the brick itself how far
// its surface is, which culls better than any box.
#include <algorithm>
#include <cmath>

#include "tests/benchmark/collision/brick_grid.hpp"
#include "tests/benchmark/collision/resolution.hpp"

namespace mechane::benchmark {
namespace {

class Brick final : public Method {
 public:
  Brick(const Scene& scene, const Accuracy& accuracy, Simd simd, NearLists lists)
      : simd_(simd),
        vector_(simd == Simd::best && brick_has_avx2()),
        lists_(lists == NearLists::used ? scene.objects.size() : 0) {
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
      const SceneObject& object = scene.objects[k];
      const SolidQuery query(object);
      cells_.push_back(fewest_cells(accuracy.p99_m[k], [&](int cells) {
        const BrickGrid grid = make_brick_grid(object, query, cells);
        return p99_error_m(accuracy.points[k], [&](const Vec3f& p_O) -> double {
          return sample_brick(grid, (p_O - grid.origin_O) / grid.cell_m).distance_m;
        });
      }));
    }
    const Stopwatch watch;
    for (std::size_t k = 0; k < scene.objects.size(); ++k)
      grids_.push_back(make_brick_grid(scene.objects[k], SolidQuery(scene.objects[k]), cells_[k]));
    build_s_ = watch.seconds();
  }

  [[nodiscard]] std::string name() const override {
    if (!lists_.empty()) return "brick_lists";
    return simd_ == Simd::best ? "brick" : "brick_scalar";
  }
  [[nodiscard]] std::vector<std::size_t> bytes_by_object() const override {
    std::vector<std::size_t> bytes;
    for (const BrickGrid& grid : grids_)
      bytes.push_back(grid.bytes());
    return bytes;
  }
  [[nodiscard]] double build_s() const override { return build_s_; }
  [[nodiscard]] std::vector<int> cells() const override { return cells_; }

  void step(const HandStep& hand, Hits& out) override {
    for (std::size_t k = 0; k < grids_.size(); ++k) {
      if (vector_ && !lists_.empty()) {
        query_brick_lists_avx2(grids_[k], k, hand, lists_[k], out);
      } else if (vector_) {
        query_brick_avx2(grids_[k], k, hand, out);
      } else {
        query_brick_scalar(grids_[k], k, hand, out);
      }
    }
  }

 private:
  Simd simd_;
  bool vector_;                   // with AVX2
  std::vector<BrickList> lists_;  // of each object, where it remembers what is near
  double build_s_ = 0;
  std::vector<int> cells_;
  std::vector<BrickGrid> grids_;
};

/// Nodes from end to end of the mesh, a hair beyond: what is outside the box is outside the object.
std::vector<double> axis_nodes(double low, double high, double cell) {
  const double room = high - low + 2e-3 * cell;
  const auto count = static_cast<std::size_t>(std::ceil(room / cell)) + 1;
  const double begin = 0.5 * (low + high) - 0.5 * cell * static_cast<double>(count - 1);
  std::vector<double> nodes(count);
  for (std::size_t i = 0; i < count; ++i)
    nodes[i] = begin + cell * static_cast<double>(i);
  return nodes;
}

}  // namespace

BrickGrid make_brick_grid(const SceneObject& object, const SolidQuery& query, int cells) {
  const auto box = object.mesh_O.bounds();
  const double cell = box.sizes().maxCoeff() / cells;
  GridAxes axes;
  BrickGrid grid;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>(i);
    axes[a] = axis_nodes(box.min()[i], box.max()[i], cell);
    grid.nodes[a] = static_cast<int>(axes[a].size());
    grid.origin_O[i] = static_cast<float>(axes[a].front());
  }
  const std::vector<double> distances = exact_distances(query, axes);
  const double largest = std::abs(*std::max_element(distances.begin(), distances.end(),
                                                    [](double l, double r) { return std::abs(l) < std::abs(r); }));
  const double step = largest / 32767;
  for (const double d : distances)
    grid.values.push_back(static_cast<std::int16_t>(std::lround(d / step)));
  grid.values.push_back(0);
  grid.cell_m = static_cast<float>(cell);
  grid.step_m = static_cast<float>(step);
  grid.A_GW = object.R_OW / grid.cell_m;
  grid.b_GW = (object.p_OW - grid.origin_O) / grid.cell_m;
  grid.R_WO = object.R_OW.transpose();
  return grid;
}

BrickSample sample_brick(const BrickGrid& grid, const Vec3f& p_G) noexcept {
  std::array<int, 3> at{};
  Vec3f f;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const int nodes = grid.nodes[static_cast<std::size_t>(i)];
    if (!(p_G[i] >= 0 && p_G[i] <= static_cast<float>(nodes - 1))) return {};
    const int cell = std::min(static_cast<int>(p_G[i]), nodes - 2);
    at[static_cast<std::size_t>(i)] = cell;
    f[i] = p_G[i] - static_cast<float>(cell);
  }
  const auto nx = static_cast<std::ptrdiff_t>(grid.nodes[0]);
  const std::ptrdiff_t nxy = nx * grid.nodes[1];
  const std::int16_t* v = grid.values.data() + at[0] + nx * at[1] + nxy * at[2];
  const std::array<const std::int16_t*, 4> rows = {v, v + nx, v + nxy, v + nxy + nx};
  std::array<float, 4> slope{};
  std::array<float, 4> value{};
  for (std::size_t r = 0; r < 4; ++r) {
    slope[r] = static_cast<float>(rows[r][1] - rows[r][0]);
    value[r] = static_cast<float>(rows[r][0]) + f.x() * slope[r];
  }
  const float along0 = value[1] - value[0];
  const float along1 = value[3] - value[2];
  const float low = value[0] + f.y() * along0;
  const float high = value[2] + f.y() * along1;
  const float slope0 = slope[0] + f.y() * (slope[1] - slope[0]);
  const float slope1 = slope[2] + f.y() * (slope[3] - slope[2]);
  return {grid.step_m * (low + f.z() * (high - low)),
          {slope0 + f.z() * (slope1 - slope0), along0 + f.z() * (along1 - along0), high - low}};
}

bool brick_reaches(const BrickGrid& grid, const Vec3f& p_G, float radius_m) noexcept {
  const Vec3f top(static_cast<float>(grid.nodes[0] - 1), static_cast<float>(grid.nodes[1] - 1),
                  static_cast<float>(grid.nodes[2] - 1));
  const Vec3f q = p_G.cwiseMax(0.0F).cwiseMin(top);
  const float reach = radius_m / grid.cell_m + kBrickSlack;
  const float aside = (p_G - q).squaredNorm();
  if (aside > reach * reach) return false;
  // Seen from the nearest point of the box the object lies ahead: both ways are the legs of a triangle.
  const float ahead = std::max(sample_brick(grid, q).distance_m / grid.cell_m, 0.0F);
  return aside + ahead * ahead <= reach * reach;
}

void query_brick_scalar(const BrickGrid& grid, std::size_t object, const HandStep& hand, Hits& out) noexcept {
  if (!brick_reaches(grid, grid.A_GW * hand.center + grid.b_GW, hand.radius)) return;
  for (std::size_t s = 0; s < kSegments; ++s) {
    const Vec3f s_W(hand.segment_x[s], hand.segment_y[s], hand.segment_z[s]);
    if (!brick_reaches(grid, grid.A_GW * s_W + grid.b_GW, hand.segment_r[s])) continue;
    for (std::size_t c = s * kSegmentClusters; c < (s + 1) * kSegmentClusters; ++c) {
      const Vec3f c_W(hand.cluster_x[c], hand.cluster_y[c], hand.cluster_z[c]);
      if (!brick_reaches(grid, grid.A_GW * c_W + grid.b_GW, hand.cluster_r[c])) continue;
      for (std::size_t i = c * kClusterPoints; i < (c + 1) * kClusterPoints; ++i) {
        const Vec3f p_W(hand.x[i], hand.y[i], hand.z[i]);
        const BrickSample found = sample_brick(grid, grid.A_GW * p_W + grid.b_GW);
        if (found.distance_m < 0) out.add(i, object, -found.distance_m, grid.R_WO * found.gradient.normalized());
      }
    }
  }
}

namespace {

collision::GroupsView groups_view(const HandStep& hand) noexcept {
  return {{hand.segment_x.data(), hand.segment_y.data(), hand.segment_z.data(), hand.segment_r.data()},
          rotations_of(hand)};
}

}  // namespace

bool BrickList::still_holds(const HandStep& hand) const noexcept {
  return is_made_ &&
         collision::best_kernels().have_stayed(groups_view(hand), places_, kSegments, collision::NearList::kMargin_m);
}

void BrickList::remember(const HandStep& hand) noexcept {
  is_made_ = true;
  places_ = {hand.segment_x, hand.segment_y, hand.segment_z, hand.segment_R};
}

MethodPtr make_brick(const Scene& scene, const Accuracy& accuracy, Simd simd, NearLists lists) {
  return std::make_unique<Brick>(scene, accuracy, simd, lists);
}

}  // namespace mechane::benchmark
