// The paper's distance map over a superquadric's (eta, omega) and its pyramid search: the reference that the product's maps are
// compared with. Never chosen by the builder, and not for the loop. Equation numbers are the paper's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "server/collision/map_hit.hpp"
#include "server/geometry/mesh_query.hpp"
#include "server/geometry/superquadric.hpp"

namespace mechane::benchmark {

/// How many places the map has: the paper's figures have 100 x 200.
struct PaperGrid {
  int eta = 100;    ///< from pole to pole, both included
  int omega = 200;  ///< once around; even, so that a step over a pole lands on a place
};

/// Where the search looks, seen from the radial guess. The window is equally wide in both, and so is the count of evaluations.
enum class PaperWindow {
  /// On the side that (10) names where the axes that it speaks of are equal and nothing is deformed, as (10) was derived; else to both
  /// sides.
  corrected,
  printed,  ///< on the side that (10) names, whatever the axes
};

/// How far M lies from the superquadric, once P_M is found. Where P_M's normal passes through M both say the same. On a grid it passes
/// beside M by up to half a cell, which the distance feels at once and the way along the normal hardly.
enum class PaperDepth {
  distance,      ///< |M - P_M|, as published
  along_normal,  ///< n (P_M - M)
};

struct PaperSearch {
  PaperWindow window = PaperWindow::corrected;
  PaperDepth depth = PaperDepth::distance;
};

/// What a search found. `hit` as everywhere, with the superquadric's normal; the rest also without a hit, if `inside`.
struct PaperAnswer {
  collision::MapHit hit;
  bool inside = false;  ///< the superquadric: only then was there a search
  int evaluations = 0;  ///< of I_s (13)
  int eta = 0;          ///< the place that it ended on
  int omega = 0;
};

/// D(eta, omega) of (6): from each place of the superquadric's surface, how far along its inward normal the object's surface lies.
/// Three kinds of place: a depth >= 0; a place inside the solid ('covered'), whose distance is negative: as far outwards; and one from
/// which no surface is met ('no hit'), which no point ever touches.
class PaperMap {
 public:
  /// `distances_m` holds a value for each place, omega fastest; NaN is 'no hit'. Kept in 16 bits. Asserts on what is_valid refuses.
  PaperMap(const geometry::Superquadric& shape, const PaperGrid& grid, std::span<const float> distances_m);

  /// A valid superquadric; 16 to 1024 places each way, omega even, from a quarter of eta to eight times it; a value for each, none
  /// infinite.
  [[nodiscard]] static bool is_valid(const geometry::Superquadric& shape, const PaperGrid& grid,
                                     std::span<const float> distances_m);

  /// The angles of a place of such a grid.
  [[nodiscard]] static geometry::SurfaceAngles angles(const PaperGrid& grid, int eta, int omega);

  /// The paper's query. M is inside the superquadric (1); the radial guess (eta_M, omega_M); the pyramid search from it for the place
  /// P_M whose normal passes through M, which maximises I_s (13) in exactly 8 N + 1 evaluations, N of (12); a contact if
  /// |M - P_M| > D(P_M), with depth |M - P_M| - D(P_M) and the superquadric's normal at P_M (16). Departures: what `how` asks for;
  /// neighbours beyond the window's edge or a pole count as neighbours, so that each level below the first has its 8. float32.
  /// Allocates nothing. Any thread.
  [[nodiscard]] PaperAnswer search(const Vec3f& p_QP, const PaperSearch& how = {}) const noexcept;
  [[nodiscard]] collision::MapHit evaluate(const Vec3f& p_QP) const noexcept { return search(p_QP).hit; }

  /// N of (12).
  [[nodiscard]] int levels() const noexcept { return levels_; }
  /// The map with each distance the binomial mean (1 2 1) x (1 2 1) of its own and its eight neighbours', `passes` times over. 'No
  /// hit' and covered places stay as they are and count for nothing in their neighbours: a mean over a rim would be no surface.
  [[nodiscard]] PaperMap smoothed(int passes) const;

  [[nodiscard]] const geometry::Superquadric& shape() const { return shape_; }
  [[nodiscard]] const PaperGrid& grid() const { return grid_; }
  /// D of a place; nothing is 'no hit'.
  [[nodiscard]] std::optional<float> distance_m(int eta, int omega) const;
  /// The object's surface as the map has it: the place moved inwards by D. Nothing is 'no hit'.
  [[nodiscard]] std::optional<Vec3f> surface_Q(int eta, int omega) const;
  /// Of everything that a search reads.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  /// What (5) and (16) have of eta alone, and the deformation at that height.
  struct Row {
    float across, z, n_across, n_z;
    float taper_x, taper_y;
    float rise, reach, sin_gamma, cos_gamma;  // of the bend: (1 - cos gamma)/k, sin gamma/k
  };
  /// What they have of omega alone, with the axes.
  struct Column {
    float x, y, n_x, n_y;
  };
  struct Place {
    Vec3f p_Q;
    Vec3f n_Q;  // outward, of any length
  };
  struct Index {
    int eta, omega;
  };
  struct Guess;
  class Climb;

  void tabulate();
  void bound();
  [[nodiscard]] Place place(Index at) const noexcept;
  [[nodiscard]] Place deformed(const Row& row, Place undeformed) const noexcept;
  [[nodiscard]] bool guess(const Vec3f& p_QP, Guess& out) const noexcept;
  [[nodiscard]] Index wrapped(int eta, int omega) const noexcept;
  [[nodiscard]] std::size_t slot(Index at) const noexcept {
    return static_cast<std::size_t>(at.eta) * static_cast<std::size_t>(grid_.omega) +
           static_cast<std::size_t>(at.omega);
  }
  [[nodiscard]] std::vector<float> distances_m() const;
  void smooth_once(std::vector<float>& distances_m) const;

  geometry::Superquadric shape_;
  geometry::BasicSuperquadric<float> shape_f_;
  PaperGrid grid_;
  int levels_ = 0;
  bool deformed_ = false;
  bool sided_eta_ = false;  // (10) may be trusted
  bool sided_omega_ = false;
  float cos_alpha_ = 1, sin_alpha_ = 0;
  Eigen::AlignedBox3f bound_Q_;  // around the superquadric: what is outside needs no powers
  float step_m_ = 0;
  std::vector<Row> rows_;
  std::vector<Column> columns_;
  std::vector<std::int16_t> values_;  // distance = value * step_m_
};

/// What a map is cast against.
struct PaperTarget {
  const geometry::MeshQuery& surface_O;  ///< the whole object, not the part's piece: seams between parts are not walls
  bool closed = true;                    ///< else there is no solid, and what a ray meets first is the surface
};

/// Casts a ray from each place of the superquadric along its inward normal (6). A surface beyond the superquadric's far side is 'no
/// hit': no point inside is as deep. On all cores; not for a tick.
[[nodiscard]] PaperMap cast_paper_map(const PaperTarget& target, const geometry::Superquadric& shape, const Pose& X_OQ,
                                      const PaperGrid& grid = {});

}  // namespace mechane::benchmark
