#include "client-sdk/recording/recording_codec.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "server/base/byte_order.hpp"
#include "server/base/utf8.hpp"

namespace mechane::recording {
namespace {

constexpr double kLargest = 1e9;  ///< of any length, force or factor; beyond it float32 is too coarse

/// Writes a value's fields. FieldWriter and FieldReader use the same list of fields, so that they cannot differ.
class FieldWriter {
 public:
  explicit FieldWriter(std::vector<std::byte>& out) : sink_(out) {}

  void text(const std::string& value) { put_string(sink_, value); }
  void flag(bool value) { put(sink_, static_cast<std::uint8_t>(value ? 1 : 0)); }
  void octet(std::uint8_t value) { put(sink_, value); }
  template <class T>
  void count(T value) {
    put_varint(sink_, static_cast<std::uint64_t>(value));
  }
  void wide(double value) { put(sink_, std::bit_cast<std::uint64_t>(value)); }
  void real(double value) { put(sink_, std::bit_cast<std::uint32_t>(static_cast<float>(value))); }
  void vector(const Vec3& value) {
    for (const double number : value)
      real(number);
  }
  void pose(const Pose& value) {
    vector(value.p);
    for (const double number : {value.R.w(), value.R.x(), value.R.y(), value.R.z()})
      real(number);
  }
  template <class List, class One>
  void each(const List& list, One&& one) {
    count(list.size());
    for (const auto& item : list)
      one(item);
  }
  void texts(const client::Texts& value) {
    each(value, [this](const auto& entry) {
      text(entry.first);
      text(entry.second);
    });
  }
  void optional(const std::optional<std::uint32_t>& value) { count(value ? std::uint64_t{*value} + 1 : 0); }
  void must(bool /*holds*/) const {}

 private:
  VectorSink sink_;
};

/// Reads what FieldWriter wrote; after the first fault everything is zero.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::byte> bytes) : in_(bytes) {}

  void text(std::string& out) {
    out = in_.get_string();
    must(std::ranges::none_of(out, is_control_in_lines));
  }
  void flag(bool& out) {
    const auto value = in_.get<std::uint8_t>();
    must(value <= 1);
    out = value == 1;
  }
  void octet(std::uint8_t& out) { out = in_.get<std::uint8_t>(); }
  template <class T>
  void count(T& out) {
    const std::uint64_t value = in_.get_varint();
    must(value <= std::numeric_limits<T>::max());
    out = static_cast<T>(value);
  }
  void wide(double& out) {
    out = std::bit_cast<double>(in_.get<std::uint64_t>());
    must(std::isfinite(out));
  }
  void real(double& out) {
    out = std::bit_cast<float>(in_.get<std::uint32_t>());
    must(std::abs(out) < kLargest);  // excludes NaN too
  }
  void vector(Vec3& out) {
    for (double& number : out)
      real(number);
  }
  void pose(Pose& out) {
    vector(out.p);
    for (double* number : {&out.R.w(), &out.R.x(), &out.R.y(), &out.R.z()})
      real(*number);
    must(std::abs(out.R.norm() - 1) < 0.01);
    if (in_.ok()) out.R.normalize();
  }
  template <class List, class One>
  void each(List& list, One&& one) {
    std::uint64_t left = in_.get_varint();
    must(left <= in_.remaining());  // each element takes at least one byte
    list.clear();
    for (; left > 0 && in_.ok(); --left)
      one(list.emplace_back());
  }
  void texts(client::Texts& out) {
    std::vector<std::pair<std::string, std::string>> list;
    each(list, [this](auto& entry) {
      text(entry.first);
      text(entry.second);
    });
    out = {list.begin(), list.end()};
  }
  void optional(std::optional<std::uint32_t>& out) {
    std::uint64_t value = 0;
    count(value);
    must(value <= std::uint64_t{std::numeric_limits<std::uint32_t>::max()});
    out = value == 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(value - 1));
  }
  void must(bool holds) {
    if (!holds) in_.fail();
  }
  [[nodiscard]] bool at_end() const { return in_.remaining() == 0; }
  [[nodiscard]] bool all_read() const { return in_.ok() && in_.remaining() == 0; }

 private:
  ByteSource in_;
};

