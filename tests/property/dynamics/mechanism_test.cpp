// Rows of a mechanism, drawn at random, are met.
#include "server/dynamics/mechanism.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/property_draw.hpp"

namespace mechane::dynamics {
namespace {

using mechane::test::between;

constexpr std::size_t kBodies = 4;
constexpr std::size_t kMostRows = 24;
constexpr double kMet = 1e-8;

Vec3 any_vector() {
  return {*between(-1, 1), *between(-1, 1), *between(-1, 1)};
}

/// Bodies without joints, and rows on them: first equalities, then such with limits. One in four repeats the row before it.
struct Drawn {
  struct At {
    Row row;
    std::size_t body1;
    std::size_t body2;
  };
  std::vector<Frame> frames{kBodies};
  std::vector<Twist> V{kBodies};
  std::vector<At> rows;
  Mechanism mechanism;

  Drawn() {
    for (std::size_t i = 0; i < kBodies; ++i) {
      frames[i].inverse_mass = *between(0.1, 10);
      frames[i].inverse_inertia_W = Vec3(*between(0.1, 10), *between(0.1, 10), *between(0.1, 10)).asDiagonal();
      V[i] = {any_vector(), any_vector()};
    }
    const std::size_t equalities = *rc::gen::inRange<std::size_t>(0, kMostRows / 2);
    const std::size_t limited = *rc::gen::inRange<std::size_t>(0, kMostRows / 2);
    for (std::size_t i = 0; i < equalities + limited; ++i)
      rows.push_back(any_row(i, i < equalities));
    mechanism.reserve(kMostRows, 2 * kMostRows, kBodies, kBodies);
    mechanism.clear();
    for (const At& at : rows)
      mechanism.add_row(at.row, at.body1, at.body2, frames);
    mechanism.factor();
  }

  At any_row(std::size_t index, bool equality) {
    const bool repeats = index > 0 && *rc::gen::inRange(0, 4) == 0;
    At at;
    if (repeats) {
      at = rows.back();
    } else {
      at.body2 = *rc::gen::inRange<std::size_t>(0, kBodies);
      at.body1 = *rc::gen::element(kGround, (at.body2 + 1) % kBodies);
      at.row.n_W = any_vector();
      at.row.a1_W = any_vector();
      at.row.a2_W = any_vector();
      at.row.target = *between(-1, 1);
    }
    if (equality) return at;
    at.row.min_impulse = *between(-0.1, 0);
    at.row.max_impulse = *between(0, 0.1);
    at.row.softness = *rc::gen::element(0.0, 0.1);
    return at;
  }

  /// How much the row's value lacks of its target at velocities after the step.
  double missing(std::size_t index) {
    const auto& at = rows[index];
    const Row& row = at.row;  // Clang's lambdas take no structured bindings
    double value = row.softness * mechanism.impulse_of(index);
    const auto add = [&](std::size_t body, double sign, const Vec3& arm) {
      if (body == kGround) return;
      value +=
          sign * (row.n_W.dot(V[body].v + mechanism.change(body).v) + arm.dot(V[body].w + mechanism.change(body).w));
    };
    add(at.body2, 1, row.a2_W);
    add(at.body1, -1, row.a1_W);
    return row.target - value;
  }
};

RC_GTEST_PROP(Mechanism, MeetsItsEqualitiesAndThoseWithinTheirLimits, ()) {
  Drawn drawn;
  drawn.mechanism.solve(drawn.V);
  for (std::size_t i = 0; i < drawn.rows.size(); ++i) {
    const Row& row = drawn.rows[i].row;
    const double missing = drawn.missing(i), impulse = drawn.mechanism.impulse_of(i);
    RC_ASSERT(impulse >= row.min_impulse && impulse <= row.max_impulse);
    if (impulse > row.min_impulse) RC_ASSERT(missing > -kMet);
    if (impulse < row.max_impulse) RC_ASSERT(missing < kMet);
  }
}

RC_GTEST_PROP(Mechanism, AnswersForAFewBodiesAsItDoesForAll, ()) {
  Drawn drawn;
  drawn.mechanism.solve(drawn.V);
  const std::span<const std::size_t> some =
      drawn.mechanism.bodies().first(std::min<std::size_t>(2, drawn.mechanism.bodies().size()));
  std::vector<Twist> pushes(some.size()), changes(some.size());
  for (Twist& push : pushes)
    push = {any_vector(), any_vector()};
  drawn.mechanism.condense(some, drawn.frames);
  drawn.mechanism.respond(pushes);
  for (std::size_t i = 0; i < some.size(); ++i) {
    changes[i] = drawn.mechanism.change(some[i]);
    drawn.V[some[i]].v += pushes[i].v;
    drawn.V[some[i]].w += pushes[i].w;
  }
  drawn.mechanism.solve(drawn.V);
  for (std::size_t i = 0; i < some.size(); ++i) {
    RC_ASSERT((changes[i].v - drawn.mechanism.change(some[i]).v).norm() < kMet);
    RC_ASSERT((changes[i].w - drawn.mechanism.change(some[i]).w).norm() < kMet);
  }
}

}  // namespace
}  // namespace mechane::dynamics
