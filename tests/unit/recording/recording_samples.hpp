// A visit of two worlds, as a display hears it: a crank that turns, water that rises, a rope that is wound, and then another exhibit.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "client-sdk/recording/frame_recording.hpp"
#include "client-sdk/recording/recording_codec.hpp"

namespace mechane::recording {

inline client::WorldStatus status_of_visit(const std::string& world, const std::string& step) {
  client::WorldStatus status;
  status.world = world;
  status.scenario = "well-" + world;
  status.activity = "use";
  status.step = step;
  status.steps_total = 3;
  status.quantities = {{"level", "m"}, {"flow", "l/s"}};
  status.quantities[0].goal = {1.5, true};
  status.quantities[1].label = {{"en", "Water that runs"}};
  status.quantities[1].range = {-2, 5};
  status.title = {{"el", "Το πηγάδι"}, {"en", "The well"}};
  status.activities = {"use"};
  return status;
}

inline client::WorldPresentation presentation_of_visit(const std::string& world) {
  client::WorldPresentation presentation;
  presentation.world = world;
  presentation.languages = {"el", "en"};
  client::Question question;
  question.name = "how";
  question.answers = {{"by-rope", {{"en", "By the rope"}}}};
  question.marks = 5;
  client::Activity activity;
  activity.name = "use";
  activity.questions = {question};
  presentation.activities = {activity};
  client::View view;
  view.X_WV.p = Vec3(0, 1.5, 3);
  presentation.views = {view};
  client::Effect basin, fixed;
  basin.kind = "level";
  basin.node = "WATER_BASIN";
  basin.object = 1;
  fixed.kind = "smoke";
  presentation.effects = {basin, fixed};
  return presentation;
}

inline std::vector<client::SceneObject> manifest_of_visit() {
  std::vector<client::SceneObject> objects(2);
  for (std::uint32_t i = 0; i < 2; ++i) {
    objects[i].index = i;
    objects[i].name = i == 0 ? "CRANK" : "BUCKET";
    objects[i].mesh_uri = "machine.glb";
    objects[i].mesh_node = "OUTER";
    objects[i].movable = true;
  }
  objects[1].title = {{"el", "Ο κάδος"}, {"en", "The bucket"}};
  return objects;
}

/// `at` after the beginning: the crank turns 2 rad a second, the bucket rises half a metre, the hand goes along.
inline client::Frame frame_of_visit(std::uint64_t sequence, Duration at, TimePoint received) {
  const double t = to_seconds(at);
  client::Frame frame;
  frame.sequence = sequence;
  frame.tick = static_cast<std::uint64_t>(at / kTickPeriod);
  frame.received = received;
  frame.visible = {1, 1};
  frame.bodies = {{0, {Vec3(0, 1, 0), Quat(Eigen::AngleAxisd(2 * t, Vec3::UnitZ()))}},
                  {1, {Vec3(0.25, 0.5 * t, 0), Quat::Identity()}}};
  frame.quantities = {0.1 * t, 0.3};
  client::HandPose hand;
  hand.kiosk = "kiosk-1";
  hand.holding = true;
  hand.X_WS[0] = {Vec3(0.2 * std::cos(2 * t), 1 + 0.2 * std::sin(2 * t), 0), Quat::Identity()};
  hand.force_W = Vec3(0, -3, 0.5);
  frame.hands = {hand};
  client::RopeShape rope;
  rope.points_W = {Vec3(0.25, 2, 0), Vec3(0.25, 0.5 * t, 0)};
  frame.ropes = {rope};
  return frame;
}

/// The file of frames at these milliseconds, of one world; from `second_from` on of another.
inline std::vector<std::byte> file_of_visit(const std::vector<int>& times_ms, int second_from = 1 << 30) {
  RecordingWriter writer;
  std::string world;
  std::uint64_t sequence = 0;
  for (const int ms : times_ms) {
    const std::string now_in = ms < second_from ? "world-1" : "world-2";
    if (std::exchange(world, now_in) != now_in) {
      writer.add(RecordKind::status, std::chrono::milliseconds(ms), encode(status_of_visit(world, "turn")));
      writer.add(RecordKind::presentation, std::chrono::milliseconds(ms), encode(presentation_of_visit(world)));
      writer.add(RecordKind::manifest, std::chrono::milliseconds(ms), encode(manifest_of_visit()));
    }
    writer.add(RecordKind::frame, std::chrono::milliseconds(ms),
               encode(frame_of_visit(++sequence, std::chrono::milliseconds(ms), {})));
  }
  writer.add(RecordKind::event, std::chrono::milliseconds(times_ms.back()),
             encode(client::WorldEvent{1, "placed", "a", "b", 0}));
  writer.add(RecordKind::end, Duration{0}, {});
  return writer.take_bytes();
}

inline FrameRecording played(const std::vector<int>& times_ms, int second_from = 1 << 30) {
  return FrameRecording::open_bytes(file_of_visit(times_ms, second_from), "played").value();
}

}  // namespace mechane::recording
