#include "client-sdk/scene/effect_builder.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::scene {
namespace {

constexpr double kLeastWidth_m = 0.004;  // thinner than a drop, nothing is visible
constexpr double kMostWidth_m = 0.25;
constexpr double kFastestJet_m_per_s = 15;
constexpr double kFastestRiver_m_per_s = 5;

/// Factor from a unit of flow to m^3/s; 1 for other units.
double flow_scale(const std::string& unit) {
  if (unit == "l/s" || unit == "kg/s") return 1e-3;
  return unit == "l/min" ? 1e-3 / 60 : 1;
}

/// Water from a lip (a stream, whose width depends on the flow) or under pressure from a bore (a jet, whose speed
/// does).
std::optional<picture::WaterStream> water_of(const client::Effect& effect, double flow_m3_per_s, const Pose& X_WB,
                                             float landing_height_m) {
  picture::WaterStream stream;
  double speed_m_per_s = effect.speed_m_per_s;
  double width_m = 0;
  if (effect.kind == "jet") {
    stream.jet = true;
    width_m = effect.size_m;
    speed_m_per_s = flow_m3_per_s / (kPi / 4 * width_m * width_m);
    if (speed_m_per_s < 0.02) return std::nullopt;
  } else {
    width_m = stream_width_m(flow_m3_per_s, speed_m_per_s);
    if (width_m < kLeastWidth_m) return std::nullopt;
  }
  stream.p_WS = (X_WB * effect.p_BE).cast<float>();
  stream.v_W = (std::min(speed_m_per_s, kFastestJet_m_per_s) * X_WB.rotate(effect.direction_B)).cast<float>();
  stream.width_m = static_cast<float>(std::min(width_m, kMostWidth_m));
  stream.landing_height_m = landing_height_m;
  return stream;
}

std::optional<picture::ParticleEffect::Kind> particles_of(const std::string& kind) {
  using Kind = picture::ParticleEffect::Kind;
  static constexpr std::pair<std::string_view, Kind> kKinds[] = {{"steam", Kind::steam},
                                                                 {"smoke", Kind::smoke},
                                                                 {"fire", Kind::fire},
                                                                 {"dust", Kind::dust},
                                                                 {"spray", Kind::spray}};
  for (const auto& [name, value] : kKinds) {
    if (name == kind) return value;
  }
  return std::nullopt;
}

}  // namespace

double quantity_value(const client::Frame& frame, const client::WorldStatus& status, std::uint32_t quantity) {
  if (quantity >= frame.quantities.size() || quantity >= status.quantities.size()) return 0;
  return flow_scale(status.quantities[quantity].unit) * frame.quantities[quantity];
}

double effect_strength(const client::Effect& effect, const client::Frame& frame) {
  if (effect.quantity >= frame.quantities.size()) return 0;
  return std::clamp(std::abs(frame.quantities[effect.quantity]) / effect.full, 0.0, 1.0);
}

double stream_width_m(double flow_m3_per_s, double speed_m_per_s) {
  // Area of the ellipse: pi/4 * width * 0.45 width.
  return flow_m3_per_s > 0 ? std::sqrt(flow_m3_per_s / (std::max(speed_m_per_s, 0.05) * 0.45 * kPi / 4)) : 0;
}

std::optional<double> level_of(const client::WorldPresentation& presentation, const client::Frame& frame,
                               const std::string& node) {
  for (const client::Effect& effect : presentation.effects) {
    if (effect.kind != "level" || effect.node != node || effect.quantity >= frame.quantities.size()) continue;
    return std::clamp(frame.quantities[effect.quantity], 0.0, 5.0);
  }
  return std::nullopt;
}

Vec3 flow_of(const client::WorldPresentation& presentation, const std::string& node) {
  for (const client::Effect& effect : presentation.effects) {
    if (effect.kind != "flow" || effect.node != node) continue;
    const Vec3 level_W(effect.direction_B.x(), 0, effect.direction_B.z());
    if (level_W.norm() < 0.05) return Vec3::Zero();
    return std::clamp(effect.speed_m_per_s, 0.0, kFastestRiver_m_per_s) * level_W.normalized();
  }
  return Vec3::Zero();
}

void add_effects(const client::WorldPresentation& presentation, const client::Frame& frame,
                 const client::WorldStatus& status, const std::function<Pose(std::uint32_t)>& pose_of,
                 float landing_height_m, picture::RenderScene& out) {
  for (const client::Effect& effect : presentation.effects) {
    const Pose X_WB = effect.object ? pose_of(*effect.object) : Pose{};
    if (effect.kind == "stream" || effect.kind == "jet") {
      const double flow = quantity_value(frame, status, effect.quantity);
      if (const auto stream = water_of(effect, flow, X_WB, landing_height_m)) out.streams.push_back(*stream);
    } else if (const auto kind = particles_of(effect.kind)) {
      const double strength = effect_strength(effect, frame);
      if (strength <= 0) continue;
      picture::ParticleEffect& particles = out.effects.emplace_back();
      particles.kind = *kind;
      particles.p_W = (X_WB * effect.p_BE).cast<float>();
      particles.direction_W = X_WB.rotate(effect.direction_B).cast<float>();
      particles.intensity = static_cast<float>(strength);
      particles.size_m = static_cast<float>(effect.size_m);
      particles.speed_m_per_s = static_cast<float>(effect.speed_m_per_s);
    }
  }
}

}  // namespace mechane::scene
