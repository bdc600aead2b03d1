#include "client-sdk/recording/frame_recording.hpp"

#include <array>
#include <fstream>
#include <iterator>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "client-sdk/recording/recording_codec.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/recording/recording_samples.hpp"

namespace mechane::recording {
namespace {

using test::is_error;

using std::chrono::milliseconds;

constexpr TimePoint kHeardFrom = TimePoint(std::chrono::hours(5));

std::vector<std::byte> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(file), {}};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// Two seconds, heard sixty times a second: a step, another step, another world.
std::vector<std::byte> a_recording(const RecorderSettings& settings = {}) {
  const test::ScratchFolder folder(test::folder_in_memory());
  const auto path = folder.path() / "visit.frames";
  {
    auto recorder = FrameRecorder::create(path, settings);
    EXPECT_TRUE(recorder.has_value());
    for (std::uint64_t i = 0; i < 120; ++i) {
      const Duration at = i * milliseconds(1000) / 60;
      const std::string world = i < 90 ? "world-1" : "world-2";
      const client::WorldPresentation presentation = presentation_of_visit(world);
      const client::Frame frame = frame_of_visit(i + 1, at, kHeardFrom + at + milliseconds(i % 5));
      recorder->hear(kHeardFrom + at + milliseconds(5), status_of_visit(world, i < 60 ? "reach" : "turn"),
                     i < 3 ? nullptr : &presentation, i < 5 ? std::vector<client::SceneObject>() : manifest_of_visit(),
                     &frame);
      if (i == 70)
        recorder->hear(kHeardFrom + at + milliseconds(5),
                       std::vector<client::WorldEvent>{{70, "grasped", "a", "b", 1}});
    }
  }
  return bytes_of(path);
}

std::vector<FrameRecording::Record> of_kind(const FrameRecording& recording, RecordKind kind) {
  std::vector<FrameRecording::Record> out;
  std::ranges::copy_if(recording.records(), std::back_inserter(out),
                       [kind](const FrameRecording::Record& record) { return record.kind == kind; });
  return out;
}

TEST(FrameRecording, holds_what_changed_and_frames_at_their_rate) {
  const auto recording = FrameRecording::open_bytes(a_recording(), "visit");
  ASSERT_TRUE(recording.has_value()) << recording.error().to_string();
  EXPECT_FALSE(recording->cut_off());
  EXPECT_EQ(of_kind(*recording, RecordKind::status).size(), 3U);
  EXPECT_EQ(of_kind(*recording, RecordKind::presentation).size(), 2U) << "one a world";
  EXPECT_EQ(of_kind(*recording, RecordKind::manifest).size(), 2U);
  EXPECT_EQ(of_kind(*recording, RecordKind::event).size(), 1U);
  const auto frames = of_kind(*recording, RecordKind::frame);
  EXPECT_NEAR(static_cast<double>(frames.size()), 58, 1) << "thirty a second, none before the manifest";
  // Their times are the ticks' own: what the network did to them is not seen.
  for (std::size_t i = 1; i < frames.size(); ++i) {
    client::Frame before, after;
    ASSERT_TRUE(decode(frames[i - 1].content, before) && decode(frames[i].content, after));
    if (before.tick < 1500 && after.tick >= 1500) continue;  // another world has ticks of its own
    EXPECT_EQ(frames[i].time - frames[i - 1].time, (after.tick - before.tick) * kTickPeriod);
  }
}

TEST(FrameRecording, what_it_holds_is_what_was_heard) {
  const client::Frame frame = frame_of_visit(7, milliseconds(700), kHeardFrom);
  client::Frame read;
  ASSERT_TRUE(decode(encode(frame), read));
  EXPECT_EQ(read.tick, 700U);
  EXPECT_EQ(read.quantities, frame.quantities) << "to the last bit";
  EXPECT_TRUE(read.bodies[0].X_WB.R.isApprox(frame.bodies[0].X_WB.R, 1e-6));
  EXPECT_TRUE(read.hands[0].X_WS[0].p.isApprox(frame.hands[0].X_WS[0].p, 1e-6));
  EXPECT_EQ(read.hands[0].kiosk, "kiosk-1");
  EXPECT_TRUE(read.hands[0].holding);
  EXPECT_TRUE(read.ropes[0].points_W[1].isApprox(frame.ropes[0].points_W[1], 1e-6));
  EXPECT_EQ(encode(read), encode(frame)) << "what was read can be recorded again";
  client::WorldPresentation presentation;
  ASSERT_TRUE(decode(encode(presentation_of_visit("w")), presentation));
  EXPECT_EQ(presentation.activities[0].questions[0].answers[0].text.at("en"), "By the rope");
  EXPECT_EQ(presentation.effects[0].object, 1U);
  EXPECT_FALSE(presentation.effects[1].object);
  client::WorldStatus status;
  ASSERT_TRUE(decode(encode(status_of_visit("w", "s")), status));
  EXPECT_EQ(status.title.at("el"), "Το πηγάδι");
  EXPECT_EQ(encode(status), encode(status_of_visit("w", "s")));
}

/// Without what recordings of version 3 do not have, which is then so many bytes.
client::WorldStatus without_gauges(client::WorldStatus status) {
  for (client::QuantityInfo& quantity : status.quantities) {
    quantity.label.clear();
    quantity.range.reset();
  }
  return status;
}
constexpr std::size_t kNoGauges = 2 * 2;

TEST(FrameRecording, of_a_former_version_is_read_without_labels_and_ranges) {
  client::WorldStatus status;
  ASSERT_TRUE(decode(encode(status_of_visit("w", "s")), status));
  EXPECT_EQ(status.quantities[1].label.at("en"), "Water that runs");
  ASSERT_TRUE(status.quantities[1].range);
  EXPECT_EQ(status.quantities[1].range->least, -2);
  EXPECT_EQ(status.quantities[1].range->greatest, 5);
  EXPECT_FALSE(status.quantities[0].range);
  std::vector<std::byte> former = encode(without_gauges(status));
  former.resize(former.size() - kNoGauges);
  ASSERT_TRUE(decode(former, status));
  ASSERT_TRUE(status.quantities[0].goal) << "version 3 has goals";
  EXPECT_TRUE(status.quantities[1].label.empty());
  EXPECT_FALSE(status.quantities[1].range);
}

TEST(FrameRecording, with_a_reversed_range_is_damaged) {
  client::WorldStatus status = status_of_visit("w", "s");
  status.quantities[1].range = {5, 5};
  EXPECT_FALSE(decode(encode(status), status));
}

TEST(FrameRecording, of_a_former_version_is_read_without_goals) {
  client::WorldStatus status;
  ASSERT_TRUE(decode(encode(status_of_visit("w", "s")), status));
  ASSERT_TRUE(status.quantities[0].goal);
  EXPECT_EQ(status.quantities[0].goal->value, 1.5);
  EXPECT_TRUE(status.quantities[0].goal->from_above);
  EXPECT_FALSE(status.quantities[1].goal);
  client::WorldStatus without = without_gauges(status);
  without.quantities[0].goal.reset();
  std::vector<std::byte> former = encode(without);
  former.resize(former.size() - kNoGauges - 2);  // that a quantity has none is a byte
  ASSERT_TRUE(decode(former, status));
  EXPECT_EQ(status.quantities[1].name, "flow");
  EXPECT_FALSE(status.quantities[0].goal);
  former.pop_back();
  EXPECT_FALSE(decode(former, status));
}

TEST(FrameRecording, of_a_former_version_is_read_without_titles) {
  std::vector<client::SceneObject> manifest;
  ASSERT_TRUE(decode(encode(manifest_of_visit()), manifest));
  ASSERT_EQ(manifest.size(), 2U);
  EXPECT_TRUE(manifest[0].title.empty());
  EXPECT_EQ(manifest[1].title, manifest_of_visit()[1].title);
  std::vector<client::SceneObject> untitled = manifest_of_visit();
  untitled[1].title.clear();
  std::vector<std::byte> former = encode(untitled);
  former.resize(former.size() - 2);  // a title of no words is a byte
  ASSERT_TRUE(decode(former, manifest));
  EXPECT_EQ(manifest[1].name, "BUCKET");
  EXPECT_TRUE(manifest[1].title.empty());
  former.pop_back();
  EXPECT_FALSE(decode(former, manifest));
  std::vector<std::byte> file = a_recording();
  file[8] = std::byte{1};
  EXPECT_TRUE(FrameRecording::open_bytes(file, "x"));
  file[8] = std::byte{0};
  EXPECT_FALSE(FrameRecording::open_bytes(file, "x"));
}

TEST(FrameRecording, what_cannot_be_drawn_is_refused) {
  client::Frame out;
  const auto refused = [&](auto&& spoil) {
    client::Frame frame = frame_of_visit(1, milliseconds(0), kHeardFrom);
    spoil(frame);
    return !decode(encode(frame), out);
  };
  EXPECT_FALSE(refused([](client::Frame&) {}));
  EXPECT_TRUE(refused([](client::Frame& f) { f.quantities[0] = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](client::Frame& f) { f.bodies[0].X_WB.p.x() = std::nan(""); }));
  EXPECT_TRUE(refused([](client::Frame& f) { f.bodies[0].X_WB.p.x() = 1e30; }));
  EXPECT_TRUE(refused([](client::Frame& f) { f.bodies[0].X_WB.R.coeffs().setZero(); }));
  EXPECT_TRUE(refused([](client::Frame& f) { f.bodies[0].object = 2; })) << "of no object";
  EXPECT_TRUE(refused([](client::Frame& f) { f.ropes[0].diameter_m = 0; }));
  EXPECT_TRUE(refused([](client::Frame& f) { f.hands[0].kiosk = "\x1b[2J"; }));
  client::WorldPresentation presentation = presentation_of_visit("w"), read;
  presentation.effects[0].full = 0;
  EXPECT_FALSE(decode(encode(presentation), read));
}

// Whatever is cut from it, or changed in it, a recording gives what was recorded from its beginning on, or says what is
// wrong.
RC_GTEST_PROP(FrameRecording, never_gives_what_was_not_recorded, ()) {
  static const std::vector<std::byte> whole = a_recording();
  static const FrameRecording good = FrameRecording::open_bytes(whole, "good").value();
  std::vector<std::byte> bytes = whole;
  if (*rc::gen::arbitrary<bool>()) {
    bytes.resize(*rc::gen::inRange<std::size_t>(0, whole.size()));
  } else {
    bytes[*rc::gen::inRange<std::size_t>(0, whole.size())] ^= static_cast<std::byte>(*rc::gen::inRange(1, 256));
  }
  const auto recording = FrameRecording::open_bytes(bytes, "spoilt");
  if (!recording) {
    RC_ASSERT(recording.error().where == "spoilt");
    RC_ASSERT(recording.error().code == ErrorCode::damaged || recording.error().code == ErrorCode::wrong_version ||
              recording.error().code == ErrorCode::missing);
    RC_ASSERT(!recording.error().what.empty() && !recording.error().remedy.empty());
    return;
  }
  RC_ASSERT(recording->cut_off());
  RC_ASSERT(recording->records().size() <= good.records().size());
  for (std::size_t i = 0; i < recording->records().size(); ++i) {
    RC_ASSERT(recording->records()[i].time == good.records()[i].time);
    RC_ASSERT(std::ranges::equal(recording->records()[i].content, good.records()[i].content));
  }
}

TEST(FrameRecording, a_file_that_is_none_is_told) {
  const test::ScratchFolder folder;
  const auto fault = [](const Expected<FrameRecording>& recording) {
    EXPECT_FALSE(recording.has_value());
    return recording ? Error{} : recording.error();
  };
  EXPECT_THAT(fault(FrameRecording::open_file(folder.path() / "none")), is_error(ErrorCode::not_found, 0, {"none"}));
  EXPECT_THAT(fault(FrameRecording::open_file(folder.path())), is_error(ErrorCode::io_failure, 0));
  EXPECT_THAT(fault(FrameRecording::open_file(folder.write("text", "hello"))),
              is_error(ErrorCode::damaged, 0, {"--record"}));
  RecordingWriter empty;
  EXPECT_THAT(fault(FrameRecording::open_bytes(empty.take_bytes(), "x")), is_error(ErrorCode::missing, 0, {"x"}));
  std::vector<std::byte> later = a_recording();
  later[8] = std::byte{9};
  EXPECT_THAT(fault(FrameRecording::open_bytes(later, "x")), is_error(ErrorCode::wrong_version, 0, {"version 9"}));
}

TEST(FrameRecording, knows_moments_by_name) {
  const auto recording = FrameRecording::open_bytes(a_recording(), "visit");
  ASSERT_TRUE(recording.has_value());
  const auto seconds = [&](const std::string& text) {
    const auto at = recording->moment(text);
    return at ? to_seconds(*at) : -1;
  };
  EXPECT_NEAR(seconds("0.75"), 0.75, 1e-9);
  EXPECT_NEAR(seconds("turn"), 1.0, 0.05);
  EXPECT_NEAR(seconds("turn@1"), 1.5, 0.05) << "the other world has this step, too";
  EXPECT_NEAR(seconds("reach@0.5"), 0.5, 0.06);
  EXPECT_NEAR(seconds("@1"), 1.5, 0.05);
  for (const char* text : {"9", "dance", "turn@2", "turn@", "-1", "", "turn@x"})
    EXPECT_EQ(seconds(text), text[0] == 0 ? seconds("@0") : -1) << text;
  EXPECT_THAT(recording->moment("9").error(), is_error(ErrorCode::invalid_value, 0, {"9"}));
  EXPECT_THAT(recording->moment("turn@x").error(), is_error(ErrorCode::invalid_value, 0, {"turn@x"}));
  EXPECT_THAT(recording->moment("dance").error(), is_error(ErrorCode::unknown_name, 0, {"dance"}));
}

TEST(FrameRecorder, ends_at_its_measure_and_the_file_is_whole) {
  const auto recording = FrameRecording::open_bytes(a_recording({30, 4000}), "small");
  ASSERT_TRUE(recording.has_value()) << recording.error().to_string();
  EXPECT_FALSE(recording->cut_off());
  EXPECT_LT(recording->duration(), std::chrono::seconds(1));
}

/// The frame with this number, heard in its time.
void hear_frame(FrameRecorder& recorder, std::uint64_t number) {
  const Duration at = number * milliseconds(40);
  const client::Frame frame = frame_of_visit(number, at, kHeardFrom + at);
  recorder.hear(frame.received, status_of_visit("w", "s"), nullptr, manifest_of_visit(), &frame);
}

TEST(FrameRecorder, a_full_disk_ends_the_recording_and_nothing_else) {
  auto recorder = FrameRecorder::create("/dev/full", {});
  ASSERT_TRUE(recorder.has_value()) << recorder.error().to_string();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  for (std::uint64_t i = 1; recorder->frames() + 1 >= i; ++i) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "it does not give up";
    hear_frame(*recorder, i);
  }
}

