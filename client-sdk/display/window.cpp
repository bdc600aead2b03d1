#include <algorithm>
#include <cstdlib>
#include <optional>

#include <epoxy/gl.h>
// Do not let SDL replace main().
#define SDL_MAIN_HANDLED
#include <SDL2/SDL.h>
#include <fmt/format.h>

#include "client-sdk/display/window.hpp"

namespace mechane::display {
namespace {

/// More events than occur between two pictures.
constexpr std::size_t kMostEvents = 10'000;
/// In full screen, the cursor is hidden after the mouse has rested this long.
constexpr std::uint64_t kCursorStays_ms = 3'000;
/// Mouse motions within this time after a touch come from the touch screen: X moves the cursor to the finger.
constexpr std::uint64_t kFingersEcho_ms = 500;

std::optional<pointer::PointerKey> pointer_key(SDL_Scancode key, bool shifted) {
  switch (key) {
    case SDL_SCANCODE_LEFT:
      return pointer::PointerKey::left;
    case SDL_SCANCODE_RIGHT:
      return pointer::PointerKey::right;
    case SDL_SCANCODE_UP:
      return pointer::PointerKey::up;
    case SDL_SCANCODE_DOWN:
      return pointer::PointerKey::down;
    case SDL_SCANCODE_PAGEUP:
      return pointer::PointerKey::farther;
    case SDL_SCANCODE_PAGEDOWN:
      return pointer::PointerKey::nearer;
    case SDL_SCANCODE_SPACE:
      return pointer::PointerKey::take;
    case SDL_SCANCODE_TAB:
      return shifted ? pointer::PointerKey::previous : pointer::PointerKey::next;
    case SDL_SCANCODE_Q:
      return pointer::PointerKey::turn_left;
    case SDL_SCANCODE_E:
      return pointer::PointerKey::turn_right;
    default:
      return {};
  }
}

/// A finger on the glass. SDL's numbers are unique on one screen only, and may be reused.
struct FingerDown {
  SDL_TouchID screen = 0;
  SDL_FingerID number = 0;
  pointer::FingerId id = pointer::kMouse;
};

/// Without a window manager, a window must be moved to the screen before it can fill it.
void fill_screen(SDL_Window* window) {
  SDL_Rect screen;
  if (SDL_GetDisplayBounds(std::max(SDL_GetWindowDisplayIndex(window), 0), &screen) == 0) {
    SDL_SetWindowPosition(window, screen.x, screen.y);
    SDL_SetWindowSize(window, screen.w, screen.h);
  }
  SDL_SetWindowFullscreen(window, SDL_WINDOW_FULLSCREEN_DESKTOP);
}

/// Makes a context that reports resets, where the driver supports this, and makes it current. Null: see SDL_GetError().
SDL_GLContext make_context(SDL_Window* window) {
  SDL_GLContext context = nullptr;
  for (const bool told : {true, false}) {
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_FLAGS, told ? SDL_GL_CONTEXT_ROBUST_ACCESS_FLAG : 0);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_RESET_NOTIFICATION,
                        told ? SDL_GL_CONTEXT_RESET_LOSE_CONTEXT : SDL_GL_CONTEXT_RESET_NO_NOTIFICATION);
    if (context == nullptr) context = SDL_GL_CreateContext(window);
  }
  if (context != nullptr) SDL_GL_SetSwapInterval(1);
  return context;
}

/// Ends SDL in its destructor: there is one window per process.
class SdlWindow final : public Window {
 public:
  SdlWindow(SDL_Window* window, SDL_GLContext context)
      : window_(window), context_(context), name_(reinterpret_cast<const char*>(glGetString(GL_RENDERER))) {}
  SdlWindow(const SdlWindow&) = delete;
  SdlWindow& operator=(const SdlWindow&) = delete;
  ~SdlWindow() override {
    SDL_GL_DeleteContext(context_);
    SDL_DestroyWindow(window_);
    SDL_Quit();
  }

