// What ALSA's library says of itself.
#pragma once

namespace mechane::sound {

/// Where there is no sound card, ALSA writes a dozen lines about its own files to stderr at each try, past every log. OpenAL loads that library
/// by itself and leaves this as it is; it is asked by name, so that a machine without ALSA needs none. Any thread; again does no harm.
void quieten_alsa();

}  // namespace mechane::sound
