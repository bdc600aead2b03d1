#include "server/dynamics/mechanism.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "server/base/assert.hpp"

namespace mechane::dynamics {
namespace {

// Of a row's response: a row with less left, once the others are taken off, repeats them; the rest is rounding.
constexpr double kRepeated = 1e-9;
constexpr double kSoftened = 1e-9;  // of a row's response, where rows with limits may repeat each other
constexpr std::size_t kAxes = 6;    // in which a body moves
constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr int kMostSweeps = 60;
constexpr int kMostWays = 24;        // of one leap: each that ends at a limit costs a new factor of the rest
constexpr double kResidual = 1e-20;  // (m/s)^2: the sweeps end when no row changes by more than 1e-10 m/s

/// The sum of products of two rows of a factor, from one column to before another. In four parts, because a processor adds four numbers
/// at once, but only one after another to the same sum.
double product(const double* a, const double* b, std::size_t from, std::size_t end) {
  std::array<double, 4> sums{};
  std::size_t k = from;
  for (; k + sums.size() <= end; k += sums.size()) {
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] += a[k + i] * b[k + i];
  }
  for (; k < end; ++k)
    sums[0] += a[k] * b[k];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

void Mechanism::reserve(std::size_t rows, std::size_t terms, std::size_t bodies, std::size_t tied) {
  rows_.reserve(rows);
  terms_.reserve(terms);
  solved_.reserve(rows);
  for (std::vector<std::size_t>* list : {&equal_, &limited_, &free_})
    list->reserve(rows);
  bodies_.reserve(bodies);
  first_of_.resize(bodies);
  seen_.resize(bodies);
  next_.resize(bodies);
  end_of_.resize(bodies);
  change_.resize(bodies);
  for (std::vector<double>* matrix : {&factor_, &matrix_, &free_factor_})
    matrix->resize(rows_.capacity() * rows_.capacity());
  for (std::vector<double>* values : {&left_, &wanted_, &impulses_, &step_})
    values->resize(rows);
  const std::size_t columns = 1 + kAxes * tied;
  columns_.resize(columns * rows_.capacity());
  products_.resize(columns * columns);
  pushes_.resize(columns);
}

void Mechanism::clear() noexcept {
  rows_.clear();
  terms_.clear();
  solved_.clear();
  equal_.clear();
  limited_.clear();
  for (const std::size_t body : bodies_)
    seen_[body] = 0;
  bodies_.clear();
  factored_ = 0;
}

std::size_t Mechanism::add(const MechanismRow& row) noexcept {
  MECHANE_ASSERT(rows_.size() < rows_.capacity());
  rows_.push_back(row);
  Solved& solved = solved_.emplace_back();
  solved.first_term = solved.end_term = terms_.size();
  return rows_.size() - 1;
}

void Mechanism::add_term(std::size_t body, const Vec3& n_W, const Vec3& a_W, std::span<const Frame> frames) noexcept {
  if (body == kGround || frames[body].inverse_mass <= 0) return;
  const Vec3 v_per_impulse = frames[body].inverse_mass * n_W;
  const Vec3 w_per_impulse = frames[body].inverse_inertia_W * a_W;
  for (std::size_t i = solved_.back().first_term; i < terms_.size(); ++i) {
    if (terms_[i].body != body) continue;
    terms_[i].n_W += n_W;
    terms_[i].a_W += a_W;
    terms_[i].v_per_impulse += v_per_impulse;
    terms_[i].w_per_impulse += w_per_impulse;
    return;
  }
  MECHANE_ASSERT(terms_.size() < terms_.capacity());
  terms_.push_back({body, n_W, a_W, v_per_impulse, w_per_impulse});
  solved_.back().end_term = terms_.size();
}

void Mechanism::add_terms(const Row& row, std::size_t body1, std::size_t body2, double factor,
                          std::span<const Frame> frames) noexcept {
  add_term(body2, factor * row.n_W, factor * row.a2_W, frames);
  add_term(body1, -factor * row.n_W, -factor * row.a1_W, frames);
}

std::size_t Mechanism::add_row(const Row& row, std::size_t body1, std::size_t body2,
                               std::span<const Frame> frames) noexcept {
  const bool equality = row.min_impulse == -kUnlimited && row.max_impulse == kUnlimited;
  const std::size_t index =
      add({row.target, equality ? RowLimit::none : RowLimit::range, 0, row.min_impulse, row.max_impulse, row.softness});
  add_terms(row, body1, body2, 1, frames);
  return index;
}

/// How much row a's value changes by an impulse of 1 along row b.
double Mechanism::shared(std::size_t a, std::size_t b) const noexcept {
  double sum = 0;
  for (const Term& of_a : terms_of(a)) {
    for (const Term& of_b : terms_of(b)) {
      if (of_a.body == of_b.body) sum += of_a.n_W.dot(of_b.v_per_impulse) + of_a.a_W.dot(of_b.w_per_impulse);
    }
  }
  return sum;
}

/// The body that stands for all that rows tie to this one.
std::size_t Mechanism::group_of(std::size_t body) noexcept {
  while (next_[body] != body)
    body = next_[body] = next_[next_[body]];
  return body;
}

/// Sorts new rows into equalities and others, and finds their bodies and which of these they tie together.
void Mechanism::collect(std::size_t from) noexcept {
  for (std::size_t i = from; i < rows_.size(); ++i) {
    const bool equality = rows_[i].limit == RowLimit::none;
    std::vector<std::size_t>& list = equality ? equal_ : limited_;
    solved_[i].place = list.size();
    solved_[i].response = rows_[i].softness + shared(i, i);
    list.push_back(i);
    for (const Term& term : terms_of(i)) {
      const std::size_t body = term.body;
      if (seen_[body] == 0) {
        seen_[body] = 1;
        bodies_.push_back(body);
        first_of_[body] = kGround;
        next_[body] = body;
        end_of_[body] = 0;
      }
      const std::size_t of_row = group_of(terms_of(i).front().body), other = group_of(body);
      next_[other] = of_row;
      end_of_[of_row] = std::max({end_of_[of_row], end_of_[other], equality ? equal_.size() : 0});
    }
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!terms_of(i).empty()) solved_[i].group = group_of(terms_of(i).front().body);
  }
}

/// Makes the row's coefficients over the first `before` equalities, and returns what is left of its response without them.
double Mechanism::eliminate(std::size_t row, std::size_t before) noexcept {
  Solved& own = solved_[row];
  own.first = before;
  for (const Term& term : terms_of(row))
    own.first = std::min(own.first, first_of_[term.body]);
  own.end = own.group == kGround ? before : std::min(before, end_of_[own.group]);
  double* of_row = factor_of(row);
  double left = own.response;
  for (std::size_t j = own.first; j < own.end; ++j) {
    const Solved& other = solved_[equal_[j]];
    if (other.group != own.group) {
      of_row[j] = 0;  // they share nothing
      continue;
    }
    const double* of_other = factor_of(equal_[j]);
    const double rest = shared(row, equal_[j]) - product(of_row, of_other, std::max(own.first, other.first), j);
    of_row[j] = rest * other.inverse;
    left -= of_row[j] * of_row[j];
  }
  return left > kRepeated * own.response ? left : 0;
}

/// One row of the matrix over the limited rows, up to its diagonal, and the same column.
void Mechanism::fill_matrix(std::size_t place) noexcept {
  const std::size_t row = limited_[place];
  for (std::size_t other = 0; other < place; ++other) {
    const Solved &own = solved_[row], &of_other = solved_[limited_[other]];
    matrix_of(place)[other] = matrix_of(other)[place] = 0;
    if (of_other.group != own.group) continue;
    const double value =
        shared(row, limited_[other]) - product(factor_of(row), factor_of(limited_[other]),
                                               std::max(own.first, of_other.first), std::min(own.end, of_other.end));
    matrix_of(place)[other] = matrix_of(other)[place] = value;
  }
}

void Mechanism::factor() noexcept {
  const std::size_t equalities = equal_.size(), limited = limited_.size();
  collect(factored_);
  MECHANE_ASSERT(factored_ == 0 || equal_.size() == equalities);
  factored_ = rows_.size();
  for (std::size_t k = equalities; k < equal_.size(); ++k) {
    const double left = eliminate(equal_[k], k);
    solved_[equal_[k]].inverse = left > 0 ? 1 / std::sqrt(left) : 0;
    for (const Term& term : terms_of(equal_[k]))
      first_of_[term.body] = std::min(first_of_[term.body], k);
  }
  for (std::size_t place = limited; place < limited_.size(); ++place) {
    matrix_of(place)[place] = eliminate(limited_[place], equal_.size());
    fill_matrix(place);
    impulses_[place] = 0;
  }
}

void Mechanism::solve(std::span<const Twist> V) noexcept {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    double& wanted = solved_[i].wanted;
    wanted = rows_[i].target;
    for (const Term& term : terms_of(i))
      wanted -= term.n_W.dot(V[term.body].v) + term.a_W.dot(V[term.body].w);
  }
  meet_equalities();
  solve_limited();
  spread();
}

