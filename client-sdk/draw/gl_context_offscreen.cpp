#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include "client-sdk/draw/gl_context.hpp"

namespace mechane::draw {
namespace {

constexpr const char* kRemedy =
    "install libegl-mesa0 and libgl1-mesa-dri (deploy/install-deps does), or run without --offscreen";

/// A context that reports resets, where the driver supports this. Null: failed, see eglGetError().
EGLContext make_context(EGLDisplay display) {
  constexpr EGLint kMajor = EGL_CONTEXT_MAJOR_VERSION, kMinor = EGL_CONTEXT_MINOR_VERSION;
  const std::array<EGLint, 11> told{kMajor,
                                    3,
                                    kMinor,
                                    3,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_CONTEXT_OPENGL_ROBUST_ACCESS,
                                    EGL_TRUE,
                                    EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                    EGL_LOSE_CONTEXT_ON_RESET,
                                    EGL_NONE};
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, told.data());
  if (context == EGL_NO_CONTEXT) {
    const std::array<EGLint, 7> plain{
        kMajor, 3, kMinor, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, plain.data());
  }
  if (context == EGL_NO_CONTEXT) return context;
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) return context;
  eglDestroyContext(display, context);
  return EGL_NO_CONTEXT;
}

Error no_context() {
  return {ErrorCode::not_supported,
          fmt::format("there is no OpenGL 3.3 core context (EGL error 0x{:x})", eglGetError()), "display, offscreen",
          kRemedy};
}

class OffscreenContext final : public GlContext {
 public:
  OffscreenContext(EGLDisplay display, EGLContext context, picture::PixelSize size)
      : display_(display),
        context_(context),
        size_(size),
        name_(reinterpret_cast<const char*>(glGetString(GL_RENDERER))) {}
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
  ~OffscreenContext() override {
    drop();
    eglTerminate(display_);
    eglReleaseThread();
  }

  [[nodiscard]] std::string renderer_name() const override { return name_; }
  [[nodiscard]] bool lost() const override { return driver_was_reset(); }
  [[nodiscard]] Expected<void> renew() override {
    drop();
    context_ = make_context(display_);
    return context_ == EGL_NO_CONTEXT ? Expected<void>(tl::unexpected(no_context())) : Expected<void>();
  }
  [[nodiscard]] picture::PixelSize size() const override { return size_; }
  void present() override {}

 private:
  void drop() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    context_ = EGL_NO_CONTEXT;
  }

  EGLDisplay display_;
  EGLContext context_;
  picture::PixelSize size_;
  std::string name_;
};

bool has_word(const char* words, std::string_view word) {
  const std::string_view all = words == nullptr ? "" : words;
  const std::size_t at = all.find(word);
  const std::size_t end = at + word.size();
  return at != std::string_view::npos && (at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ');
}

bool is_software(EGLDeviceEXT device) {
  return has_word(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

/// Whether Mesa draws with the processor, because it has no driver for the requested card.
bool fell_back_to_software(EGLDisplay display) {
  EGLAttrib device = 0;
  if (eglQueryDisplayAttribEXT(display, EGL_DEVICE_EXT, &device) == EGL_FALSE) return true;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): EGL returns pointers as numbers
  return is_software(reinterpret_cast<EGLDeviceEXT>(device));
}

/// Graphics cards, in the system's order. None where Mesa was set to draw with the processor.
std::vector<EGLDeviceEXT> graphics_cards(const char* extensions) {
  const char* asked = std::getenv("LIBGL_ALWAYS_SOFTWARE");
  if (asked != nullptr && std::string_view(asked) != "0" && std::string_view(asked) != "false") return {};
  const bool enumerates =
      has_word(extensions, "EGL_EXT_device_base") ||
      (has_word(extensions, "EGL_EXT_device_enumeration") && has_word(extensions, "EGL_EXT_device_query"));
  EGLint count = 0;
  if (!enumerates || !has_word(extensions, "EGL_EXT_platform_device") ||
      eglQueryDevicesEXT(0, nullptr, &count) == EGL_FALSE || count <= 0)
    return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (eglQueryDevicesEXT(count, devices.data(), &count) == EGL_FALSE) return {};
  devices.resize(static_cast<std::size_t>(count));
  std::erase_if(devices, is_software);
  return devices;
}

struct Opened {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

/// A context on the first card that can be opened and has OpenGL 3.3, if there is one.
Opened open_card(const char* extensions) {
  for (EGLDeviceEXT device : graphics_cards(extensions)) {
    EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) continue;
    eglBindAPI(EGL_OPENGL_API);
    EGLContext context = fell_back_to_software(display) ? EGL_NO_CONTEXT : make_context(display);
    if (context != EGL_NO_CONTEXT) return {display, context};
    eglTerminate(display);
  }
  return {};
}

Expected<Opened> open_surfaceless(const char* extensions) {
  if (!has_word(extensions, "EGL_MESA_platform_surfaceless")) {
    return fail(ErrorCode::not_supported,
                "this machine's EGL cannot draw without a screen (no EGL_MESA_platform_surfaceless)",
                "display, offscreen", kRemedy);
  }
  EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    return fail(ErrorCode::not_supported, fmt::format("EGL did not start (error 0x{:x})", eglGetError()),
                "display, offscreen", kRemedy);
  }
  eglBindAPI(EGL_OPENGL_API);
  EGLContext context = make_context(display);
  if (context != EGL_NO_CONTEXT) return Opened{display, context};
  const Error error = no_context();
  eglTerminate(display);
  return tl::unexpected(error);
}

}  // namespace

Expected<std::unique_ptr<GlContext>> make_offscreen_context(picture::PixelSize size) {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  Expected<Opened> opened = open_card(extensions);
  // Without a device, Mesa would choose, and would draw with the processor beside a card of another driver.
  if (opened->display == EGL_NO_DISPLAY) opened = open_surfaceless(extensions);
  if (!opened) return tl::unexpected(opened.error());
  return std::make_unique<OffscreenContext>(opened->display, opened->context, size);
}

}  // namespace mechane::draw
