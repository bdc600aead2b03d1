// X3D's interpolators and dampers: values that follow a fraction, and values that follow a destination.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "server/agents/event_node.hpp"

namespace mechane::agents {
namespace {

/// Straight from key to key; rotations the shorter way. Before the first key the first value, after the last the last.
class Interpolator final : public EventNode {
 public:
  explicit Interpolator(const EventBuild& build)
      : fraction_(build.port("set_fraction")),
        value_(build.port("value_changed")),
        keys_(build.node.keys),
        values_(build.node.key_values),
        numbers_(keys_.empty() ? 0 : values_.size() / keys_.size()) {}

  void receive(Instant& i, Port /*port*/) const noexcept override {
    if (keys_.empty()) return;
    const double at = i.number(fraction_);
    const auto above = std::ranges::upper_bound(keys_, at);
    if (above == keys_.begin() || above == keys_.end()) {
      i.send(value_, key_value(above == keys_.begin() ? 0 : keys_.size() - 1), numbers_);
      return;
    }
    const auto key = static_cast<std::size_t>(above - keys_.begin());
    const double share = (at - keys_[key - 1]) / (keys_[key] - keys_[key - 1]);
    const double *from = key_value(key - 1), *to = key_value(key);
    if (numbers_ == 4) {
      i.send(value_, Quat(from).slerp(share, Quat(to)));
      return;
    }
    std::array<double, 3> between{};
    for (std::size_t n = 0; n < numbers_; ++n)
      between[n] = from[n] + share * (to[n] - from[n]);
    i.send(value_, between.data(), numbers_);
  }

 private:
  [[nodiscard]] const double* key_value(std::size_t key) const noexcept { return &values_[key * numbers_]; }

  Port fraction_, value_;
  std::span<const double> keys_;    // of the description
  std::span<const double> values_;  // likewise
  std::size_t numbers_;
};

constexpr double kSettled = 1e-6;  // where the file leaves the tolerance to us: m or rad, less than can be seen or felt

/// Up to five filters of first order in a row, all with the time constant tau. The destination stands still during a tick, so the row's
/// exact answer is known: with e_k the distance of filter k from the destination, e_k(t + dt) = exp(-dt/tau) sum_j (dt/tau)^j/j! e_(k-j).
/// Distances of rotations are rotation vectors.
class Damper final : public EventNode {
 public:
  explicit Damper(const EventBuild& build)
      : destination_(build.port("set_destination")),
        set_value_(build.port("set_value")),
        value_(build.port("value_changed")),
        active_(build.port("isActive")),
        tau_(build.port("tau")),
        tolerance_(build.port("tolerance")),
        order_(static_cast<std::size_t>(std::clamp(build.node.order, 0, 5))) {
    for (const state::EventField& field : build.node.fields) {
      if (field.name != "value_changed") continue;
      numbers_ = field.start.size();
      for (std::size_t n = 0; n < order_ * numbers_; ++n) {
        const std::size_t slot = build.slot("filter" + std::to_string(n), field.start[n % numbers_]);
        if (n == 0) filters_ = slot;
      }
    }
  }

  void begin(Instant& i) const noexcept override {
    Distances e{};
    for (std::size_t k = 0; k < order_; ++k)
      e[k] = distance(i, &i.state.memory[filters_ + k * numbers_]);
    if (order_ == 0) e[0] = distance(i, &i.state.memory[value_.slot]);
    if (settled(i, e)) {
      if (i.flag(active_)) i.send(active_, 0.0);
      return;
    }
    if (!i.flag(active_)) i.send(active_, 1.0);
    advance(i, e);
    const bool done = settled(i, e);
    for (std::size_t k = 0; k < order_; ++k)
      write(i, e[k], done, &i.state.memory[filters_ + k * numbers_]);
    std::array<double, 4> value{};
    write(i, e[last()], done, value.data());
    i.send(value_, value.data(), numbers_);
    if (done) i.send(active_, 0.0);
  }

  [[nodiscard]] bool accepts(const Instant& /*instant*/, Port port, const double* value) const noexcept override {
    return port.id != tau_.id || *value >= 0;
  }

  void receive(Instant& i, Port port) const noexcept override {
    if (port.id == set_value_.id) {
      const double* value = &i.state.memory[set_value_.slot];
      for (std::size_t k = 0; k < order_; ++k)
        std::copy_n(value, numbers_, &i.state.memory[filters_ + k * numbers_]);
      i.send(value_, value, numbers_);
    } else if (port.id == destination_.id && (order_ == 0 || i.number(tau_) == 0)) {
      begin(i);  // it follows at once
    }
  }

 private:
  using Distances = std::array<Vec3, 5>;

  [[nodiscard]] std::size_t last() const noexcept { return order_ == 0 ? 0 : order_ - 1; }

  [[nodiscard]] Vec3 distance(const Instant& i, const double* value) const noexcept {
    const double* to = &i.state.memory[destination_.slot];
    if (numbers_ == 4) return rotation_vector(Quat(to).conjugate() * Quat(value));
    Vec3 e = Vec3::Zero();
    for (std::size_t n = 0; n < numbers_; ++n)
      e[static_cast<Eigen::Index>(n)] = value[n] - to[n];
    return e;
  }

  void write(const Instant& i, const Vec3& e, bool at_destination, double* out) const noexcept {
    const double* to = &i.state.memory[destination_.slot];
    if (at_destination) {
      std::copy_n(to, numbers_, out);
    } else if (numbers_ == 4) {
      const Quat R = (Quat(to) * quat_from_rotation_vector(e)).normalized();
      std::copy_n(R.coeffs().data(), 4, out);
    } else {
      for (std::size_t n = 0; n < numbers_; ++n)
        out[n] = to[n] + e[static_cast<Eigen::Index>(n)];
    }
  }

  [[nodiscard]] bool settled(const Instant& i, const Distances& e) const noexcept {
    const double tolerance = i.number(tolerance_) < 0 ? kSettled : i.number(tolerance_);
    return std::all_of(e.begin(), e.begin() + last() + 1, [&](const Vec3& one) { return one.norm() <= tolerance; });
  }

  void advance(const Instant& i, Distances& e) const noexcept {
    if (order_ == 0 || i.number(tau_) <= 0) {
      e = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
      return;
    }
    const double x = i.dt_s / i.number(tau_), decay = std::exp(-x);
    for (std::size_t k = order_; k-- > 0;) {
      Vec3 sum = Vec3::Zero();
      double term = decay;
      for (std::size_t j = 0; j <= k; ++j) {
        sum += term * e[k - j];
        term *= x / static_cast<double>(j + 1);
      }
      e[k] = sum;
    }
  }

  Port destination_, set_value_, value_, active_, tau_, tolerance_;
  std::size_t order_;
  std::size_t numbers_ = 0;  // of the value
  std::size_t filters_ = 0;  // the first one's first slot; the others follow
};

}  // namespace

std::unique_ptr<EventNode> make_interpolator(const EventBuild& build) {
  return std::make_unique<Interpolator>(build);
}
std::unique_ptr<EventNode> make_damper(const EventBuild& build) {
  return std::make_unique<Damper>(build);
}

}  // namespace mechane::agents
