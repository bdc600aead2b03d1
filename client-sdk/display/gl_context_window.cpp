#include <epoxy/gl.h>
// After epoxy, which brings the OpenGL declarations.
#include <GLFW/glfw3.h>

#include "client-sdk/display/gl_context.hpp"

namespace mechane::display {
namespace {

/// More than anybody does between two pictures.
constexpr std::size_t kMostEvents = 10'000;

std::optional<PointerKey> pointer_key(int key, bool shifted) {
  switch (key) {
    case GLFW_KEY_LEFT:
      return PointerKey::left;
    case GLFW_KEY_RIGHT:
      return PointerKey::right;
    case GLFW_KEY_UP:
      return PointerKey::up;
    case GLFW_KEY_DOWN:
      return PointerKey::down;
    case GLFW_KEY_PAGE_UP:
      return PointerKey::farther;
    case GLFW_KEY_PAGE_DOWN:
      return PointerKey::nearer;
    case GLFW_KEY_SPACE:
      return PointerKey::take;
    case GLFW_KEY_TAB:
      return shifted ? PointerKey::previous : PointerKey::next;
    default:
      return {};
  }
}

class WindowContext final : public GlContext {
 public:
  explicit WindowContext(GLFWwindow* window) : window_(window) {
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int shifted) {
      auto* const self = static_cast<WindowContext*>(glfwGetWindowUserPointer(w));
      if (action == GLFW_PRESS) self->on_key(key);
      if (action != GLFW_REPEAT) self->on_pointer_key(key, (shifted & GLFW_MOD_SHIFT) != 0, action == GLFW_PRESS);
    });
    // Where the plus is on a keyboard, only its own layout knows.
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned int letter) {
      if (letter == '+')
        static_cast<WindowContext*>(glfwGetWindowUserPointer(w))->keys_.push_back(DisplayKey::large_text);
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
      if (button == GLFW_MOUSE_BUTTON_LEFT)
        static_cast<WindowContext*>(glfwGetWindowUserPointer(w))->on_button(action == GLFW_PRESS);
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
      static_cast<WindowContext*>(glfwGetWindowUserPointer(w))->on_pointer(PointerEvent::Kind::move, x, y);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double notches) {
      static_cast<WindowContext*>(glfwGetWindowUserPointer(w))
          ->events_.push_back({PointerEvent::Kind::wheel, 0, 0, notches});
    });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int inside) {
      if (inside == GLFW_FALSE)
        static_cast<WindowContext*>(glfwGetWindowUserPointer(w))->events_.push_back({PointerEvent::Kind::left});
    });
  }
  WindowContext(const WindowContext&) = delete;
  WindowContext& operator=(const WindowContext&) = delete;
  ~WindowContext() override {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

  [[nodiscard]] std::string renderer_name() const override {
    return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  }
  [[nodiscard]] PixelSize size() const override {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  }
  void present() override {
    glfwSwapBuffers(window_);
    glfwPollEvents();
  }
  [[nodiscard]] bool close_wanted() const override { return glfwWindowShouldClose(window_) != 0; }
  [[nodiscard]] bool take_picture_wanted() override { return std::exchange(picture_wanted_, false); }
  [[nodiscard]] bool has_quad_buffer() const override {
    GLboolean has = GL_FALSE;
    glGetBooleanv(GL_STEREO, &has);
    return has == GL_TRUE;
  }
  [[nodiscard]] std::optional<PixelPlace> take_click() override { return std::exchange(click_, std::nullopt); }
  [[nodiscard]] std::vector<PointerEvent> take_pointer_events() override { return std::exchange(events_, {}); }
  [[nodiscard]] std::vector<DisplayKey> take_keys() override { return std::exchange(keys_, {}); }

 private:
  void on_key(int key) {
    if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window_, GLFW_TRUE);
    if (key == GLFW_KEY_P) picture_wanted_ = true;
    if (key == GLFW_KEY_HOME) keys_.push_back(DisplayKey::home);
    if (key == GLFW_KEY_L) keys_.push_back(DisplayKey::language);
    if (key == GLFW_KEY_C) keys_.push_back(DisplayKey::high_contrast);
    if (key == GLFW_KEY_F11) toggle_full_screen();
  }
  void on_button(bool pressed) {
    double x = 0, y = 0;
    glfwGetCursorPos(window_, &x, &y);
    on_pointer(pressed ? PointerEvent::Kind::press : PointerEvent::Kind::release, x, y);
    if (pressed && !events_.empty()) click_ = PixelPlace{events_.back().x, events_.back().y};
  }
  /// The cursor is told in the window's units; a picture may have more pixels than those.
  void on_pointer(PointerEvent::Kind kind, double x, double y) {
    int width = 0, height = 0;
    glfwGetWindowSize(window_, &width, &height);
    if (width <= 0 || height <= 0) return;
    if (events_.size() >= kMostEvents) events_.erase(events_.begin());
    events_.push_back({kind, x * size().width / width, y * size().height / height});
  }
  void on_pointer_key(int key, bool shifted, bool pressed) {
    const auto meant = pointer_key(key, shifted);
    if (!meant) return;
    PointerEvent event{pressed ? PointerEvent::Kind::key_down : PointerEvent::Kind::key_up};
    event.key = *meant;
    events_.push_back(event);
  }
  void toggle_full_screen() {
    if (glfwGetWindowMonitor(window_) != nullptr) {
      glfwSetWindowMonitor(window_, nullptr, 80, 80, 1280, 720, GLFW_DONT_CARE);
      return;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    if (mode != nullptr) glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  }

  GLFWwindow* window_;
  bool picture_wanted_ = false;
  std::vector<DisplayKey> keys_;
  std::optional<PixelPlace> click_;
  std::vector<PointerEvent> events_;
};

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : text;
}

}  // namespace

Expected<std::unique_ptr<GlContext>> make_window_context(PixelSize size, const std::string& title, bool quad_buffer) {
  if (glfwInit() == GLFW_FALSE) {
    return fail("cannot open a window: " + last_glfw_error(), "display, window",
                "start it in a desktop session (DISPLAY set), or give --offscreen");
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  // Anti-aliasing is done in the renderer's own targets.
  glfwWindowHint(GLFW_SAMPLES, 0);
  const auto open = [&](bool stereo) {
    // GLFW opens no window at all where the driver lacks this.
    glfwWindowHint(GLFW_STEREO, stereo ? GLFW_TRUE : GLFW_FALSE);
    return glfwCreateWindow(static_cast<int>(size.width), static_cast<int>(size.height), title.c_str(), nullptr,
                            nullptr);
  };
  GLFWwindow* window = quad_buffer ? open(true) : nullptr;
  if (window == nullptr) window = open(false);
  if (window == nullptr) {
    const std::string reason = last_glfw_error();
    glfwTerminate();
    return fail("no window with OpenGL 3.3: " + reason, "display, window",
                "install a graphics driver, or give --offscreen");
  }
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  return std::make_unique<WindowContext>(window);
}

}  // namespace mechane::display