  [[nodiscard]] std::string renderer_name() const override { return name_; }
  [[nodiscard]] bool lost() const override { return draw::driver_was_reset(); }
  [[nodiscard]] Expected<void> renew() override {
    SDL_GL_DeleteContext(context_);
    context_ = make_context(window_);
    if (context_ == nullptr)
      return fail(ErrorCode::busy, std::string("the window has no OpenGL 3.3 at present: ") + SDL_GetError(),
                  "display, window", "wait for the graphics driver");
    return {};
  }
  [[nodiscard]] picture::PixelSize size() const override {
    int width = 0;
    int height = 0;
    SDL_GL_GetDrawableSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(std::max(width, 0)), static_cast<std::uint32_t>(std::max(height, 0))};
  }
  [[nodiscard]] int first_row() const override {
    int x = 0, y = 0;
    SDL_GetWindowPosition(window_, &x, &y);
    return y;
  }
  void present() override {
    SDL_GL_SwapWindow(window_);
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0)
      take(event);
    forget_lost_fingers();
    tend_cursor();
  }
  [[nodiscard]] bool close_wanted() const override { return close_wanted_; }
  [[nodiscard]] bool take_picture_wanted() override { return std::exchange(picture_wanted_, false); }
  [[nodiscard]] bool has_quad_buffer() const override {
    GLboolean has = GL_FALSE;
    glGetBooleanv(GL_STEREO, &has);
    return has == GL_TRUE;
  }
  [[nodiscard]] std::vector<picture::PixelPlace> take_clicks() override { return std::exchange(clicks_, {}); }
  [[nodiscard]] std::vector<pointer::PointerEvent> take_pointer_events() override { return std::exchange(events_, {}); }
  [[nodiscard]] std::vector<DisplayKey> take_keys() override { return std::exchange(keys_, {}); }

  void toggle_full_screen() {
    if (!fills_screen()) {
      SDL_GetWindowSize(window_, &small_.w, &small_.h);
      SDL_GetWindowPosition(window_, &small_.x, &small_.y);
      fill_screen(window_);
      return;
    }
    SDL_SetWindowFullscreen(window_, 0);
    SDL_SetWindowSize(window_, small_.w, small_.h);
    SDL_SetWindowPosition(window_, small_.x, small_.y);
  }

 private:
  void take(const SDL_Event& event) {
    switch (event.type) {
      case SDL_QUIT:
        close_wanted_ = true;
        return;
      case SDL_WINDOWEVENT:
        return take_window(event.window);
      case SDL_KEYDOWN:
      case SDL_KEYUP:
        if (event.key.repeat == 0) take_key(event.key);
        return;
      case SDL_TEXTINPUT:
        // The place of the plus key depends on the keyboard's layout.
        if (std::string_view(static_cast<const char*>(event.text.text)) == "+") keys_.push_back(DisplayKey::large_text);
        return;
      case SDL_MOUSEBUTTONDOWN:
      case SDL_MOUSEBUTTONUP:
        return take_button(event.button);
      case SDL_MOUSEMOTION:
        return take_motion(event.motion);
      case SDL_MOUSEWHEEL:
        return take_wheel(event.wheel);
      case SDL_FINGERDOWN:
      case SDL_FINGERUP:
      case SDL_FINGERMOTION:
        return take_finger(event.tfinger);
      default:
        return;
    }
  }
  void take_window(const SDL_WindowEvent& event) {
    if (event.event == SDL_WINDOWEVENT_LEAVE) say({pointer::PointerEvent::Kind::left});
    // A window without focus does not receive the release of a finger or button.
    if (event.event == SDL_WINDOWEVENT_FOCUS_LOST || event.event == SDL_WINDOWEVENT_HIDDEN ||
        event.event == SDL_WINDOWEVENT_MINIMIZED) {
      fingers_.clear();
      say({pointer::PointerEvent::Kind::gone});
    }
  }
  /// By the key's place, whatever its letter in the visitor's alphabet.
  void take_key(const SDL_KeyboardEvent& event) {
    const SDL_Scancode key = event.keysym.scancode;
    if (event.type == SDL_KEYDOWN) {
      if (key == SDL_SCANCODE_ESCAPE) close_wanted_ = true;
      if (key == SDL_SCANCODE_P) picture_wanted_ = true;
      if (key == SDL_SCANCODE_HOME) keys_.push_back(DisplayKey::home);
      if (key == SDL_SCANCODE_L) keys_.push_back(DisplayKey::language);
      if (key == SDL_SCANCODE_C) keys_.push_back(DisplayKey::high_contrast);
      if (key == SDL_SCANCODE_F) keys_.push_back(DisplayKey::forces);
      if (key == SDL_SCANCODE_F11) toggle_full_screen();
    }
    const auto meant = pointer_key(key, (event.keysym.mod & KMOD_SHIFT) != 0);
    if (!meant) return;
    pointer::PointerEvent said{event.type == SDL_KEYDOWN ? pointer::PointerEvent::Kind::key_down
                                                         : pointer::PointerEvent::Kind::key_up};
    said.key = *meant;
    say(said);
  }
  void take_button(const SDL_MouseButtonEvent& event) {
    if (event.which == SDL_TOUCH_MOUSEID) return;
    using Kind = pointer::PointerEvent::Kind;
    const bool pressed = event.type == SDL_MOUSEBUTTONDOWN;
    if (event.button == SDL_BUTTON_LEFT) say_mouse(pressed ? Kind::press : Kind::release, event.x, event.y);
    if (event.button == SDL_BUTTON_RIGHT) say_mouse(pressed ? Kind::turn_press : Kind::turn_release, event.x, event.y);
  }
  void take_motion(const SDL_MouseMotionEvent& event) {
    const bool of_a_finger =
        event.which == SDL_TOUCH_MOUSEID || !fingers_.empty() || SDL_GetTicks64() < finger_ms_ + kFingersEcho_ms;
    if (of_a_finger) return;
    mouse_ms_ = SDL_GetTicks64();
    touched_ = false;
    say_mouse(pointer::PointerEvent::Kind::move, event.x, event.y);
  }
  void take_wheel(const SDL_MouseWheelEvent& event) {
    if (event.which == SDL_TOUCH_MOUSEID) return;
    const bool turns = (SDL_GetModState() & KMOD_SHIFT) != 0;
    // With some mice, the wheel scrolls sideways while Shift is held.
    const double rolled = turns && event.preciseY == 0 ? event.preciseX : event.preciseY;
    pointer::PointerEvent said{turns ? pointer::PointerEvent::Kind::turn_wheel : pointer::PointerEvent::Kind::wheel};
    said.amount = event.direction == SDL_MOUSEWHEEL_FLIPPED ? -rolled : rolled;
    say(said);
  }
  void take_finger(const SDL_TouchFingerEvent& event) {
    touched_ = true;
    finger_ms_ = SDL_GetTicks64();
    const auto known = std::ranges::find_if(fingers_, [&](const FingerDown& finger) {
      return finger.screen == event.touchId && finger.number == event.fingerId;
    });
    if (event.type == SDL_FINGERDOWN) {
      if (known != fingers_.end()) lift(known - fingers_.begin());
      fingers_.push_back({event.touchId, event.fingerId, ++last_finger_});
      return say_finger(pointer::PointerEvent::Kind::press, event, last_finger_);
    }
    if (known == fingers_.end()) return;  // it was pressed before the window existed
    if (event.type == SDL_FINGERMOTION) return say_finger(pointer::PointerEvent::Kind::move, event, known->id);
    say_finger(pointer::PointerEvent::Kind::release, event, known->id);
    fingers_.erase(known);
  }
  /// Releases the fingers of a screen that was unplugged.
  void forget_lost_fingers() {
    for (std::ptrdiff_t i = std::ssize(fingers_) - 1; i >= 0; --i) {
      const SDL_TouchID screen = fingers_[static_cast<std::size_t>(i)].screen;
      bool there = false;
      for (int k = 0; k < SDL_GetNumTouchDevices(); ++k)
        there = there || SDL_GetTouchDevice(k) == screen;
      if (!there) lift(i);
    }
  }
  void lift(std::ptrdiff_t index) {
    pointer::PointerEvent said{pointer::PointerEvent::Kind::release};
    said.finger = fingers_[static_cast<std::size_t>(index)].id;
    fingers_.erase(fingers_.begin() + index);
    say(said);
  }

  /// Mouse positions are in window units; the picture may have more pixels.
  void say_mouse(pointer::PointerEvent::Kind kind, int x, int y) {
    int width = 0, height = 0;
    SDL_GetWindowSize(window_, &width, &height);
    if (width <= 0 || height <= 0) return;
    const picture::PixelSize picture = size();
    say({kind, x * static_cast<double>(picture.width) / width, y * static_cast<double>(picture.height) / height});
  }
  /// Finger positions are in shares of the window's size.
  void say_finger(pointer::PointerEvent::Kind kind, const SDL_TouchFingerEvent& event, pointer::FingerId id) {
    const picture::PixelSize picture = size();
    pointer::PointerEvent said{kind, static_cast<double>(event.x) * picture.width,
                               static_cast<double>(event.y) * picture.height};
    said.finger = id;
    say(said);
  }
  /// When the queue is full, motions are dropped, but never the last one.
  void say(const pointer::PointerEvent& event) {
    if (event.kind == pointer::PointerEvent::Kind::move && events_.size() >= kMostEvents) return;
    events_.push_back(event);
    if (event.kind == pointer::PointerEvent::Kind::press) clicks_.push_back({event.x, event.y});
  }

  [[nodiscard]] bool fills_screen() const { return (SDL_GetWindowFlags(window_) & SDL_WINDOW_FULLSCREEN) != 0; }
  void tend_cursor() {
    const bool rests = fills_screen() && SDL_GetTicks64() > mouse_ms_ + kCursorStays_ms;
    const bool shown = !touched_ && !rests;
    if (shown == cursor_shown_) return;
    cursor_shown_ = shown;
    SDL_ShowCursor(shown ? SDL_ENABLE : SDL_DISABLE);
  }

  SDL_Window* window_;
  SDL_GLContext context_;
  std::string name_;
  SDL_Rect small_{80, 80, 1280, 720};  ///< place and size when it does not fill the screen
  bool close_wanted_ = false;
  bool picture_wanted_ = false;
  bool cursor_shown_ = true;
  bool touched_ = false;  ///< a finger was used after the mouse's last motion
  std::uint64_t mouse_ms_ = SDL_GetTicks64();
  std::uint64_t finger_ms_ = 0;
  pointer::FingerId last_finger_ = pointer::kMouse;
  std::vector<FingerDown> fingers_;
  std::vector<DisplayKey> keys_;
  std::vector<picture::PixelPlace> clicks_;
  std::vector<pointer::PointerEvent> events_;
};

