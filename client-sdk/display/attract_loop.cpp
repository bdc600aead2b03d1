#include "client-sdk/display/attract_loop.hpp"

#include "client-sdk/visit/overlay_text.hpp"

namespace mechane::display {
namespace {

constexpr const char* kInviteEnglish = "Touch to begin";
constexpr const char* kInviteGreek = "Αγγίξτε για να ξεκινήσετε";

recording::PlaySettings over_and_over() {
  recording::PlaySettings settings;
  settings.again = true;
  return settings;
}

/// Without the recorded visit's steps, gauges and questions.
picture::OverlayContent invitation(const client::WorldStatus* status, const std::string& language,
                                   const picture::OverlayStyle& style) {
  picture::OverlayContent content;
  const bool greek = language == "el";
  if (status != nullptr) content.title = visit::text_in(status->title, language);
  content.caption = greek ? kInviteGreek : kInviteEnglish;
  content.hint = greek ? kInviteEnglish : kInviteGreek;
  content.style = style;
  return content;
}

}  // namespace

Expected<std::unique_ptr<AttractLoop>> AttractLoop::open(const std::string& file, scene::AssetSource assets) {
  auto recording = recording::FrameRecording::open_file(file);
  if (!recording) return tl::unexpected(recording.error());
  return std::unique_ptr<AttractLoop>(new AttractLoop(std::move(*recording), std::move(assets)));
}

AttractLoop::AttractLoop(recording::FrameRecording recording, scene::AssetSource assets)
    : recorded_(std::move(recording), over_and_over()), world_(std::move(assets), "en") {}

bool AttractLoop::advance(TimePoint now) {
  recorded_.advance(now);
  const scene::ShownWorld::News news = world_.hear(recorded_);
  return news.another_world || news.assets;
}

picture::RenderScene AttractLoop::build(TimePoint now, const std::string& language,
                                        const picture::OverlayStyle& style) {
  client::Frame frame;
  const bool any = recorded_.interpolated_frame(now, Duration{0}, frame);
  for (client::HandPose& hand : frame.hands)
    hand.force_W = Vec3::Zero();
  picture::RenderScene scene = world_.build(any ? &frame : nullptr, client::LinkState::joined);
  scene.overlay = invitation(world_.status(), language, style);
  scene.inset.reset();
  return scene;
}

}  // namespace mechane::display
