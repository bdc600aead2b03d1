#include "tests/benchmark/paper_map/paper_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "server/base/assert.hpp"
#include "server/base/parallel.hpp"
#include "server/geometry/superquadric_math.hpp"

namespace mechane::benchmark {
namespace {

constexpr std::int16_t kNoHit = std::numeric_limits<std::int16_t>::min();
constexpr int kMinPlaces = 16;
constexpr int kMaxPlaces = 1024;
constexpr double kEqualAxes = 0.01;  // the share by which axes may differ that (10) takes for equal

/// sgn(c) |c|^e: what the paper writes as c^e.
double paper_power(double c, double e) {
  return std::copysign(std::pow(std::abs(c), e), c);
}

bool are_equal(double a, double b) {
  return std::abs(a - b) <= kEqualAxes * std::max(a, b);
}

/// N of (12): both logarithms are of whole numbers' quotients, so the integer part needs no logarithm.
int pyramid_levels(const PaperGrid& grid) {
  const auto most = static_cast<unsigned>(std::max(grid.eta / 16, grid.omega / 32));
  return static_cast<int>(std::bit_width(most)) - 1;
}

/// (10): towards larger (+1) or smaller (-1) angles from the radial guess, in the octant of `angle`.
int named_side(float angle, double exponent) noexcept {
  const float quarter = static_cast<float>(kPi / 2);
  const float within = angle - quarter * std::floor(angle / quarter);
  const bool first_half = within < 0.5F * quarter;
  return first_half == (exponent < 1) ? -1 : 1;
}

}  // namespace

/// The radial guess: where the ray from the centre through M meets the surface.
struct PaperMap::Guess {
  float eta = 0;
  float omega = 0;
  float m = 0;  // the radial form
};

PaperMap::PaperMap(const geometry::Superquadric& shape, const PaperGrid& grid, std::span<const float> distances_m)
    : shape_(shape), grid_(grid) {
  MECHANE_ASSERT(is_valid(shape, grid, distances_m));
  levels_ = pyramid_levels(grid);
  tabulate();
  bound();
  float largest = 1e-9F;
  for (const float d : distances_m)
    if (!std::isnan(d)) largest = std::max(largest, std::abs(d));
  step_m_ = largest / 32767.0F;
  values_.reserve(distances_m.size());
  for (const float d : distances_m)
    values_.push_back(std::isnan(d) ? kNoHit : static_cast<std::int16_t>(std::lround(d / step_m_)));
}

bool PaperMap::is_valid(const geometry::Superquadric& shape, const PaperGrid& grid,
                        std::span<const float> distances_m) {
  const auto fits = [](int places) { return places >= kMinPlaces && places <= kMaxPlaces; };
  if (!geometry::is_valid(shape) || !fits(grid.eta) || !fits(grid.omega)) return false;
  // With fewer places one way the pyramid would reach around the superquadric.
  if (grid.omega < 32 || grid.omega % 2 != 0 || grid.omega > 8 * grid.eta || grid.eta > 4 * grid.omega) return false;
  if (distances_m.size() != static_cast<std::size_t>(grid.eta) * static_cast<std::size_t>(grid.omega)) return false;
  return std::none_of(distances_m.begin(), distances_m.end(), [](float d) { return std::isinf(d); });
}

geometry::SurfaceAngles PaperMap::angles(const PaperGrid& grid, int eta, int omega) {
  return {-kPi / 2 + kPi * eta / (grid.eta - 1), -kPi + 2 * kPi * (omega + 1) / grid.omega};
}

/// (5) and (16) are products of what eta gives and what omega gives: two short tables hold all powers.
void PaperMap::tabulate() {
  const geometry::Superquadric& s = shape_;
  shape_f_ = {s.a.cast<float>(),
              static_cast<float>(s.e1),
              static_cast<float>(s.e2),
              static_cast<float>(s.taper_x),
              static_cast<float>(s.taper_y),
              static_cast<float>(s.bend_per_m),
              static_cast<float>(s.bend_angle_rad)};
  deformed_ = geometry::is_deformed(s);
  sided_omega_ = !deformed_ && are_equal(s.a.x(), s.a.y());
  sided_eta_ = sided_omega_ && are_equal(s.a.x(), s.a.z());
  cos_alpha_ = static_cast<float>(std::cos(s.bend_angle_rad));
  sin_alpha_ = static_cast<float>(std::sin(s.bend_angle_rad));
  for (int i = 0; i < grid_.eta; ++i) {
    const double eta = angles(grid_, i, 0).eta;
    const double c = std::max(0.0, std::cos(eta));
    const double z = s.a.z() * paper_power(std::sin(eta), s.e1);
    const double gamma = s.bend_per_m * z;
    const auto f = [](double value) { return static_cast<float>(value); };
    rows_.push_back({f(std::pow(c, s.e1)), f(z), f(std::pow(c, 2 - s.e1)),
                     f(paper_power(std::sin(eta), 2 - s.e1) / s.a.z()), f(s.taper_x * z / s.a.z() + 1),
                     f(s.taper_y * z / s.a.z() + 1),
                     f(s.bend_per_m * z * z * geometry::math::one_minus_cos_over_square(gamma)),
                     f(z * geometry::math::sinc(gamma)), f(std::sin(gamma)), f(std::cos(gamma))});
  }
  for (int j = 0; j < grid_.omega; ++j) {
    const double omega = angles(grid_, 0, j).omega;
    const double c = std::cos(omega);
    const double t = std::sin(omega);
    columns_.push_back({static_cast<float>(s.a.x() * paper_power(c, s.e2)),
                        static_cast<float>(s.a.y() * paper_power(t, s.e2)),
                        static_cast<float>(paper_power(c, 2 - s.e2) / s.a.x()),
                        static_cast<float>(paper_power(t, 2 - s.e2) / s.a.y())});
  }
}

/// The undeformed box, deformed. At one height taper and bend are affine, so its corners there are the outermost; between two heights a
/// bend bulges by less than the margin.
void PaperMap::bound() {
  static constexpr int kSteps = 32;
  for (int i = 0; i < 4 * (kSteps + 1); ++i) {
    const int height = i / 4;
    const Vec3 at(i % 2 == 0 ? -1 : 1, i / 2 % 2 == 0 ? -1 : 1, -1 + 2.0 * height / kSteps);
    bound_Q_.extend(geometry::deform(shape_, at.cwiseProduct(shape_.a)).cast<float>());
  }
  const Vec3f margin = Vec3f::Constant((deformed_ ? 0.02F : 1e-6F) * bound_Q_.sizes().maxCoeff());
  bound_Q_ = {bound_Q_.min() - margin, bound_Q_.max() + margin};
}

PaperMap::Place PaperMap::place(Index at) const noexcept {
  const Row& row = rows_[static_cast<std::size_t>(at.eta)];
  const Column& column = columns_[static_cast<std::size_t>(at.omega)];
  const Place plain{{row.across * column.x, row.across * column.y, row.z},
                    {row.n_across * column.n_x, row.n_across * column.n_y, row.n_z}};
  return deformed_ ? deformed(row, plain) : plain;
}

/// Taper, then bend; the normal by det(J) J^-T of each, written out.
PaperMap::Place PaperMap::deformed(const Row& row, Place at) const noexcept {
  const Vec3f tapered(row.taper_x * at.p_Q.x(), row.taper_y * at.p_Q.y(), at.p_Q.z());
  const float inverse_a3 = 1 / shape_f_.a.z();
  const Vec3f n(
      row.taper_y * at.n_Q.x(), row.taper_x * at.n_Q.y(),
      row.taper_x * row.taper_y * at.n_Q.z() - inverse_a3 * (row.taper_y * shape_f_.taper_x * at.p_Q.x() * at.n_Q.x() +
                                                             row.taper_x * shape_f_.taper_y * at.p_Q.y() * at.n_Q.y()));
  // In the plane of the bend: r towards its axis, s across; (r, z) goes to (R, Z), s stays.
  const float r = cos_alpha_ * tapered.x() + sin_alpha_ * tapered.y();
  const float q = 1 - shape_f_.bend_per_m * r;
  const float shift = row.rise * q;  // R - r
  const float n_r = cos_alpha_ * n.x() + sin_alpha_ * n.y();
  const float n_s = cos_alpha_ * n.y() - sin_alpha_ * n.x();
  const float n_R = row.cos_gamma * q * n_r + row.sin_gamma * n.z();
  const float n_S = q * n_s;
  return {{tapered.x() + cos_alpha_ * shift, tapered.y() + sin_alpha_ * shift, row.reach * q},
          {cos_alpha_ * n_R - sin_alpha_ * n_S, sin_alpha_ * n_R + cos_alpha_ * n_S,
           row.cos_gamma * n.z() - row.sin_gamma * q * n_r}};
}

/// False outside the superquadric. F (1) and the angles share their powers.
bool PaperMap::guess(const Vec3f& p_QP, Guess& out) const noexcept {
  if (!((p_QP.array() >= bound_Q_.min().array()) && (p_QP.array() <= bound_Q_.max().array())).all()) return false;
  const Vec3f p = deformed_ ? Vec3f(geometry::math::undeform<float>(shape_f_, p_QP)) : p_QP;
  const Vec3f ratio = p.cwiseQuotient(shape_f_.a).cwiseAbs();
  if (!(ratio.maxCoeff() <= 1)) return false;
  const float c = std::pow(ratio.x(), 1 / shape_f_.e2);
  const float t = std::pow(ratio.y(), 1 / shape_f_.e2);
  const float across = std::pow(c * c + t * t, 0.5F * shape_f_.e2 / shape_f_.e1);
  const float up = std::pow(ratio.z(), 1 / shape_f_.e1);
  const float F = across * across + up * up;
  if (!(F <= 1)) return false;
  out.eta = std::atan2(std::copysign(up, p.z()), across);
  out.omega = std::atan2(std::copysign(t, p.y()), std::copysign(c, p.x()));
  out.m = std::pow(F, 0.5F * shape_f_.e1);
  return true;
}

/// Over a pole the way goes on down the other side.
PaperMap::Index PaperMap::wrapped(int eta, int omega) const noexcept {
  const int last = grid_.eta - 1;
  if (eta < 0 || eta > last) {
    eta = eta < 0 ? -eta : 2 * last - eta;
    omega += grid_.omega / 2;
  }
  if (omega < 0) return {eta, omega + grid_.omega};
  return {eta, omega < grid_.omega ? omega : omega - grid_.omega};
}

/// One search: the best place so far.
class PaperMap::Climb {
 public:
  Climb(const PaperMap& map, const Vec3f& p_QP) : map_(map), p_QP_(p_QP) {}

