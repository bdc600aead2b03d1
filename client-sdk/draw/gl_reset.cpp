#include <epoxy/gl.h>

#include "client-sdk/draw/gl_context.hpp"

namespace mechane::draw {

bool driver_was_reset() {
  if (epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness"))
    return glGetGraphicsResetStatus() != GL_NO_ERROR;
  return epoxy_has_gl_extension("GL_ARB_robustness") && glGetGraphicsResetStatusARB() != GL_NO_ERROR;
}

}  // namespace mechane::draw
