#include <mechane/proto/qos.hpp>

namespace mechane::proto {
namespace {

// A reliable write waits no longer than this for a slow reader; then it fails.
constexpr dds_duration_t kMaxBlocking = DDS_MSECS(100);

Qos newest_value_stream() {
  Qos q;
  q.best_effort().keep_last(1);
  return q;
}

Qos last_known_value() {
  Qos q;
  q.reliable().transient_local().keep_last(1);
  return q;
}

}  // namespace

Qos::Qos() : qos_(dds_create_qos()) {}
Qos& Qos::best_effort() {
  dds_qset_reliability(qos_.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  return *this;
}
Qos& Qos::reliable() {
  dds_qset_reliability(qos_.get(), DDS_RELIABILITY_RELIABLE, kMaxBlocking);
  return *this;
}
Qos& Qos::keep_last(int depth) {
  dds_qset_history(qos_.get(), DDS_HISTORY_KEEP_LAST, depth);
  return *this;
}
Qos& Qos::transient_local() {
  dds_qset_durability(qos_.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  return *this;
}
Qos& Qos::lifespan(Duration d) {
  dds_qset_lifespan(qos_.get(), d.count());
  return *this;
}
Qos& Qos::manual_liveliness(Duration lease) {
  dds_qset_liveliness(qos_.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, lease.count());
  return *this;
}
Qos& Qos::partition(const std::string& name) {
  dds_qset_partition1(qos_.get(), name.c_str());
  return *this;
}

Qos haptic_input_qos() {
  return newest_value_stream();
}
Qos haptic_output_qos() {
  return newest_value_stream();
}
Qos viewer_head_qos() {
  return newest_value_stream();
}
Qos scene_frame_qos() {
  return newest_value_stream();
}
Qos world_assignment_qos() {
  return last_known_value();
}
Qos exhibit_status_qos() {
  return last_known_value();
}
Qos scene_object_qos() {
  return last_known_value();
}
Qos world_status_qos() {
  return last_known_value();
}

Qos event_qos() {
  // Kept for readers that are matched late: a client sees the server's writer before the server sees the client's reader, and in between a
  // volatile event would be lost. The lifespan limits how old the events are that a new reader gets.
  Qos q;
  q.reliable().transient_local().keep_last(kEventDepth).lifespan(kEventLifespan);
  return q;
}

Qos command_qos() {
  return event_qos();
}

Qos server_status_qos() {
  Qos q = last_known_value();
  q.manual_liveliness(kServerLiveliness);
  return q;
}

Qos kiosk_status_qos() {
  Qos q = last_known_value();
  q.manual_liveliness(kKioskLiveliness);
  return q;
}

Qos display_status_qos() {
  Qos q = last_known_value();
  q.manual_liveliness(kDisplayLiveliness);
  return q;
}

}  // namespace mechane::proto
