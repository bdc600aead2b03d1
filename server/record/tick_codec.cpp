#include "server/record/tick_codec.hpp"

#include <algorithm>
#include <array>

#include "server/base/assert.hpp"

// A tick: u8 what is in it. With users: u8 who is present (low half) and whose sample is fresh (high half), then for each present
// user its age (signed varint, ns) and, where fresh, the sample. With commands: v count, then v id, u8 kind, v argument each. With events:
// v count, then signed tick difference, u8 kind, v subject + 1, v object + 1 (mod 2^32, so that "none" is 0), u64 value each. With a
// hash: u64.
// A sample: u64 session, v sequence, v sent, u8 kind (low half) and side (high half), v buttons, then 40 numbers: a varint with one bit for
// each that is not what it mostly is, and the bits of those. The last five, the lengths of fingers, are mostly 1, and the others +0. A
// journal from before there were sides and lengths has the bits of right hands with fingers of the model's length.
namespace mechane::record {
namespace {

using hand::kHandJoints;
using hand::kMaxUsers;
using hand::SentSample;
using state::Command;
using state::Event;
using state::kMaxCommandsPerTick;
using state::kMaxEventsPerTick;
using state::UserInput;

enum Content : std::uint8_t { kUsers = 1, kCommands = 2, kEvents = 4, kHash = 8 };
constexpr std::size_t kScalars = 3 + 4 + 3 + 3 + kHandJoints + 2 + hand::kFingers;
static_assert(kMaxUsers <= 4, "presence and freshness share a byte");
static_assert(kScalars <= 64, "one bit for each number");

using Scalars = std::array<double, kScalars>;

/// What is not written, as bits.
constexpr std::uint64_t mostly(std::size_t scalar) noexcept {
  return std::bit_cast<std::uint64_t>(scalar < kScalars - hand::kFingers ? 0.0 : 1.0);
}

Scalars scalars_of(const SentSample& s) noexcept {
  Scalars out;
  std::size_t n = 0;
  const auto add = [&](const auto& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      out[n++] = values[static_cast<Eigen::Index>(i)];
  };
  add(s.X_WH.p, 3);
  add(s.X_WH.R.coeffs(), 4);
  add(s.V_WH.v, 3);
  add(s.V_WH.w, 3);
  for (const double angle : s.joints)
    out[n++] = angle;
  out[n++] = s.hand_scale;
  out[n++] = s.grasp_intent;
  for (const double scale : s.finger_scale)
    out[n++] = scale;
  return out;
}

void set_scalars(const Scalars& in, SentSample& s) noexcept {
  std::size_t n = 0;
  const auto take = [&](auto& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      values[static_cast<Eigen::Index>(i)] = in[n++];
  };
  take(s.X_WH.p, 3);
  take(s.X_WH.R.coeffs(), 4);
  take(s.V_WH.v, 3);
  take(s.V_WH.w, 3);
  for (double& angle : s.joints)
    angle = in[n++];
  s.hand_scale = in[n++];
  s.grasp_intent = in[n++];
  for (double& scale : s.finger_scale)
    scale = in[n++];
}

void put_sample(SpanSink& out, const SentSample& s) noexcept {
  put(out, s.session);
  put_varint(out, s.sequence);
  put_varint(out, s.sent_ns);
  put(out, static_cast<std::uint8_t>(static_cast<unsigned>(s.kind) | static_cast<unsigned>(s.side) << 4));
  put_varint(out, s.buttons);
  const Scalars scalars = scalars_of(s);
  std::uint64_t mask = 0;
  for (std::size_t i = 0; i < kScalars; ++i) {
    if (std::bit_cast<std::uint64_t>(scalars[i]) != mostly(i)) mask |= std::uint64_t{1} << i;
  }
  put_varint(out, mask);
  for (std::size_t i = 0; i < kScalars; ++i) {
    if (((mask >> i) & 1) != 0) put(out, std::bit_cast<std::uint64_t>(scalars[i]));
  }
}

void get_sample(ByteSource& in, SentSample& s) {
  s.session = in.get<std::uint64_t>();
  s.sequence = in.get_varint();
  s.sent_ns = in.get_varint();
  const auto which = in.get<std::uint8_t>();
  const unsigned kind = which & 15u, side = which >> 4;
  if (!hand::is_hand_kind(kind) || !hand::is_hand_side(side)) in.fail();
  s.kind = static_cast<hand::HandKind>(kind);
  s.side = static_cast<hand::HandSide>(side);
  const std::uint64_t buttons = in.get_varint();
  if (buttons > 0xffffffffu) in.fail();
  s.buttons = static_cast<std::uint32_t>(buttons);
  const std::uint64_t mask = in.get_varint();
  if ((mask >> kScalars) != 0) in.fail();
  Scalars scalars;
  for (std::size_t i = 0; i < kScalars; ++i)
    scalars[i] = std::bit_cast<double>(((mask >> i) & 1) != 0 ? in.get<std::uint64_t>() : mostly(i));
  set_scalars(scalars, s);
}

std::uint8_t users_byte(const state::TickInputs& inputs) noexcept {
  unsigned bits = 0;
  for (std::size_t i = 0; i < kMaxUsers; ++i) {
    if (!inputs.users[i].present) continue;
    bits |= 1u << i;
    if (inputs.users[i].fresh) bits |= 16u << i;
  }
  return static_cast<std::uint8_t>(bits);
}

void put_users(SpanSink& out, const state::TickInputs& inputs, std::uint8_t who) noexcept {
  put(out, who);
  for (const UserInput& user : inputs.users) {
    if (!user.present) continue;
    put_signed(out, user.age.count());
    if (user.fresh) put_sample(out, user.sample);
  }
}

void get_users(ByteSource& in, state::TickInputs& inputs) {
  const auto who = in.get<std::uint8_t>();
  const unsigned present = who & 15u;
  const unsigned fresh = who >> 4;
  if (present == 0 || (fresh & ~present) != 0) in.fail();
  for (std::size_t i = 0; i < kMaxUsers && in.ok(); ++i) {
    UserInput& user = inputs.users[i];
    user.present = ((present >> i) & 1) != 0;
    if (!user.present) continue;
    user.fresh = ((fresh >> i) & 1) != 0;
    user.age = Duration(in.get_signed());
    if (user.fresh) get_sample(in, user.sample);
  }
}

void put_commands(SpanSink& out, std::span<const Command> commands) noexcept {
  put_varint(out, commands.size());
  for (const Command& c : commands) {
    put_varint(out, c.id);
    put(out, static_cast<std::uint8_t>(c.kind));
    put_varint(out, c.argument);
  }
}

void get_commands(ByteSource& in, state::TickInputs& inputs) {
  const std::uint64_t count = in.get_varint();
  if (count == 0 || count > kMaxCommandsPerTick) return in.fail();
  inputs.command_count = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    Command& c = inputs.commands[i];
    c.id = in.get_varint();
    c.kind = static_cast<state::CommandKind>(in.get<std::uint8_t>());
    const std::uint64_t argument = in.get_varint();
    if (argument > 0xffffffffu) in.fail();
    c.argument = static_cast<std::uint32_t>(argument);
  }
}

void put_events(SpanSink& out, std::uint64_t tick, std::span<const Event> events) noexcept {
  put_varint(out, events.size());
  for (const Event& e : events) {
    put_signed(out, static_cast<std::int64_t>(e.tick - tick));
    put(out, static_cast<std::uint8_t>(e.kind));
    put_varint(out, e.subject + 1u);
    put_varint(out, e.object + 1u);
    put(out, std::bit_cast<std::uint64_t>(e.value));
  }
}

std::uint32_t get_index(ByteSource& in) {
  const std::uint64_t plus_one = in.get_varint();
  if (plus_one > 0xffffffffu) in.fail();
  return static_cast<std::uint32_t>(plus_one) - 1u;
}

void get_events(ByteSource& in, std::uint64_t tick, std::vector<Event>& events) {
  const std::uint64_t count = in.get_varint();
  if (count == 0 || count > kMaxEventsPerTick) return in.fail();
  for (std::uint64_t i = 0; i < count && in.ok(); ++i) {
    Event e;
    e.tick = tick + static_cast<std::uint64_t>(in.get_signed());
    e.kind = static_cast<state::EventKind>(in.get<std::uint8_t>());
    e.subject = get_index(in);
    e.object = get_index(in);
    e.value = std::bit_cast<double>(in.get<std::uint64_t>());
    events.push_back(e);
  }
}

// Keeps from the tick before only the samples of users who were present.
void start_from_last(JournalTick& out) {
  for (UserInput& user : out.inputs.users) {
    user.present = false;
    user.fresh = false;
    user.age = Duration{0};
  }
  out.inputs.commands = {};
  out.inputs.command_count = 0;
  out.events.clear();
  out.hash.reset();
}

}  // namespace

