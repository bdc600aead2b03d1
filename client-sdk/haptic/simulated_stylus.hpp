// A stylus on a desktop arm, simulated with what makes real ones shake: little mass and damping, dry friction, encoder
// steps, a delay.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "client-sdk/haptic/device.hpp"
#include "client-sdk/haptic/hand_speed.hpp"
#include "client-sdk/haptic/virtual_device.hpp"

namespace mechane::haptic {

/// As felt at the tip. Mass, friction and resolution are those of the Phantom's class (data sheets); its damping is not
/// published.
struct StylusConfig {
  double mass_kg = 0.075;
  double viscous_ns_per_m = 0.5;
  double coulomb_n = 0.05;
  double resolution_m = 5.5e-5;        ///< of each coordinate; 0: exact
  std::uint32_t delay = 0;             ///< calls of write() after which a force acts; at most 63
  Vec3 load_W = Vec3::Zero();          ///< N, always: its weight, a finger on it
  std::optional<ArmConfig> hand = {};  ///< none: nobody holds it
  /// What its motors bear all day.
  double continuous_n = hand::GovernorConfig{}.max_force_n;
};

/// The tip moves as a point mass, in steps of 20 us; a force is held from one call of read() to the next. Its rotation
/// is the intended one. One thread.
class SimulatedStylus final : public SimulatedDevice {
 public:
  /// At rest at `p_WH`.
  explicit SimulatedStylus(const StylusConfig& config, const Vec3& p_WH = Vec3::Zero()) : config_(config), p_WH_(p_WH) {
    intent_.X_WH.p = p_WH;
  }

  [[nodiscard]] Expected<void> open() override { return {}; }
  void close() noexcept override {}
  /// The place as its encoders tell it, and the velocity that follows from such places.
  [[nodiscard]] client::HandSample read(Duration dt) noexcept override;
  void write(const hand::HandForce& force) noexcept override {
    written_[++writes_ % written_.size()] = force.force_W.f;
  }
  [[nodiscard]] hand::GovernorConfig limits() const override { return {}; }
  [[nodiscard]] double continuous_force_n() const override { return config_.continuous_n; }

  /// Of the intent, place, rotation and grasp count: a stylus is one point.
  void intend(const HandIntent& intent) noexcept override { intent_ = intent; }
  void intend(const Vec3& p_WH) noexcept { intent_.X_WH.p = p_WH; }
  /// A hit.
  void push(const Vec3& v_WH) noexcept { v_WH_ = v_WH; }
  /// Where it really is.
  [[nodiscard]] const Vec3& p_WH() const noexcept { return p_WH_; }
  [[nodiscard]] const Vec3& force_W() const noexcept override {
    return written_[(writes_ + written_.size() - config_.delay) % written_.size()];
  }

 private:
  [[nodiscard]] Vec3 rounded(const Vec3& p) const noexcept;
  void move(double dt_s) noexcept;

  StylusConfig config_;
  Vec3 p_WH_;
  Vec3 v_WH_ = Vec3::Zero();
  HandIntent intent_;
  HandSpeed speed_;
  std::array<Vec3, 64> written_ = filled();
  std::uint64_t writes_ = 0;

  static std::array<Vec3, 64> filled() {
    std::array<Vec3, 64> none;
    none.fill(Vec3::Zero());
    return none;
  }
};

}  // namespace mechane::haptic
