// Ticks for tests of the journal: any inputs that a world could get, unusual doubles included.
#pragma once

#include <bit>
#include <cstring>
#include <vector>

#include <rapidcheck.h>

#include "server/record/journal_reader.hpp"
#include "server/record/journal_writer.hpp"
#include "server/record/tick_record.hpp"

namespace mechane::record {

/// A tick as a world had it, to be written and compared.
struct WorldTick {
  std::uint64_t tick = 0;
  state::TickInputs inputs;
  std::vector<state::Event> events;
  std::optional<std::uint64_t> hash;

  [[nodiscard]] TickRecord record() const { return {tick, &inputs, events, hash}; }
};

/// Any 64 bits: infinities, NaNs with payloads, denormals, -0, and now and then a plain number or 0.
inline double any_double() {
  const auto bits = *rc::gen::arbitrary<std::uint64_t>();
  return *rc::gen::element(std::bit_cast<double>(bits * 0x9e3779b97f4a7c15u), 0.0, -0.0, 0.25);
}

inline hand::SentSample any_sample() {
  hand::SentSample s;
  s.session = *rc::gen::arbitrary<std::uint64_t>();
  s.sequence = *rc::gen::arbitrary<std::uint64_t>();
  s.sent_ns = *rc::gen::arbitrary<std::uint64_t>();
  s.kind = *rc::gen::element(hand::HandKind::one_point, hand::HandKind::glove);
  s.side = *rc::gen::element(hand::HandSide::right, hand::HandSide::left);
  for (int i = 0; i < 3; ++i)
    s.X_WH.p[i] = any_double();
  for (int i = 0; i < 4; ++i)
    s.X_WH.R.coeffs()[i] = any_double();
  for (int i = 0; i < 3; ++i)
    s.V_WH.v[i] = any_double();
  if (s.kind == hand::HandKind::glove) {
    for (double& angle : s.joints)
      angle = any_double();
  }
  s.hand_scale = any_double();
  for (double& scale : s.finger_scale)
    scale = *rc::gen::arbitrary<bool>() ? 1.0 : any_double();
  s.buttons = *rc::gen::arbitrary<std::uint32_t>();
  s.grasp_intent = any_double();
  return s;
}

inline WorldTick any_tick(std::uint64_t number) {
  WorldTick tick;
  tick.tick = number;
  if (*rc::gen::inRange(0, 3) == 0) return tick;  // idle
  for (state::UserInput& user : tick.inputs.users) {
    user.present = *rc::gen::inRange(0, 3) > 0;
    if (!user.present) continue;
    user.fresh = *rc::gen::arbitrary<bool>();
    user.age = Duration(*rc::gen::arbitrary<std::int64_t>());
    if (user.fresh) user.sample = any_sample();
  }
  tick.inputs.command_count = *rc::gen::element(0u, 0u, 1u, 8u);
  for (std::size_t i = 0; i < tick.inputs.command_count; ++i) {
    tick.inputs.commands[i] = {*rc::gen::arbitrary<std::uint64_t>(), state::CommandKind::start_activity,
                               *rc::gen::arbitrary<std::uint32_t>()};
  }
  const std::size_t events = *rc::gen::element<std::size_t>(0, 0, 1, 3, state::kMaxEventsPerTick);
  for (std::size_t i = 0; i < events; ++i) {
    const std::uint32_t subject = *rc::gen::element(0u, 3u, 0xffffffffu, 0xfffffffeu);
    tick.events.push_back(
        {number - i % 2, state::EventKind::grasped, subject, *rc::gen::element(1u, 0xffffffffu), any_double()});
  }
  if (*rc::gen::arbitrary<bool>()) tick.hash = *rc::gen::arbitrary<std::uint64_t>();
  return tick;
}

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline bool same(const hand::SentSample& a, const hand::SentSample& b) {
  bool same = a.session == b.session && a.sequence == b.sequence && a.sent_ns == b.sent_ns && a.kind == b.kind &&
              a.side == b.side && a.buttons == b.buttons && same_bits(a.hand_scale, b.hand_scale) &&
              same_bits(a.grasp_intent, b.grasp_intent);
  for (int i = 0; i < 3; ++i) {
    same = same && same_bits(a.X_WH.p[i], b.X_WH.p[i]) && same_bits(a.V_WH.v[i], b.V_WH.v[i]) &&
           same_bits(a.V_WH.w[i], b.V_WH.w[i]);
  }
  for (int i = 0; i < 4; ++i)
    same = same && same_bits(a.X_WH.R.coeffs()[i], b.X_WH.R.coeffs()[i]);
  for (std::size_t i = 0; i < a.joints.size(); ++i)
    same = same && same_bits(a.joints[i], b.joints[i]);
  for (std::size_t i = 0; i < a.finger_scale.size(); ++i)
    same = same && same_bits(a.finger_scale[i], b.finger_scale[i]);
  return same;
}

/// True when `b`, from a journal, equals `a` in all that a tick may depend on.
inline bool same(const WorldTick& a, const JournalTick& b) {
  bool same_all = a.tick == b.tick && a.hash == b.hash && a.events.size() == b.events.size() &&
                  a.inputs.command_count == b.inputs.command_count;
  for (std::size_t i = 0; same_all && i < a.inputs.users.size(); ++i) {
    const state::UserInput& u = a.inputs.users[i];
    const state::UserInput& v = b.inputs.users[i];
    same_all = u.present == v.present && u.fresh == v.fresh && u.age == v.age && (!u.fresh || same(u.sample, v.sample));
  }
  for (std::size_t i = 0; same_all && i < a.inputs.command_count; ++i) {
    const state::Command& c = a.inputs.commands[i];
    const state::Command& d = b.inputs.commands[i];
    same_all = c.id == d.id && c.kind == d.kind && c.argument == d.argument;
  }
  for (std::size_t i = 0; same_all && i < a.events.size(); ++i) {
    const state::Event& e = a.events[i];
    const state::Event& f = b.events[i];
    same_all = e.tick == f.tick && e.kind == f.kind && e.subject == f.subject && e.object == f.object &&
               same_bits(e.value, f.value);
  }
  return same_all;
}

inline JournalHeader a_header(std::uint64_t first_tick = 0) {
  JournalHeader header;
  header.world_id = "kiosk-3";
  header.kiosk = "kiosk-3";
  header.scenario_id = "archimedes-screw";
  header.scenario_hash = "00ff";
  header.build_id = "0.1.0";
  header.start_wall_ns = 1'790'000'000'000'000'000u;
  header.first_tick = first_tick;
  return header;
}

/// All ticks up to the first damage.
inline std::vector<JournalTick> read_all(JournalReader& reader) {
  std::vector<JournalTick> ticks;
  for (JournalTick tick; reader.next(tick);)
    ticks.push_back(tick);
  return ticks;
}

}  // namespace mechane::record