/// The fields of each thing, once for both directions: `Status` is WorldStatus when read, const WorldStatus when
/// written, and so on.
template <class Fields, class Status>
void status_fields(Fields& f, Status& s) {
  for (auto* text : {&s.world, &s.scenario, &s.scenario_hash, &s.scenario_folder, &s.activity, &s.step, &s.detail})
    f.text(*text);
  f.count(s.steps_done);
  f.count(s.steps_total);
  f.flag(s.done);
  f.flag(s.hint);
  for (auto* list : {&s.enabled_agents, &s.activities})
    f.each(*list, [&](auto& name) { f.text(name); });
  f.each(s.quantities, [&](auto& quantity) {
    f.text(quantity.name);
    f.text(quantity.unit);
  });
  for (auto* texts : {&s.title, &s.caption, &s.hint_text, &s.narration, &s.audio})
    f.texts(*texts);
}

/// The goals of the quantities. Recordings of older versions end before them.
template <class Fields, class Status>
void goal_fields(Fields& f, Status& s) {
  for (auto& quantity : s.quantities) {
    bool there = quantity.goal.has_value();
    f.flag(there);
    if (!there) continue;
    if constexpr (!std::is_const_v<Status>) quantity.goal = client::QuantityInfo::Goal{};
    f.wide(quantity.goal->value);
    f.flag(quantity.goal->from_above);
  }
}

/// The quantities' names for visitors, and the ranges of their gauges. Recordings of older versions end before them.
template <class Fields, class Status>
void gauge_fields(Fields& f, Status& s) {
  for (auto& quantity : s.quantities) {
    f.texts(quantity.label);
    bool there = quantity.range.has_value();
    f.flag(there);
    if (!there) continue;
    if constexpr (!std::is_const_v<Status>) quantity.range = client::QuantityInfo::Range{};
    f.wide(quantity.range->least);
    f.wide(quantity.range->greatest);
    f.must(quantity.range->least < quantity.range->greatest);
  }
}

template <class Fields, class Question>
void question_fields(Fields& f, Question& q) {
  f.text(q.name);
  auto kind = static_cast<std::uint8_t>(q.kind);
  f.octet(kind);
  f.must(kind <= 1);
  if constexpr (!std::is_const_v<Question>) q.kind = static_cast<client::Question::Kind>(kind);
  f.texts(q.text);
  f.each(q.answers, [&](auto& answer) {
    f.text(answer.name);
    f.texts(answer.text);
  });
  f.count(q.marks);
  f.must(q.marks <= 100);
  f.texts(q.low);
  f.texts(q.high);
}

template <class Fields, class Effect>
void effect_fields(Fields& f, Effect& e) {
  f.text(e.name);
  f.text(e.kind);
  f.optional(e.object);
  f.text(e.node);
  f.vector(e.p_BE);
  f.vector(e.direction_B);
  f.must(std::abs(e.direction_B.norm() - 1) < 0.01);
  f.count(e.quantity);
  for (auto* number : {&e.full, &e.size_m, &e.speed_m_per_s})
    f.real(*number);
  f.must(e.full > 0);
}

template <class Fields, class Presentation>
void presentation_fields(Fields& f, Presentation& p) {
  f.text(p.world);
  f.each(p.languages, [&](auto& language) { f.text(language); });
  f.each(p.activities, [&](auto& activity) {
    f.text(activity.name);
    f.texts(activity.title);
    f.texts(activity.goal);
    f.each(activity.questions, [&](auto& question) { question_fields(f, question); });
  });
  f.each(p.views, [&](auto& view) {
    f.text(view.name);
    f.pose(view.X_WV);
    f.real(view.field_of_view_rad);
    f.must(view.field_of_view_rad > 0 && view.field_of_view_rad < 3.14);
  });
  f.each(p.effects, [&](auto& effect) { effect_fields(f, effect); });
}

template <class Fields, class Object>
void object_fields(Fields& f, Object& o) {
  f.count(o.index);
  for (auto* text : {&o.name, &o.mesh_uri, &o.mesh_hash, &o.mesh_node, &o.parent})
    f.text(*text);
  f.pose(o.X_WB);
  f.flag(o.movable);
}