/// From what all rows want to what is left for the limited ones once the equalities have it.
void Mechanism::meet_equalities() noexcept {
  for (std::size_t k = 0; k < equal_.size(); ++k) {
    const Solved& row = solved_[equal_[k]];
    left_[k] = (row.wanted - product(factor_of(equal_[k]), left_.data(), row.first, k)) * row.inverse;
  }
  for (std::size_t place = 0; place < limited_.size(); ++place) {
    const Solved& row = solved_[limited_[place]];
    wanted_[place] = row.wanted - product(factor_of(limited_[place]), left_.data(), row.first, row.end);
  }
}

void Mechanism::make_column(std::size_t column) noexcept {
  meet_equalities();
  std::copy_n(left_.begin(), equal_.size(), column_of(column));
  std::copy_n(wanted_.begin(), limited_.size(), column_of(column) + equal_.size());
}

void Mechanism::condense(std::span<const std::size_t> bodies, std::span<const Frame> frames) noexcept {
  condensed_ = bodies;
  frames_ = frames;
  make_column(0);
  const std::size_t columns = 1 + kAxes * bodies.size();
  MECHANE_ASSERT(columns <= pushes_.size());
  for (std::size_t column = 1; column < columns; ++column) {
    const std::size_t body = bodies[(column - 1) / kAxes];
    const auto axis = static_cast<Eigen::Index>((column - 1) % kAxes);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      solved_[i].wanted = 0;
      for (const Term& term : terms_of(i)) {
        if (term.body == body) solved_[i].wanted = axis < 3 ? term.n_W[axis] : term.a_W[axis - 3];
      }
    }
    make_column(column);
    for (std::size_t other = 0; other <= column; ++other) {
      const double both = product(column_of(column), column_of(other), 0, equal_.size());
      products_[column * columns + other] = products_[other * columns + column] = both;
    }
  }
}

