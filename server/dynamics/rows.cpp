#include "server/dynamics/rows.hpp"

namespace mechane::dynamics {
namespace {

constexpr int kMostLocked = 6;
/// On the stack, whatever the count.
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostLocked, kMostLocked>;

/// How much row a's value changes by a unit impulse along row b.
double response(const Row& a, const Row& b, const Frame& body1, const Frame& body2) {
  return a.n_W.dot(b.n_W) * (body1.inverse_mass + body2.inverse_mass) + a.a1_W.dot(body1.inverse_inertia_W * b.a1_W) +
         a.a2_W.dot(body2.inverse_inertia_W * b.a2_W);
}

void add_scaled(const Row& from, double share, Row& to) {
  to.n_W += share * from.n_W;
  to.a1_W += share * from.a1_W;
  to.a2_W += share * from.a2_W;
  to.target += share * from.target;
}

}  // namespace

void decouple(const Frame& body1, const Frame& body2, std::size_t locked, RowSet& rows) noexcept {
  const auto count = static_cast<Eigen::Index>(locked);
  Small K(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      K(i, j) = K(j, i) =
          response(rows.rows[static_cast<std::size_t>(i)], rows.rows[static_cast<std::size_t>(j)], body1, body2);
  }
  const Eigen::LLT<Small> factor(K);
  if (factor.info() != Eigen::Success) return;
  const Small L = factor.matrixL();
  const double smallest = L.diagonal().minCoeff(), largest = L.diagonal().maxCoeff();
  if (!(smallest > 1e-7 * largest)) return;

  // Forward substitution on the rows themselves: row_i becomes (row_i - sum_j L_ij row_j) / L_ii.
  for (Eigen::Index i = 0; i < count; ++i) {
    Row& row = rows.rows[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < i; ++j)
      add_scaled(rows.rows[static_cast<std::size_t>(j)], -L(i, j), row);
    const double size = 1 / L(i, i);
    row.n_W *= size;
    row.a1_W *= size;
    row.a2_W *= size;
    row.target *= size;
  }
  for (std::size_t i = locked; i < rows.count; ++i) {
    const Row original = rows.rows[i];
    for (std::size_t j = 0; j < locked; ++j)
      add_scaled(rows.rows[j], -response(original, rows.rows[j], body1, body2), rows.rows[i]);
  }
}

}  // namespace mechane::dynamics
