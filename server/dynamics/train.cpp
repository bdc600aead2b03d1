#include "server/dynamics/train.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/assert.hpp"

namespace mechane::dynamics {
namespace {

// Of a row's response: a row with less left, once the others are taken off, repeats them; the rest is rounding.
constexpr double kRepeated = 1e-9;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

TrainTerm* term_of(TrainRow& row, std::size_t body) {
  for (TrainTerm& term : row.terms) {
    if (term.body == body) return &term;
  }
  return nullptr;
}

}  // namespace

void Train::reserve(std::size_t rows, std::size_t bodies) {
  rows_.resize(rows);
  for (TrainRow& row : rows_)
    row.terms.reserve(bodies);
  mix_.resize(rows * rows);
  bodies_.reserve(bodies);
  seen_.resize(bodies);
  count_ = 0;
}

std::size_t Train::add(double target, TrainLimit limit, double low, double high, std::size_t leader) noexcept {
  MECHANE_ASSERT(count_ < rows_.size());
  TrainRow& row = rows_[count_];
  row.terms.clear();
  row.target = target;
  row.limit = limit;
  row.low = low;
  row.high = high;
  row.leader = leader;
  row.impulse = 0;
  return count_++;
}

void Train::add_term(std::size_t body, const Vec3& n_W, const Vec3& a_W, std::span<const Frame> frames) noexcept {
  if (body == kGround || frames[body].inverse_mass <= 0) return;
  TrainRow& row = rows_[count_ - 1];
  if (TrainTerm* term = term_of(row, body)) {
    term->n_W += n_W;
    term->a_W += a_W;
  } else {
    row.terms.push_back({body, n_W, a_W, Vec3::Zero(), Vec3::Zero()});
  }
}

void Train::add_row(const Row& row, std::size_t body1, std::size_t body2, double factor,
                    std::span<const Frame> frames) noexcept {
  add_term(body2, factor * row.n_W, factor * row.a2_W, frames);
  add_term(body1, -factor * row.n_W, -factor * row.a1_W, frames);
  rows_[count_ - 1].target += factor * row.target;
}

void Train::respond(TrainRow& row, std::span<const Frame> frames) noexcept {
  row.response = 0;
  for (TrainTerm& term : row.terms) {
    const Frame& body = frames[term.body];
    term.v_per_impulse = body.inverse_mass * term.n_W;
    term.w_per_impulse = body.inverse_inertia_W * term.a_W;
    row.response += term.n_W.dot(term.v_per_impulse) + term.a_W.dot(term.w_per_impulse);
  }
}

double Train::response(const TrainRow& a, const TrainRow& b) noexcept {
  double sum = 0;
  for (const TrainTerm& of_a : a.terms) {
    for (const TrainTerm& of_b : b.terms) {
      if (of_a.body != of_b.body) continue;
      sum += of_a.n_W.dot(of_b.v_per_impulse) + of_a.a_W.dot(of_b.w_per_impulse);
    }
  }
  return sum;
}

void Train::subtract(std::size_t from, std::size_t other, double share) noexcept {
  TrainRow& row = rows_[from];
  for (const TrainTerm& term : rows_[other].terms) {
    TrainTerm* own = term_of(row, term.body);
    if (own == nullptr) own = &row.terms.emplace_back(TrainTerm{term.body, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    own->n_W -= share * term.n_W;
    own->a_W -= share * term.a_W;
    own->v_per_impulse -= share * term.v_per_impulse;
    own->w_per_impulse -= share * term.w_per_impulse;
  }
  row.target -= share * rows_[other].target;
  for (std::size_t k = 0; k < count_; ++k)
    mix_[from * rows_.size() + k] -= share * mixed(other, k);
}

void Train::scale(std::size_t index, double factor) noexcept {
  TrainRow& row = rows_[index];
  for (TrainTerm& term : row.terms) {
    term.n_W *= factor;
    term.a_W *= factor;
    term.v_per_impulse *= factor;
    term.w_per_impulse *= factor;
  }
  row.target *= factor;
  for (std::size_t k = 0; k < count_; ++k)
    mix_[index * rows_.size() + k] *= factor;
}

void Train::combine(std::span<const Frame> frames) noexcept {
  for (const std::size_t body : bodies_)
    seen_[body] = 0;
  bodies_.clear();
  for (const TrainRow& row : rows()) {
    for (const TrainTerm& term : row.terms) {
      if (seen_[term.body] == 0) bodies_.push_back(term.body);
      seen_[term.body] = 1;
    }
  }
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t k = 0; k < count_; ++k)
      mix_[i * rows_.size() + k] = i == k ? 1 : 0;
    respond(rows_[i], frames);
  }
  for (const bool equalities : {true, false}) {
    for (std::size_t i = 0; i < count_; ++i) {
      TrainRow& row = rows_[i];
      if ((row.limit == TrainLimit::none) != equalities) continue;
      const double before = row.response;
      const std::size_t end = equalities ? i : count_;
      for (std::size_t j = 0; j < end; ++j) {
        if (rows_[j].limit == TrainLimit::none && rows_[j].response > 0) subtract(i, j, response(row, rows_[j]));
      }
      row.response = response(row, row);
      if (!(row.response > kRepeated * before)) {
        row.response = 0;
      } else if (equalities) {
        scale(i, 1 / std::sqrt(row.response));
        row.response = 1;
      }
    }
  }
}

void Train::begin(std::span<const Twist> V) noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    TrainRow& row = rows_[i];
    row.wanted = row.target;
    for (const TrainTerm& term : row.terms)
      row.wanted -= term.n_W.dot(V[term.body].v) + term.a_W.dot(V[term.body].w);
  }
}

std::pair<double, double> Train::limits_of(std::size_t i) const noexcept {
  const TrainRow& row = rows_[i];
  switch (row.limit) {
    case TrainLimit::none:
      break;
    case TrainLimit::range:
      return {row.low, row.high};
    case TrainLimit::friction: {
      const double most = row.high * std::abs(impulse_of(row.leader));
      return {-most, most};
    }
    case TrainLimit::sheave: {
      double tension = 0;
      for (std::size_t k = row.leader; k < i; ++k)
        tension -= rows_[k].impulse;
      tension = std::max(0.0, tension);
      return {row.low * tension, row.high * tension};
    }
  }
  return {-kUnlimited, kUnlimited};
}

double Train::sweep(std::span<Twist> delta) noexcept {
  double residual = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    TrainRow& row = rows_[i];
    if (row.response <= 0) continue;
    double value = 0;
    for (const TrainTerm& term : row.terms)
      value += term.n_W.dot(delta[term.body].v) + term.a_W.dot(delta[term.body].w);
    const auto [low, high] = limits_of(i);
    const double impulse = std::clamp(row.impulse + (row.wanted - value) / row.response, low, high);
    const double change = impulse - row.impulse;
    row.impulse = impulse;
    for (const TrainTerm& term : row.terms) {
      delta[term.body].v += change * term.v_per_impulse;
      delta[term.body].w += change * term.w_per_impulse;
    }
    residual = std::max(residual, change * row.response * (change * row.response));
  }
  return residual;
}

double Train::impulse_of(std::size_t row) const noexcept {
  double impulse = 0;
  for (std::size_t i = 0; i < count_; ++i)
    impulse += mixed(i, row) * rows_[i].impulse;
  return impulse;
}

}  // namespace mechane::dynamics
