#include "client-sdk/sound/sound_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace mechane::sound {
namespace {

using client::Frame;
using client::SceneObject;
using client::WorldEvent;

constexpr double kLeastGain = 0.01;  ///< quieter sounds are left out
constexpr double kNearest_m = 1.5;
/// No speeds are computed from frames farther apart than this: the display was held up.
constexpr double kLongestStep_s = 0.5;

/// How an effect sounds, and how its pitch follows its amount.
struct EffectSound {
  std::string_view kind;
  SoundKind sound;
  double pitch_none, pitch_full;
};
constexpr std::array<EffectSound, 7> kEffectSounds{{
    {"sound.water", SoundKind::water, 0.85, 1.15},
    {"sound.wood", SoundKind::creak, 0.7, 1.5},
    {"sound.rope", SoundKind::rope, 0.8, 1.4},
    {"sound.stone", SoundKind::scrape, 0.7, 1.2},
    {"sound.fire", SoundKind::fire, 0.9, 1.1},
    {"sound.steam", SoundKind::steam, 0.75, 1.2},
    {"sound.ratchet", SoundKind::ratchet, 0.5, 2.0},
}};

/// The sound of an event, unless an effect specifies it.
struct EventSound {
  std::string_view kind;
  SoundKind sound;
  double gain, pitch;
};
constexpr std::array<EventSound, 10> kEventSounds{{
    {"grasped", SoundKind::knock, 0.25, 1.3},
    {"released", SoundKind::knock, 0.18, 1.1},
    {"placed", SoundKind::knock, 0.8, 1.0},
    {"assembled", SoundKind::thud, 0.8, 1.1},
    {"part_refused", SoundKind::knock, 0.5, 0.7},
    {"pushed", SoundKind::scrape, 0.4, 0.9},
    {"pulled", SoundKind::rope, 0.4, 1.0},
    {"lit", SoundKind::fire, 0.7, 1.2},
    {"broke", SoundKind::knock, 1.0, 0.55},
    {"spilled", SoundKind::splash, 1.0, 1.0},
}};
constexpr double kLoudSpill_m3 = 0.002;

const SceneObject* object_named(const SoundInput& in, const std::string& name) {
  const auto at = std::ranges::find(in.objects, name, &SceneObject::name);
  return at != in.objects.end() && !name.empty() ? &*at : nullptr;
}

Pose pose_of(const SceneObject& object, const Frame& frame) {
  const auto body = std::ranges::find(frame.bodies, object.index, &client::BodyPose::object);
  return body != frame.bodies.end() ? body->X_WB : object.X_WB;
}

/// Where an effect is; none if its object does not exist or is not shown.
std::optional<Vec3> place_of(const SoundEffect& effect, const SoundInput& in, const Frame& frame) {
  if (effect.object < 0) return effect.p_B;
  const auto index = static_cast<std::uint32_t>(effect.object);
  const auto object = std::ranges::find(in.objects, index, &SceneObject::index);
  if (object == in.objects.end()) return {};
  if (index < frame.visible.size() && frame.visible[index] == 0) return {};
  return pose_of(*object, frame) * effect.p_B;
}

/// The speed of the effect's point, or of the rim of a turning thing, m/s.
double speed_of(const SoundEffect& effect, const SoundInput& in) {
  if (in.before == nullptr || effect.object < 0 || in.now->tick <= in.before->tick) return 0;
  const double step_s = static_cast<double>(in.now->tick - in.before->tick) * kTickSeconds;
  const auto index = static_cast<std::uint32_t>(effect.object);
  const auto object = std::ranges::find(in.objects, index, &SceneObject::index);
  if (object == in.objects.end() || step_s > kLongestStep_s) return 0;
  const Pose X_before = pose_of(*object, *in.before);
  const Pose X_now = pose_of(*object, *in.now);
  const double moved_m = (X_now * effect.p_B - X_before * effect.p_B).norm();
  const double turned_rad = rotation_vector(X_now.R * X_before.R.conjugate()).norm();
  return std::max(moved_m, turned_rad * effect.size_m) / step_s;
}

/// The effect's amount as a share (0..1) of its full amount.
double share_of(const SoundEffect& effect, const SoundInput& in) {
  const bool named = effect.quantity >= 0;
  const auto index = static_cast<std::size_t>(effect.quantity);
  if (named && index >= in.now->quantities.size()) return 0;
  const double amount = named ? in.now->quantities[index] : speed_of(effect, in);
  if (!std::isfinite(amount) || !(effect.full > 0)) return 0;
  return std::min(std::abs(amount) / effect.full, 1.0);
}

void add_effects(const SoundInput& in, std::vector<SoundSource>& out) {
  for (const SoundEffect& effect : in.effects) {
    const auto sound = std::ranges::find(kEffectSounds, effect.kind, &EffectSound::kind);
    if (sound == kEffectSounds.end()) continue;
    const double gain = share_of(effect, in);
    const std::optional<Vec3> p_W = place_of(effect, in, *in.now);
    if (gain < kLeastGain || !p_W || !p_W->allFinite()) continue;
    const double pitch = sound->pitch_none + (sound->pitch_full - sound->pitch_none) * gain;
    out.push_back(
        {"effect " + effect.name, sound->sound, *p_W, gain, pitch, std::max(effect.size_m, kNearest_m), true});
  }
}

/// The place of an event: its object, or, if that is not in the picture, where water sounds (for a spill) or something
/// moves.
std::optional<Vec3> place_of(const WorldEvent& event, const SoundInput& in) {
  if (const SceneObject* object = object_named(in, event.object)) return pose_of(*object, *in.now).p;
  for (const SoundEffect& effect : in.effects) {
    if (event.kind == "spilled" && effect.kind == "sound.water") return place_of(effect, in, *in.now);
  }
  const auto moving = std::ranges::find(in.objects, true, &SceneObject::movable);
  if (moving == in.objects.end()) return {};
  return pose_of(*moving, *in.now).p;
}

/// The place of a bowstring is that of the effect sound.bow; without one, that of the shot's object.
std::optional<Vec3> bow_place(const WorldEvent& event, const SoundInput& in) {
  for (const SoundEffect& effect : in.effects) {
    if (effect.kind != "sound.bow") continue;
    const SceneObject* object = object_named(in, event.object);
    const bool meant =
        effect.object < 0 || object == nullptr || object->index == static_cast<std::uint32_t>(effect.object);
    if (meant) return place_of(effect, in, *in.now);
  }
  return place_of(event, in);
}

void add_event(const WorldEvent& event, std::size_t number, const SoundInput& in, std::vector<SoundSource>& out) {
  const std::string id = fmt::format("event {} {} {} {}", event.tick, event.kind, event.object, number);
  const bool fired = event.kind == "fired";
  const std::optional<Vec3> p_W = fired ? bow_place(event, in) : place_of(event, in);
  if (!p_W || !p_W->allFinite()) return;
  if (fired) {
    out.push_back({id, SoundKind::bow, *p_W, 1.0, 1.0, kNearest_m, false});
    return;
  }
  const auto sound = std::ranges::find(kEventSounds, event.kind, &EventSound::kind);
  if (sound == kEventSounds.end()) return;
  double gain = sound->gain;
  if (event.kind == "spilled") {
    if (!(event.value > 0)) return;
    gain *= std::min(std::sqrt(event.value / kLoudSpill_m3), 1.0);
  }
  if (gain >= kLeastGain) out.push_back({id, sound->sound, *p_W, gain, sound->pitch, kNearest_m, false});
}

std::vector<SoundEffect> heard_effects(const client::WorldPresentation* presentation) {
  std::vector<SoundEffect> heard;
  if (presentation == nullptr) return heard;
  for (const client::Effect& effect : presentation->effects) {
    if (!effect.kind.starts_with("sound.")) continue;
    heard.push_back({effect.name, effect.kind, effect.object ? static_cast<std::int32_t>(*effect.object) : -1,
                     effect.p_BE, static_cast<std::int32_t>(effect.quantity), effect.full, effect.size_m});
  }
  return heard;
}

}  // namespace

std::vector<SoundSource> sound_sources(const SoundInput& input) {
  std::vector<SoundSource> sources;
  if (input.now == nullptr) return sources;
  add_effects(input, sources);
  for (std::size_t i = 0; i < input.events.size(); ++i)
    add_event(input.events[i], i, input, sources);
  return sources;
}

std::vector<SoundSource> WorldSounds::hear(const client::Frame* frame, const client::WorldPresentation* presentation,
                                           std::span<const client::SceneObject> objects,
                                           std::span<const client::WorldEvent> events) {
  if (frame == nullptr) {
    before_.reset();
    return {};
  }
  const std::vector<SoundEffect> effects = heard_effects(presentation);
  std::vector<SoundSource> sources = sound_sources({before_ ? &*before_ : nullptr, frame, events, objects, effects});
  before_ = *frame;
  return sources;
}

}  // namespace mechane::sound