void Mechanism::respond(std::span<const Twist> pushes) noexcept {
  const std::size_t columns = 1 + kAxes * condensed_.size();
  pushes_[0] = -1;  // column 0 is what the rows want while nothing pushes the bodies
  for (std::size_t column = 1; column < columns; ++column) {
    const Twist& push = pushes[(column - 1) / kAxes];
    const auto axis = static_cast<Eigen::Index>((column - 1) % kAxes);
    pushes_[column] = axis < 3 ? push.v[axis] : push.w[axis - 3];
  }
  for (std::size_t place = 0; place < limited_.size(); ++place) {
    wanted_[place] = 0;
    for (std::size_t column = 0; column < columns; ++column)
      wanted_[place] -= pushes_[column] * column_of(column)[equal_.size() + place];
  }
  solve_limited();
  for (std::size_t i = 0; i < condensed_.size(); ++i) {
    std::array<double, kAxes> impulse{};
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      const std::size_t column = 1 + kAxes * i + axis;
      impulse[axis] = product(column_of(column) + equal_.size(), impulses_.data(), 0, limited_.size()) -
                      product(&products_[column * columns], pushes_.data(), 0, columns);
    }
    const Frame& frame = frames_[condensed_[i]];
    change_[condensed_[i]] = {frame.inverse_mass * Vec3(impulse[0], impulse[1], impulse[2]),
                              frame.inverse_inertia_W * Vec3(impulse[3], impulse[4], impulse[5])};
  }
}

/// Gauss-Seidel, with a direct solution of what is within its limits in between.
void Mechanism::solve_limited() noexcept {
  for (int sweeps = 1; sweeps <= kMostSweeps; ++sweeps) {
    if (sweep() <= kResidual) return;
    if (sweeps % 2 == 0) leap();
  }
}

std::pair<double, double> Mechanism::limits_of(std::size_t index) const noexcept {
  const MechanismRow& row = rows_[index];
  switch (row.limit) {
    case RowLimit::none:
      break;
    case RowLimit::range:
      return {row.low, row.high};
    case RowLimit::friction: {
      const double most = row.high * std::abs(impulses_[solved_[row.leader].place]);
      return {-most, most};
    }
    case RowLimit::sheave: {
      double tension = 0;
      for (std::size_t k = row.leader; k < index; ++k)
        tension -= impulses_[solved_[k].place];
      tension = std::max(0.0, tension);
      return {row.low * tension, row.high * tension};
    }
  }
  return {-kUnlimited, kUnlimited};
}