std::size_t encode_tick(const TickRecord& record, std::span<std::byte> out) noexcept {
  MECHANE_ASSERT(record.inputs != nullptr && record.events.size() <= kMaxEventsPerTick &&
                 out.size() >= kMaxEncodedTick);
  MECHANE_ASSERT(record.inputs->command_count <= kMaxCommandsPerTick);
  const std::span<const Command> commands(record.inputs->commands.data(), record.inputs->command_count);
  const std::uint8_t who = users_byte(*record.inputs);
  unsigned content = 0;
  if (who != 0) content |= kUsers;
  if (!commands.empty()) content |= kCommands;
  if (!record.events.empty()) content |= kEvents;
  if (record.hash) content |= kHash;

  SpanSink sink(out);
  put(sink, static_cast<std::uint8_t>(content));
  if (who != 0) put_users(sink, *record.inputs, who);
  if (!commands.empty()) put_commands(sink, commands);
  if (!record.events.empty()) put_events(sink, record.tick, record.events);
  if (record.hash) put(sink, *record.hash);
  return sink.used();
}

bool is_idle(std::span<const std::byte> encoded) noexcept {
  return encoded.size() == 1 && encoded[0] == std::byte{0};
}

bool decode_tick(ByteSource& in, JournalTick& out) {
  start_from_last(out);
  const auto content = in.get<std::uint8_t>();
  if (content > (kUsers | kCommands | kEvents | kHash)) in.fail();
  if ((content & kUsers) != 0) get_users(in, out.inputs);
  for (UserInput& user : out.inputs.users) {
    if (!user.present) user = {};
  }
  if ((content & kCommands) != 0) get_commands(in, out.inputs);
  if ((content & kEvents) != 0) get_events(in, out.tick, out.events);
  if ((content & kHash) != 0) out.hash = in.get<std::uint64_t>();
  return in.ok();
}

}  // namespace mechane::record
