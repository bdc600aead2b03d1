// The visitor in front of a display: keys, clicks, mouse and fingers, questions and answers, the language, going home,
// and the recorded visit that is shown as an invitation when nobody is there.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "client-sdk/display/attract_loop.hpp"
#include "client-sdk/display/display_app.hpp"
#include "client-sdk/display/last_picture.hpp"
#include "client-sdk/display/news.hpp"
#include "client-sdk/display/window.hpp"
#include "client-sdk/pointer/pointer_input.hpp"
#include "client-sdk/visit/decision_sender.hpp"

namespace mechane::display {

/// On the display's thread. `options`, `window` and `news` must outlive it.
class Visitor {
 public:
  /// Gives the world's scene with its camera, as it would be drawn now. Called only if needed.
  using SceneNow = std::function<picture::RenderScene()>;

  /// `window` is null offscreen, where nothing can be pressed. `attract` may be null. `hand`: what the pointer moves;
  /// null: hands of the kiosk.
  Visitor(const DisplayOptions& options, Window* window, News& news, std::unique_ptr<AttractLoop> attract,
          std::unique_ptr<pointer::PointerTouch> hand = nullptr);

  /// Another world is shown: forgets what was pointed at.
  void forget_world();
  /// Takes what was pressed, and sends what follows from it. Call it once a picture.
  void take(const LastPicture& last, const SceneNow& scene, TimePoint now);
  /// Begins, continues or ends the invitation. True: replace all uploaded assets by those of what is shown now.
  [[nodiscard]] bool invite(const client::DisplaySettings& settings, TimePoint now);
  /// Applies settings that were requested from another machine.
  void change(const visit::VisitorPanelSettings& settings) { panel_.change(settings); }

  /// How hands look in all that is shown; a name of scene::hand_look_names().
  void show_hands(const std::string& look);

  /// Adds the visitor's buttons and panels, and the pointer's hints; no panel beside a pose that is asked for. Not for an invitation.
  void write(picture::RenderScene& scene, const LastPicture& last, TimePoint now) const;

  /// The recorded visit, while it is shown; else null.
  [[nodiscard]] AttractLoop* invitation() const { return invites_ ? attract_.get() : nullptr; }
  /// Whether the kiosk shows the server's first scenario.
  [[nodiscard]] bool at_home() const {
    return news_.world().status() != nullptr && news_.world().status()->scenario == home_;
  }
  /// Language of all words in the picture.
  [[nodiscard]] const std::string& language() const { return language_; }
  /// The museum's words to visitors; empty: none.
  [[nodiscard]] std::string message() const { return panel_.message(); }
  [[nodiscard]] const picture::OverlayStyle& style() const { return panel_.settings().style; }
  /// The thing that the pointer would take, or else is on.
  [[nodiscard]] std::optional<picture::Touched> pointed_at() const {
    return pointer_ ? pointer_->pointed_at() : std::nullopt;
  }
  /// Whether the pointer holds something, which must stay under it.
  [[nodiscard]] bool drags() const { return pointer_ && !pointer_->is_away(); }

 private:
  void take_key(DisplayKey key, TimePoint now);
  void take_click(picture::PixelPlace place, const LastPicture& last, const SceneNow& scene, TimePoint now);
  void click_object(picture::PixelPlace place, const LastPicture& last, const picture::RenderScene& scene);
  void take_pointer(const LastPicture& last, const SceneNow& scene, TimePoint now);
  [[nodiscard]] pointer::PointerScene under_pointer(const picture::RenderScene& scene, const LastPicture& last) const;

  Window* window_;
  News& news_;
  client::Client& client_;
  visit::VisitorPanel panel_;
  std::optional<pointer::PointerInput> pointer_;
  std::unique_ptr<AttractLoop> attract_;
  bool invites_ = false;
  bool forces_shown_;
  std::string language_;
  std::string home_;
  visit::DecisionSender decisions_;
};

}  // namespace mechane::display