  /// Evaluates I_s, squared: it orders the same.
  void consider(int eta, int omega) noexcept {
    ++evaluations;
    const Index at = map_.wrapped(eta, omega);
    const Place place = map_.place(at);
    const Vec3f way = place.p_Q - p_QP_;
    const float along = place.n_Q.dot(way);
    const float whole = place.n_Q.squaredNorm() * way.squaredNorm();
    const float value = whole > 0 ? along * along / whole : 1;  // M is the place itself
    if (value <= value_) return;
    value_ = value;
    best = {eta, omega};
    found = place;
  }

  int evaluations = 0;
  Index best{};  // not wrapped
  Place found{Vec3f::Zero(), Vec3f::UnitZ()};

 private:
  const PaperMap& map_;
  Vec3f p_QP_;
  float value_ = -1;
};

PaperAnswer PaperMap::search(const Vec3f& p_QP, const PaperSearch& how) const noexcept {
  PaperAnswer answer;
  Guess from;
  if (!guess(p_QP, from)) return answer;
  const auto fit = [](double angle, double step) { return static_cast<int>(std::lround(angle / step)); };
  const int eta = fit(static_cast<double>(from.eta) + kPi / 2, kPi / (grid_.eta - 1));
  const int omega = fit(static_cast<double>(from.omega) + kPi, 2 * kPi / grid_.omega) - 1;

  // The window of (11) has 2^N + 1 places each way: its lower corner.
  const int reach = 1 << levels_;
  const auto corner = [&](int guess, bool sided, float angle, double exponent) {
    if (!sided && how.window == PaperWindow::corrected) return guess - reach / 2;
    return named_side(angle, exponent) > 0 ? guess : guess - reach;
  };
  const int low_eta = corner(eta, sided_eta_, from.eta, shape_.e1);
  const int low_omega = corner(omega, sided_omega_, from.omega, shape_.e2);

  Climb climb(*this, p_QP);
  int stride = reach / 2;
  if (levels_ == 0) climb.consider(eta, omega);
  for (int i = 0; levels_ > 0 && i < 9; ++i)
    climb.consider(low_eta + i / 3 * stride, low_omega + i % 3 * stride);
  while (stride > 1) {
    stride /= 2;
    const Index middle = climb.best;
    for (int i = 0; i < 9; ++i)
      if (i != 4) climb.consider(middle.eta + (i / 3 - 1) * stride, middle.omega + (i % 3 - 1) * stride);
  }

  answer.inside = true;
  answer.evaluations = climb.evaluations;
  const Index at = wrapped(climb.best.eta, climb.best.omega);
  answer.eta = at.eta;
  answer.omega = at.omega;
  const std::int16_t value = values_[slot(at)];
  if (value == kNoHit) return answer;
  const Vec3f n_Q = climb.found.n_Q.normalized();
  const Vec3f way = climb.found.p_Q - p_QP;
  const float depth =
      (how.depth == PaperDepth::distance ? way.norm() : n_Q.dot(way)) - step_m_ * static_cast<float>(value);
  if (!(depth > 0)) return answer;
  collision::MapHit& hit = answer.hit;
  hit.hit = true;
  hit.depth_m = depth;
  hit.m = from.m;
  hit.n_Q = n_Q;
  hit.p_QS = p_QP + depth * hit.n_Q;
  return answer;
}

std::optional<float> PaperMap::distance_m(int eta, int omega) const {
  MECHANE_ASSERT(eta >= 0 && eta < grid_.eta && omega >= 0 && omega < grid_.omega);
  const std::int16_t value = values_[slot({eta, omega})];
  if (value == kNoHit) return std::nullopt;
  return step_m_ * static_cast<float>(value);
}

std::optional<Vec3f> PaperMap::surface_Q(int eta, int omega) const {
  const auto inwards = distance_m(eta, omega);
  if (!inwards) return std::nullopt;
  const Place from = place({eta, omega});
  return Vec3f(from.p_Q - *inwards * from.n_Q.normalized());
}

std::vector<float> PaperMap::distances_m() const {
  std::vector<float> distances;
  distances.reserve(values_.size());
  for (const std::int16_t value : values_)
    distances.push_back(value == kNoHit ? std::numeric_limits<float>::quiet_NaN()
                                        : step_m_ * static_cast<float>(value));
  return distances;
}

void PaperMap::smooth_once(std::vector<float>& distances) const {
  static constexpr std::array<float, 3> kBinomial = {1, 2, 1};
  const std::vector<float> before = distances;
  for (int i = 0; i < grid_.eta; ++i) {
    for (int j = 0; j < grid_.omega; ++j) {
      float& here = distances[slot({i, j})];
      if (!(here >= 0)) continue;
      float sum = 0;
      float weights = 0;
      for (int k = 0; k < 9; ++k) {
        const float neighbour = before[slot(wrapped(i + k / 3 - 1, j + k % 3 - 1))];
        if (!(neighbour >= 0)) continue;
        const float weight = kBinomial[static_cast<std::size_t>(k / 3)] * kBinomial[static_cast<std::size_t>(k % 3)];
        sum += weight * neighbour;
        weights += weight;
      }
      here = sum / weights;
    }
  }
}

PaperMap PaperMap::smoothed(int passes) const {
  std::vector<float> distances = distances_m();
  for (int pass = 0; pass < passes; ++pass)
    smooth_once(distances);
  return {shape_, grid_, distances};
}

std::size_t PaperMap::bytes() const noexcept {
  return sizeof(*this) + rows_.size() * sizeof(Row) + columns_.size() * sizeof(Column) +
         values_.size() * sizeof(std::int16_t);
}

namespace {

/// How far along `direction` from `start` in solid (winding > 0) until air; nothing where the ray never leaves it.
std::optional<double> way_out(std::span<const geometry::RayHit> hits, int winding) {
  for (const geometry::RayHit& hit : hits) {
    winding += hit.entering ? 1 : -1;
    if (winding <= 0) return hit.t;
  }
  return std::nullopt;
}

/// The distance of (6) from a place p_O, n_O outward; NaN: no hit.
double cast_place(const PaperTarget& target, const Vec3& p_O, const Vec3& n_O, double margin_m,
                  std::vector<geometry::RayHit>& hits) {
  // From a hair outside, so that a surface that touches the superquadric is met. A millionth aside: see Solid::walk.
  const Vec3 start = p_O + margin_m * n_O;
  const Vec3 aside = 1e-7 * Vec3(0.371, -0.713, 0.594);
  target.surface_O.cast(start, aside - n_O, hits);
  int winding = 0;
  for (const geometry::RayHit& hit : hits)
    winding += hit.entering ? -1 : 1;
  if (target.closed && winding > 0) {
    target.surface_O.cast(start, aside + n_O, hits);
    const auto out = way_out(hits, winding);
    return out ? -(*out + margin_m) : std::numeric_limits<double>::quiet_NaN();
  }
  return hits.empty() ? std::numeric_limits<double>::quiet_NaN() : std::max(0.0, hits.front().t - margin_m);
}

}  // namespace

PaperMap cast_paper_map(const PaperTarget& target, const geometry::Superquadric& shape, const Pose& X_OQ,
                        const PaperGrid& grid) {
  const double size = 2 * shape.a.norm();
  std::vector<float> distances(static_cast<std::size_t>(grid.eta) * static_cast<std::size_t>(grid.omega));
  for_each_index(static_cast<std::size_t>(grid.eta), [&](std::size_t i) {
    std::vector<geometry::RayHit> hits;
    for (int j = 0; j < grid.omega; ++j) {
      const auto at = PaperMap::angles(grid, static_cast<int>(i), j);
      const Vec3 p_Q = geometry::surface_point(shape, at);
      const Vec3 n_Q = geometry::surface_normal(shape, at);
      double d = cast_place(target, X_OQ * p_Q, X_OQ.rotate(n_Q), 1e-6 * size, hits);
      if (d > 1e-3 * size && geometry::inside_outside(shape, p_Q - d * n_Q) > 1 + 1e-6)
        d = std::numeric_limits<double>::quiet_NaN();
      distances[i * static_cast<std::size_t>(grid.omega) + static_cast<std::size_t>(j)] = static_cast<float>(d);
    }
  });
  return {shape, grid, distances};
}

}  // namespace mechane::benchmark
