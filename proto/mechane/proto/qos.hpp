// Quality of service: one function for each row of the table "On the wire" in ARCHITECTURE.md. Writers and readers of a topic use the same
// function, so that they always match.
#pragma once

#include <memory>
#include <string>

#include <dds/dds.h>

#include "server/base/clock.hpp"

namespace mechane::proto {

inline constexpr Duration kServerLiveliness = std::chrono::milliseconds(500);
inline constexpr Duration kKioskLiveliness = std::chrono::seconds(3);
/// A display is silent while it reads an exhibit's files. When it is silent for longer than this, it hangs. One that has ended is noticed
/// sooner.
inline constexpr Duration kDisplayLiveliness = std::chrono::seconds(15);
inline constexpr Duration kEventLifespan = std::chrono::seconds(2);
inline constexpr int kEventDepth = 64;

/// Owns a dds_qos_t.
class Qos {
 public:
  Qos();
  Qos& best_effort();
  Qos& reliable();
  Qos& keep_last(int depth);
  Qos& transient_local();
  Qos& lifespan(Duration d);
  /// The writer asserts by writing; a reader learns of its silence after `lease`.
  Qos& manual_liveliness(Duration lease);
  Qos& partition(const std::string& name);
  [[nodiscard]] const dds_qos_t* get() const { return qos_.get(); }

 private:
  struct Delete {
    void operator()(dds_qos_t* q) const { dds_delete_qos(q); }
  };
  std::unique_ptr<dds_qos_t, Delete> qos_;
};

[[nodiscard]] Qos haptic_input_qos();
[[nodiscard]] Qos haptic_output_qos();
[[nodiscard]] Qos scene_frame_qos();
[[nodiscard]] Qos world_assignment_qos();
[[nodiscard]] Qos scene_object_qos();
[[nodiscard]] Qos world_status_qos();
[[nodiscard]] Qos exhibit_status_qos();
[[nodiscard]] Qos event_qos();
[[nodiscard]] Qos command_qos();
[[nodiscard]] Qos server_status_qos();
[[nodiscard]] Qos kiosk_status_qos();
[[nodiscard]] Qos display_status_qos();
[[nodiscard]] Qos viewer_head_qos();

}  // namespace mechane::proto