/// Goes once over the limited rows. Returns the square of the greatest change of a row's value.
double Mechanism::sweep() noexcept {
  double residual = 0;
  for (std::size_t place = 0; place < limited_.size(); ++place) {
    const double* of_row = matrix_of(place);
    const double response = of_row[place];
    if (response <= 0) continue;
    const double missing = wanted_[place] - product(of_row, impulses_.data(), 0, limited_.size());
    const auto [low, high] = limits_of(limited_[place]);
    const double impulse = std::clamp(impulses_[place] + missing / response, low, high);
    const double change = (impulse - impulses_[place]) * response;
    impulses_[place] = impulse;
    residual = std::max(residual, change * change);
  }
  return residual;
}

/// Goes from the impulses to those that meet all rows which are within their limits. A row that comes to its limit on the way stays
/// there, and the way goes on without it.
void Mechanism::leap() noexcept {
  free_.clear();
  for (std::size_t place = 0; place < limited_.size(); ++place) {
    const auto [low, high] = limits_of(limited_[place]);
    if (matrix_of(place)[place] > 0 && impulses_[place] > low && impulses_[place] < high) free_.push_back(place);
  }
  for (int ways = 0; ways < kMostWays && !free_.empty(); ++ways) {
    solve_free();
    if (go_as_far_as_limits()) return;
  }
}

/// The step to the impulses that meet the free rows. Rows that repeat others are made a little softer, so that the matrix has an
/// inverse: where they agree, each bears a share; where they do not, the step is so long that one of them comes to its limit.
void Mechanism::solve_free() noexcept {
  const std::size_t stride = rows_.capacity();
  for (std::size_t i = 0; i < free_.size(); ++i) {
    double* of_row = &free_factor_[i * stride];
    const double* matrix = matrix_of(free_[i]);
    double left = (1 + kSoftened) * matrix[free_[i]];
    for (std::size_t j = 0; j < i; ++j) {
      const double* of_other = &free_factor_[j * stride];
      of_row[j] = (matrix[free_[j]] - product(of_row, of_other, 0, j)) * of_other[j];
      left -= of_row[j] * of_row[j];
    }
    of_row[i] = 1 / std::sqrt(std::max(left, kSoftened * matrix[free_[i]]));  // the diagonal holds its inverse
    const double missing = wanted_[free_[i]] - product(matrix, impulses_.data(), 0, limited_.size());
    step_[i] = (missing - product(of_row, step_.data(), 0, i)) * of_row[i];
  }
  for (std::size_t i = free_.size(); i-- > 0;) {
    const double* of_row = &free_factor_[i * stride];
    step_[i] *= of_row[i];
    for (std::size_t j = 0; j < i; ++j)
      step_[j] -= of_row[j] * step_[i];
  }
}

/// Takes the step, or as much of it as the limits allow; then the row that came to its limit is free no more. True: all of it.
bool Mechanism::go_as_far_as_limits() noexcept {
  double share = 1;
  std::size_t first = free_.size();
  double at = 0;
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const auto [low, high] = limits_of(limited_[free_[i]]);
    const double limit = step_[i] > 0 ? high : low;
    const double most = limit - impulses_[free_[i]];
    if (std::abs(step_[i]) * share <= std::abs(most)) continue;
    share = most / step_[i];
    first = i;
    at = limit;
  }
  for (std::size_t i = 0; i < free_.size(); ++i)
    impulses_[free_[i]] += share * step_[i];
  if (first == free_.size()) return true;
  impulses_[free_[first]] = at;
  free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(first));
  return false;
}

/// From the impulses of the limited rows to those of the equalities, and what all do to the bodies.
void Mechanism::spread() noexcept {
  for (std::size_t place = 0; place < limited_.size(); ++place) {
    const double impulse = solved_[limited_[place]].impulse = impulses_[place];
    if (impulse == 0) continue;
    const double* of_row = factor_of(limited_[place]);
    for (std::size_t j = solved_[limited_[place]].first; j < solved_[limited_[place]].end; ++j)
      left_[j] -= of_row[j] * impulse;
  }
  for (std::size_t k = equal_.size(); k-- > 0;) {
    Solved& row = solved_[equal_[k]];
    row.impulse = left_[k] * row.inverse;
    const double* of_row = factor_of(equal_[k]);
    for (std::size_t j = row.first; j < k; ++j)
      left_[j] -= of_row[j] * row.impulse;
  }
  for (const std::size_t body : bodies_)
    change_[body] = {};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (const Term& term : terms_of(i)) {
      change_[term.body].v += solved_[i].impulse * term.v_per_impulse;
      change_[term.body].w += solved_[i].impulse * term.w_per_impulse;
    }
  }
}

}  // namespace mechane::dynamics