TEST(FrameRecorder, a_disk_that_stands_still_holds_up_nobody_and_loses_nothing) {
  const test::ScratchFolder folder;
  const auto pipe = folder.path() / "visit.frames";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  auto recorder = FrameRecorder::create(pipe, {1000, 1U << 30U});
  ASSERT_TRUE(recorder.has_value());
  constexpr std::uint64_t kFrames = 2000;  // much more than the 64 KiB of a pipe that nobody reads
  for (std::uint64_t i = 1; i <= kFrames; ++i)
    hear_frame(*recorder, i);
  EXPECT_EQ(recorder->frames(), kFrames);
  std::vector<std::byte> bytes;
  std::jthread disk([&] {
    ::fcntl(reader, F_SETFL, 0);
    std::array<std::byte, 4096> some;
    for (ssize_t n = ::read(reader, some.data(), some.size()); n > 0; n = ::read(reader, some.data(), some.size()))
      bytes.insert(bytes.end(), some.begin(), some.begin() + n);
  });
  { const FrameRecorder ends = std::move(*recorder); }
  disk.join();
  ::close(reader);
  EXPECT_GT(bytes.size(), 128U << 10U);
  const auto recording = FrameRecording::open_bytes(bytes, "slow");
  ASSERT_TRUE(recording.has_value()) << recording.error().to_string();
  EXPECT_FALSE(recording->cut_off());
  EXPECT_EQ(of_kind(*recording, RecordKind::frame).size(), kFrames);
}

TEST(FrameRecorder, tells_where_it_cannot_write) {
  const auto recorder = FrameRecorder::create("/nowhere/visit.frames", {});
  ASSERT_FALSE(recorder.has_value());
  EXPECT_THAT(recorder.error(), is_error(ErrorCode::io_failure, 0, {"/nowhere/visit.frames", "No such file"}));
}

}  // namespace
}  // namespace mechane::recording
