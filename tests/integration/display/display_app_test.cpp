// A whole display without a server: a recording is played and drawn, and what it would do on a museum's wall is seen in
// its pictures.
#include "client-sdk/display/display_app.hpp"

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "client-sdk/display/display_loop.hpp"
#include "client-sdk/display/window.hpp"
#include "client-sdk/recording/frame_recording.hpp"
#include "client-sdk/recording/recording_codec.hpp"
#include "tests/support/held_worker.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_folder.hpp"

namespace mechane::display {
namespace {

const std::filesystem::path kSource = mechane::test::source_folder();

/// A well-behaved driver, but for one moment.
int g_asked = 0;
int g_reset_at = 0;
GLenum reset_once() {
  return ++g_asked == g_reset_at ? GL_UNKNOWN_CONTEXT_RESET : GL_NO_ERROR;
}

class PlayedDisplay : public testing::Test {
 protected:
  /// The pictures of a recording, by file; two of them.
  std::vector<std::string> pictures_of(const std::filesystem::path& recording, const std::string& folder) {
    DisplayOptions options;
    options.offscreen = true;
    options.size = {320, 180};
    options.language = "en";
    options.assets = (kSource / "scenarios/aiolos-sphere").string();
    options.out = (scratch_.path() / folder).string();
    options.source.play = recording.string();
    options.film_fps = 2;
    options.frames = 2;
    DisplaySignals signals;
    const auto summary = run_display(options, signals);
    EXPECT_TRUE(summary.has_value()) << (summary ? "" : summary.error().to_string());
    std::vector<std::string> pictures;
    if (!summary) return pictures;
    EXPECT_EQ(summary->frames, 2U);
    EXPECT_TRUE(summary->missing_assets.empty());
    for (const std::string& file : summary->pictures) {
      std::ifstream in(file, std::ios::binary);
      pictures.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return pictures;
  }

  test::ScratchFolder scratch_;
};

TEST_F(PlayedDisplay, goes_on_with_the_same_pictures_when_its_graphics_card_forgets_all) {
  const std::filesystem::path recording = kSource / "tests/golden/scenes/aiolos-sphere.frames";
  const std::vector<std::string> whole = pictures_of(recording, "whole");
  ASSERT_FALSE(whole.empty());
  const auto real = epoxy_glGetGraphicsResetStatus;
  epoxy_glGetGraphicsResetStatus = reset_once;
  for (const int picture : {1, 2}) {
    g_asked = 0;
    g_reset_at = picture;
    EXPECT_EQ(pictures_of(recording, "reset-" + std::to_string(picture)), whole);
    EXPECT_GT(g_asked, picture) << "the new context was asked, too";
  }
  epoxy_glGetGraphicsResetStatus = real;
}

/// What is written in a record's place.
using Rewrite = std::function<void(const recording::FrameRecording::Record&, recording::RecordingWriter&)>;

void write_again(const Rewrite& rewrite, const std::filesystem::path& file) {
  const auto recorded =
      recording::FrameRecording::open_file(kSource / "tests/golden/scenes/aiolos-sphere.frames").value();
  recording::RecordingWriter writer;
  for (const recording::FrameRecording::Record& record : recorded.records())
    rewrite(record, writer);
  writer.add(recording::RecordKind::end, Duration{0}, {});
  const std::vector<std::byte> bytes = writer.take_bytes();
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Another narration in each step.
void write_with_narration(const std::string& text, const std::filesystem::path& file) {
  const auto narrate = [&](const recording::FrameRecording::Record& record, recording::RecordingWriter& writer) {
    client::WorldStatus status;
    if (record.kind != recording::RecordKind::status) return writer.add(record.kind, record.time, record.content);
    ASSERT_TRUE(recording::decode(record.content, status));
    status.narration = {{"en", text}};
    writer.add(record.kind, record.time, recording::encode(status));
  };
  write_again(narrate, file);
}

TEST_F(PlayedDisplay, writes_what_is_read_aloud) {
  const auto silent = scratch_.path() / "silent.frames", speaks = scratch_.path() / "speaks.frames";
  write_with_narration("", silent);
  write_with_narration("Steam leaves the two bent pipes.", speaks);
  const std::vector<std::string> without = pictures_of(silent, "without");
  const std::vector<std::string> with = pictures_of(speaks, "with");
  ASSERT_EQ(without.size(), with.size());
  ASSERT_FALSE(with.empty());
  EXPECT_NE(without.front(), with.front());
}

/// With each frame something happens.
void write_with_event(const std::string& kind, const std::filesystem::path& file) {
  const auto happen = [&](const recording::FrameRecording::Record& record, recording::RecordingWriter& writer) {
    writer.add(record.kind, record.time, record.content);
    const client::WorldEvent event{1, kind, "", "", 0};
    if (record.kind == recording::RecordKind::frame)
      writer.add(recording::RecordKind::event, record.time, recording::encode(event));
  };
  write_again(happen, file);
}

TEST_F(PlayedDisplay, writes_what_sounds) {
  const auto silent = scratch_.path() / "silent.frames", sounds = scratch_.path() / "sounds.frames";
  write_with_event("looked", silent);
  write_with_event("broke", sounds);
  const std::vector<std::string> without = pictures_of(silent, "without");
  const std::vector<std::string> with = pictures_of(sounds, "with");
  ASSERT_EQ(without.size(), with.size());
  ASSERT_GE(with.size(), 2U);
  EXPECT_EQ(without.front(), with.front()) << "it is heard from this picture on";
  EXPECT_NE(without.back(), with.back());
}

/// Stands in for a window on a screen.
class StandInWindow : public Window {
 public:
  StandInWindow() : context_(draw::make_offscreen_context({320, 180}).value()) {}
  [[nodiscard]] std::string renderer_name() const override { return context_->renderer_name(); }
  [[nodiscard]] picture::PixelSize size() const override { return {320, 180}; }
  void present() override { ++events_taken; }
  [[nodiscard]] bool lost() const override { return false; }
  [[nodiscard]] Expected<void> renew() override { return {}; }
  [[nodiscard]] int first_row() const override { return 0; }
  [[nodiscard]] bool has_quad_buffer() const override { return false; }
  [[nodiscard]] bool close_wanted() const override { return false; }
  [[nodiscard]] bool take_picture_wanted() override { return false; }
  [[nodiscard]] std::vector<picture::PixelPlace> take_clicks() override { return {}; }
  [[nodiscard]] std::vector<pointer::PointerEvent> take_pointer_events() override { return {}; }
  [[nodiscard]] std::vector<DisplayKey> take_keys() override { return {}; }

  int events_taken = 0;

 private:
  std::unique_ptr<draw::GlContext> context_;
};

/// Too small to be drawn to, until it has taken its events twice; closed after that.
class SmallWindow final : public StandInWindow {
 public:
  [[nodiscard]] picture::PixelSize size() const override {
    return events_taken < 2 ? picture::PixelSize{1, 200} : StandInWindow::size();
  }
  [[nodiscard]] bool close_wanted() const override { return events_taken >= 3; }
};

Expected<DisplaySummary> run_in(Window& window, DisplayOptions options, Worker* worker) {
  options.offscreen = true;  // there is no real window to copy to, but its input counts
  options.assets = (kSource / "scenarios/aiolos-sphere").string();
  options.source.play = (kSource / "tests/golden/scenes/aiolos-sphere.frames").string();
  auto source = open_source(options.source, {});
  if (!source) return tl::unexpected(source.error());
  auto renderer = draw::Renderer::create(options.renderer);
  if (!renderer) return tl::unexpected(renderer.error());
  DisplaySignals signals;
  return DisplayLoop(options, signals, window, &window, std::move(*renderer), *source, nullptr, worker, nullptr).run();
}

TEST(SmallWindow, takes_its_events_and_is_drawn_to_when_it_is_large_again) {
  SmallWindow window;
  DisplayOptions options;
  options.film_fps = 10;  // time goes by pictures: the recording waits for a slow machine
  const auto summary = run_in(window, options, nullptr);
  ASSERT_TRUE(summary) << summary.error().to_string();
  EXPECT_EQ(window.events_taken, 3);
  EXPECT_EQ(summary->frames, 1U);
}

constexpr int kHeldPictures = 5;  ///< so many are drawn before any file is read

/// The files of its world can be read only once some pictures were drawn; a key may be pressed before that.
class WaitingWindow final : public StandInWindow {
 public:
  explicit WaitingWindow(bool key) : key_(key) {}
  void present() override {
    StandInWindow::present();
    if (events_taken >= kHeldPictures) worker.let_go_and_wait();
  }
  [[nodiscard]] std::vector<DisplayKey> take_keys() override {
    if (!key_ || events_taken != 2) return {};
    return {DisplayKey::language};
  }

  test::HeldWorker worker;

 private:
  bool key_;
};

class LoadingDisplay : public testing::Test {
 protected:
  /// Of the recording's first pictures, from 1.
  std::vector<std::string> pictures_in(StandInWindow& window, Worker* worker, const std::string& folder) {
    DisplayOptions options;
    options.language = "en";
    options.out = (scratch_.path() / folder).string();
    std::filesystem::create_directories(options.out);
    options.film_fps = 100;
    options.frames = kHeldPictures + 3;
    options.screen = {1.2, 1.5, 0};  // its view stays where it is, whatever is written in it
    const auto summary = run_in(window, options, worker);
    EXPECT_TRUE(summary) << (summary ? "" : summary.error().to_string());
    std::vector<std::string> pictures(1);
    for (std::size_t i = 1; i <= options.frames; ++i) {
      std::ifstream in(fmt::format("{}/film-{:05}-mono.png", options.out, i), std::ios::binary);
      pictures.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
      EXPECT_FALSE(pictures.back().empty()) << i;
    }
    return pictures;
  }

  test::ScratchFolder scratch_;
};

TEST_F(LoadingDisplay, goes_on_drawing_and_hears_its_visitor_until_the_files_are_there) {
  StandInWindow ready;
  const std::vector<std::string> wanted = pictures_in(ready, nullptr, "ready");
  WaitingWindow calm(false), pressed(true);
  const std::vector<std::string> waited = pictures_in(calm, calm.worker.get(), "calm");
  const std::vector<std::string> asked = pictures_in(pressed, pressed.worker.get(), "pressed");
  for (std::size_t i = 1; i <= kHeldPictures; ++i)
    EXPECT_NE(waited[i], wanted[i]) << i << ": nothing can be read yet";
  EXPECT_EQ(asked[2], waited[2]);
  EXPECT_NE(asked[4], waited[4]) << "the key was heard meanwhile: the words are in another language";
  EXPECT_EQ(waited.back(), wanted.back()) << "all is there, as if it had been from the beginning";
}

TEST_F(PlayedDisplay, draws_each_step_of_a_recording_however_slowly_it_draws) {
  constexpr int kSteps = 6;
  constexpr Duration kStep = std::chrono::milliseconds(700);  // a picture of that size takes longer on a processor
  const auto file = scratch_.path() / "steps.frames";
  {
    const auto recorded =
        recording::FrameRecording::open_file(kSource / "tests/golden/scenes/aiolos-sphere.frames").value();
    recording::RecordingWriter writer;
    const recording::FrameRecording::Record* frame = nullptr;
    client::WorldStatus status;
    for (const recording::FrameRecording::Record& record : recorded.records()) {
      if (record.kind == recording::RecordKind::frame && frame == nullptr) frame = &record;
      if (frame != nullptr) continue;
      if (record.kind == recording::RecordKind::status) {
        ASSERT_TRUE(recording::decode(record.content, status));
      }
      writer.add(record.kind, Duration{0}, record.content);
    }
    ASSERT_NE(frame, nullptr);
    for (int i = 0; i < kSteps; ++i) {
      status.step = "step-" + std::to_string(i);
      writer.add(recording::RecordKind::status, i * kStep, recording::encode(status));
      writer.add(recording::RecordKind::frame, i * kStep, frame->content);
    }
    writer.add(recording::RecordKind::frame, kSteps * kStep, frame->content);
    writer.add(recording::RecordKind::end, kSteps * kStep, {});
    const std::vector<std::byte> bytes = writer.take_bytes();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  DisplayOptions options;
  options.offscreen = true;
  options.every_step = true;
  options.size = {1920, 1080};
  options.assets = (kSource / "scenarios/aiolos-sphere").string();
  options.out = (scratch_.path() / "steps").string();
  options.source.play = file.string();
  DisplaySignals signals;
  const auto summary = run_display(options, signals);
  ASSERT_TRUE(summary) << summary.error().to_string();
  EXPECT_TRUE(summary->steps_missed.empty()) << summary->steps_missed.front();
  EXPECT_EQ(summary->pictures.size(), static_cast<std::size_t>(kSteps));
}

TEST(Window, tells_when_there_is_no_screen) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        unsetenv("DISPLAY");
        unsetenv("WAYLAND_DISPLAY");
        const auto context = make_window({64, 64}, "test");
        if (!context) std::fputs(context.error().to_string().c_str(), stderr);
        std::_Exit(context ? 1 : 0);
      },
      testing::ExitedWithCode(0), "--offscreen");
}

}  // namespace
}  // namespace mechane::display
