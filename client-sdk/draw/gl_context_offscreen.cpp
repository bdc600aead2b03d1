#include <array>
#include <string>
#include <string_view>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <link.h>

#include "client-sdk/draw/gl_context.hpp"

namespace mechane::draw {
namespace {

constexpr const char* kRemedy =
    "install libegl-mesa0 and libgl1-mesa-dri (deploy/install-deps does), or run without --offscreen";

#if defined(__SANITIZE_ADDRESS__)
/// Keeps the driver's code loaded after its context is gone: a leak report can then name the driver, and tests/support/lsan.supp can
/// leave Mesa's own leaks out.
void keep_driver_loaded() {
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void*) {
        if (std::string_view(info->dlpi_name).find("_dri.so") != std::string_view::npos) {
          dlopen(info->dlpi_name, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
        }
        return 0;
      },
      nullptr);
}
#else
void keep_driver_loaded() {}
#endif

/// Told of resets where the driver can tell. Null: none, see eglGetError().
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
  return {fmt::format("no OpenGL 3.3 core context (EGL error 0x{:x})", eglGetError()), "display, offscreen", kRemedy};
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

}  // namespace

Expected<std::unique_ptr<GlContext>> make_offscreen_context(picture::PixelSize size) {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (extensions == nullptr || std::string(extensions).find("EGL_MESA_platform_surfaceless") == std::string::npos) {
    return fail("this machine's EGL cannot draw without a screen (no EGL_MESA_platform_surfaceless)",
                "display, offscreen", kRemedy);
  }
  EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    return fail(fmt::format("EGL did not start (error 0x{:x})", eglGetError()), "display, offscreen", kRemedy);
  }
  eglBindAPI(EGL_OPENGL_API);
  EGLContext context = make_context(display);
  if (context == EGL_NO_CONTEXT) {
    const Error error = no_context();
    eglTerminate(display);
    return tl::unexpected(error);
  }
  keep_driver_loaded();
  return std::make_unique<OffscreenContext>(display, context, size);
}

}  // namespace mechane::draw
