// Which device draws without a screen. The machine's own devices are hidden behind two made-up ones.
#include "client-sdk/draw/gl_context.hpp"

#include <cstdint>
#include <cstdlib>
#include <vector>

#include <epoxy/egl.h>
#include <gtest/gtest.h>

namespace mechane::draw {
namespace {

EGLDeviceEXT device(int number) {
  return reinterpret_cast<EGLDeviceEXT>(static_cast<std::intptr_t>(number));
}

const EGLDeviceEXT kProcessor = device(1), kCard = device(2);
std::vector<EGLDeviceEXT> g_asked;  // for a display, in order
bool g_card_opens = true;
EGLDeviceEXT g_draws = kCard;  // what EGL says that it draws with
decltype(epoxy_eglGetPlatformDisplayEXT) g_real_display;

EGLBoolean query_devices(EGLint most, EGLDeviceEXT* devices, EGLint* count) {
  *count = 2;
  if (most >= 2) devices[0] = kProcessor;
  if (most >= 2) devices[1] = kCard;
  return EGL_TRUE;
}
const char* device_string(EGLDeviceEXT asked, EGLint) {
  return asked == kProcessor ? "EGL_MESA_device_software EGL_EXT_device_drm_render_node" : "EGL_EXT_device_drm";
}
EGLBoolean display_attribute(EGLDisplay, EGLint, EGLAttrib* value) {
  *value = reinterpret_cast<EGLAttrib>(g_draws);
  return EGL_TRUE;
}
EGLDisplay platform_display(EGLenum platform, void* native, const EGLint* attributes) {
  if (platform == EGL_PLATFORM_DEVICE_EXT) {
    g_asked.push_back(native);
    if (!g_card_opens) return EGL_NO_DISPLAY;
  } else {
    g_asked.push_back(nullptr);
  }
  return g_real_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, attributes);
}

class OffscreenDevice : public testing::Test {
 protected:
  /// epoxy finds a function when it is first called, and writes it in the place of what stands there: before the made-up ones do.
  static void SetUpTestSuite() { ASSERT_TRUE(make_offscreen_context({16, 16})); }
  OffscreenDevice() {
    epoxy_eglQueryDevicesEXT = query_devices;
    epoxy_eglQueryDeviceStringEXT = device_string;
    epoxy_eglQueryDisplayAttribEXT = display_attribute;
    epoxy_eglGetPlatformDisplayEXT = platform_display;
    unsetenv("LIBGL_ALWAYS_SOFTWARE");
    g_asked.clear();
    g_card_opens = true;
    g_draws = kCard;
  }
  void TearDown() override {
    epoxy_eglQueryDevicesEXT = real_devices_;
    epoxy_eglQueryDeviceStringEXT = real_string_;
    epoxy_eglQueryDisplayAttribEXT = real_attribute_;
    epoxy_eglGetPlatformDisplayEXT = g_real_display;
  }
  static std::vector<EGLDeviceEXT> asked() {
    const auto context = make_offscreen_context({16, 16});
    EXPECT_TRUE(context) << context.error().to_string();
    return g_asked;
  }

 private:
  decltype(epoxy_eglQueryDevicesEXT) real_devices_ = epoxy_eglQueryDevicesEXT;
  decltype(epoxy_eglQueryDeviceStringEXT) real_string_ = epoxy_eglQueryDeviceStringEXT;
  decltype(epoxy_eglQueryDisplayAttribEXT) real_attribute_ = epoxy_eglQueryDisplayAttribEXT;
  decltype(epoxy_eglGetPlatformDisplayEXT) saved_ = g_real_display = epoxy_eglGetPlatformDisplayEXT;
};

using Devices = std::vector<EGLDeviceEXT>;

TEST_F(OffscreenDevice, is_the_graphics_card_and_not_the_processor_beside_it) {
  EXPECT_EQ(asked(), Devices{kCard});
}

TEST_F(OffscreenDevice, is_what_mesa_chooses_where_the_card_cannot_be_used) {
  g_card_opens = false;
  EXPECT_EQ(asked(), (Devices{kCard, nullptr}));
  g_card_opens = true;
  g_draws = kProcessor;  // for want of a driver
  g_asked.clear();
  EXPECT_EQ(asked(), (Devices{kCard, nullptr}));
}

TEST_F(OffscreenDevice, is_the_processor_where_that_is_asked_for) {
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  EXPECT_EQ(asked(), Devices{nullptr});
  unsetenv("LIBGL_ALWAYS_SOFTWARE");
}

}  // namespace
}  // namespace mechane::draw
