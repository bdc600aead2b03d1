// Silences the messages of ALSA's library.
#pragma once

namespace mechane::sound {

/// Where there is no sound card, ALSA writes a dozen lines about its own files to stderr at each try. OpenAL loads that
/// library by itself and does not change this. The library is looked up at run time, so that a machine without ALSA
/// does not need it. Any thread; may be called repeatedly.
void quieten_alsa();

}  // namespace mechane::sound