template <class Fields, class Hand>
void hand_fields(Fields& f, Hand& h) {
  f.text(h.kiosk);
  f.count(h.user);
  auto kind = static_cast<std::uint8_t>(h.kind);
  f.octet(kind);
  f.must(hand::is_hand_kind(kind));
  if constexpr (!std::is_const_v<Hand>) h.kind = static_cast<client::HandKind>(kind);
  f.flag(h.stale);
  f.flag(h.holding);
  const std::size_t segments = hand::segment_count(static_cast<hand::HandKind>(kind));
  for (std::size_t i = 0; i < segments; ++i)
    f.pose(h.X_WS[i]);
  f.vector(h.force_W);
}

template <class Fields, class Frame>
void frame_fields(Fields& f, Frame& frame) {
  f.count(frame.sequence);
  f.count(frame.tick);
  f.each(frame.visible, [&](auto& seen) { f.octet(seen); });
  f.each(frame.bodies, [&](auto& body) {
    f.count(body.object);
    f.must(body.object < frame.visible.size());
    f.pose(body.X_WB);
  });
  f.each(frame.quantities, [&](auto& quantity) { f.wide(quantity); });
  f.each(frame.hands, [&](auto& hand) { hand_fields(f, hand); });
  f.each(frame.ropes, [&](auto& rope) {
    f.real(rope.diameter_m);
    f.must(rope.diameter_m > 0 && rope.diameter_m < 10);
    f.each(rope.points_W, [&](auto& p_W) { f.vector(p_W); });
  });
}

template <class Fields, class Event>
void event_fields(Fields& f, Event& e) {
  f.count(e.tick);
  for (auto* text : {&e.kind, &e.subject, &e.object})
    f.text(*text);
  f.wide(e.value);
}

template <class Write>
std::vector<std::byte> written(Write&& write) {
  std::vector<std::byte> bytes;
  FieldWriter fields(bytes);
  write(fields);
  return bytes;
}

template <class Read>
bool read_whole(std::span<const std::byte> bytes, Read&& read) {
  FieldReader fields(bytes);
  read(fields);
  return fields.all_read();
}

}  // namespace

std::vector<std::byte> encode(const client::WorldStatus& status) {
  return written([&](FieldWriter& f) {
    status_fields(f, status);
    goal_fields(f, status);
    gauge_fields(f, status);
  });
}

std::vector<std::byte> encode(const client::WorldPresentation& presentation) {
  return written([&](FieldWriter& f) { presentation_fields(f, presentation); });
}

std::vector<std::byte> encode(const std::vector<client::SceneObject>& manifest) {
  return written([&](FieldWriter& f) {
    f.each(manifest, [&](auto& object) { object_fields(f, object); });
    for (const client::SceneObject& object : manifest)
      f.texts(object.title);
  });
}

std::vector<std::byte> encode(const client::Frame& frame) {
  return written([&](FieldWriter& f) { frame_fields(f, frame); });
}

std::vector<std::byte> encode(const client::WorldEvent& event) {
  return written([&](FieldWriter& f) { event_fields(f, event); });
}

bool decode(std::span<const std::byte> bytes, client::WorldStatus& out) {
  return read_whole(bytes, [&](FieldReader& f) {
    status_fields(f, out);
    if (!f.at_end()) goal_fields(f, out);   // versions 1 and 2 have none
    if (!f.at_end()) gauge_fields(f, out);  // neither has version 3
  });
}

bool decode(std::span<const std::byte> bytes, client::WorldPresentation& out) {
  return read_whole(bytes, [&](FieldReader& f) { presentation_fields(f, out); });
}

bool decode(std::span<const std::byte> bytes, std::vector<client::SceneObject>& out) {
  return read_whole(bytes, [&](FieldReader& f) {
    f.each(out, [&](auto& object) { object_fields(f, object); });
    if (f.at_end()) return;  // version 1 has no titles
    for (client::SceneObject& object : out)
      f.texts(object.title);
  });
}

bool decode(std::span<const std::byte> bytes, client::Frame& out) {
  return read_whole(bytes, [&](FieldReader& f) { frame_fields(f, out); });
}

bool decode(std::span<const std::byte> bytes, client::WorldEvent& out) {
  return read_whole(bytes, [&](FieldReader& f) { event_fields(f, out); });
}

}  // namespace mechane::recording