std::string text_of(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? "" : text;
}

void set_hints() {
  SDL_SetHint(SDL_HINT_APP_NAME, "Mechane");
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  // Do not repeat finger events as mouse events.
  SDL_SetHint(SDL_HINT_TOUCH_MOUSE_EVENTS, "0");
  SDL_SetHint(SDL_HINT_MOUSE_TOUCH_EVENTS, "0");
  // The click that focuses the window counts as a visitor's click too.
  SDL_SetHint(SDL_HINT_MOUSE_FOCUS_CLICKTHROUGH, "1");
  SDL_SetHint(SDL_HINT_VIDEO_MINIMIZE_ON_FOCUS_LOSS, "0");
  SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
}

/// Opens a real screen only: SDL would also try its offscreen drivers.
Expected<void> open_screen() {
  const std::string remedy = "start it in a desktop session (DISPLAY set), or give --offscreen";
  const std::string x11 = text_of("DISPLAY"), wayland = text_of("WAYLAND_DISPLAY");
  set_hints();
  if (text_of("SDL_VIDEODRIVER").empty()) {
    if (x11.empty() && wayland.empty())
      return fail(ErrorCode::not_found, "cannot open a window: neither DISPLAY nor WAYLAND_DISPLAY names a screen",
                  "display, window", remedy);
    const std::string drivers = std::string(x11.empty() ? "" : "x11") + (!x11.empty() && !wayland.empty() ? "," : "") +
                                (wayland.empty() ? "" : "wayland");
    SDL_SetHint(SDL_HINT_VIDEODRIVER, drivers.c_str());
  }
  SDL_SetMainReady();
  if (SDL_Init(SDL_INIT_VIDEO) == 0) return {};
  return fail(
      ErrorCode::not_found,
      fmt::format("cannot open a window: {} (DISPLAY is '{}', WAYLAND_DISPLAY is '{}')", SDL_GetError(), x11, wayland),
      "display, window", remedy);
}

