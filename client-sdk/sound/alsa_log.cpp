#include "client-sdk/sound/alsa_log.hpp"

#include <dlfcn.h>

namespace mechane::sound {
namespace {

/// Of the type that ALSA asks for.
void say_nothing(const char* /*file*/, int /*line*/, const char* /*function*/, int /*error*/, const char* /*format*/,
                 ...) {}

}  // namespace

void quieten_alsa() {
  using Handler = void (*)(const char* file, int line, const char* function, int error, const char* format, ...);
  // Never closed, because the library keeps the handler.
  void* const alsa = dlopen("libasound.so.2", RTLD_LAZY | RTLD_LOCAL);
  if (alsa == nullptr) return;
  const auto set_handler = reinterpret_cast<int (*)(Handler)>(dlsym(alsa, "snd_lib_error_set_handler"));
  if (set_handler != nullptr) set_handler(say_nothing);
}

}  // namespace mechane::sound