struct OpenedWindow {
  SDL_Window* window = nullptr;
  SDL_GLContext context = nullptr;
};

/// The window and its context; both null on failure.
OpenedWindow open_window(picture::PixelSize size, const std::string& title, bool stereo) {
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 3);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
  for (const SDL_GLattr channel : {SDL_GL_RED_SIZE, SDL_GL_GREEN_SIZE, SDL_GL_BLUE_SIZE})
    SDL_GL_SetAttribute(channel, 8);
  // The renderer's own targets have depth and anti-aliasing.
  SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0);
  SDL_GL_SetAttribute(SDL_GL_MULTISAMPLEBUFFERS, 0);
  // Without driver support for this, SDL opens no window at all.
  SDL_GL_SetAttribute(SDL_GL_STEREO, stereo ? 1 : 0);
  const std::uint32_t flags = SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI;
  OpenedWindow opened;
  opened.window = SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                   static_cast<int>(size.width), static_cast<int>(size.height), flags);
  if (opened.window == nullptr) return {};
  opened.context = make_context(opened.window);
  if (opened.context != nullptr) return opened;
  SDL_DestroyWindow(opened.window);
  return {};
}

}  // namespace

Expected<std::unique_ptr<Window>> make_window(picture::PixelSize size, const std::string& title,
                                              const WindowOptions& options) {
  if (auto ok = open_screen(); !ok) {
    SDL_Quit();
    return tl::unexpected(ok.error());
  }
  OpenedWindow opened = options.quad_buffer ? open_window(size, title, true) : OpenedWindow{};
  if (opened.window == nullptr) opened = open_window(size, title, false);
  if (opened.window == nullptr) {
    const std::string reason = SDL_GetError();
    SDL_Quit();
    return fail(ErrorCode::not_supported, "cannot open a window with OpenGL 3.3: " + reason, "display, window",
                "install a graphics driver, or give --offscreen");
  }
  // A kiosk must stay visible when nobody touches it for a while.
  SDL_DisableScreenSaver();
  auto context = std::make_unique<SdlWindow>(opened.window, opened.context);
  if (options.full_screen) context->toggle_full_screen();
  return context;
}

}  // namespace mechane::display
