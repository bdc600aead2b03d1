#include "client-sdk/sound/sound_engine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#define AL_ALEXT_PROTOTYPES
#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <fmt/format.h>

#include "client-sdk/sound/alsa_log.hpp"
#include "client-sdk/sound/sound_file.hpp"
#include "server/base/assert.hpp"
#include "server/log/log.hpp"

namespace mechane::sound {
namespace {

constexpr std::size_t kVoices = 24;
constexpr double kGlide_s = 0.08;  ///< a gain's time constant
constexpr double kDuck_s = 0.15;
constexpr float kSilent = 1e-3F;
constexpr float kFarthest_m = 40;  ///< beyond it, sounds do not become quieter
constexpr double kVoiceGain = 0.9;

struct DeviceClose {
  void operator()(ALCdevice* device) const { alcCloseDevice(device); }
};
struct ContextClose {
  void operator()(ALCcontext* context) const {
    alcSetThreadContext(nullptr);
    alcDestroyContext(context);
  }
};

std::int16_t sample_16(float value) {
  return static_cast<std::int16_t>(std::lround(32767 * std::clamp(value, -1.0F, 1.0F)));
}

ALuint make_clip_buffer(const SoundClip& clip) {
  std::vector<std::int16_t> samples(clip.samples.size());
  std::ranges::transform(clip.samples, samples.begin(), sample_16);
  ALuint buffer = 0;
  alGenBuffers(1, &buffer);
  alBufferData(buffer, AL_FORMAT_MONO16, samples.data(), static_cast<ALsizei>(2 * samples.size()), kSoundRate_hz);
  return buffer;
}

/// One of OpenAL's sources, and what it plays.
struct Voice {
  ALuint source = 0;
  std::string id;  ///< empty: free
  bool looped = false;
  double gain = 0;    ///< as heard
  double target = 0;  ///< the gain that it moves towards
  double heard = 0;   ///< its loudness at the listener, in the last scene that had it
};

void release(Voice& voice) {
  alSourceStop(voice.source);
  alSourcei(voice.source, AL_BUFFER, 0);
  voice = {voice.source, {}, false, 0, 0, 0};
}

double towards(double from, double to, double step_s, double glide_s) {
  return to + (from - to) * std::exp(-step_s / glide_s);
}

double near_of(const SoundSource& source) {
  return std::clamp(source.near_m, 0.1, double{kFarthest_m});
}

/// The same formula as OpenAL's AL_INVERSE_DISTANCE_CLAMPED.
double heard(const SoundSource& source, const Vec3& p_W) {
  const double distance = std::clamp((source.p_W - p_W).norm(), near_of(source), double{kFarthest_m});
  return source.gain * near_of(source) / distance;
}

void set_vector(ALuint source, ALenum name, const Vec3& v) {
  alSource3f(source, name, static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
}

}  // namespace

struct SoundEngine::Impl {
  SoundOutput output = SoundOutput::device;
  std::unique_ptr<ALCdevice, DeviceClose> device;
  std::unique_ptr<ALCcontext, ContextClose> context;
  std::array<ALuint, kSoundKinds.size()> clips{};
  std::array<Voice, kVoices> voices;
  std::set<std::string> begun;  ///< ids of the last scene's one-shot sounds: each begins once
  ALuint speech = 0;            ///< source
  ALuint speech_buffer = 0;
  std::string narration;  ///< id of the last scene's narration; it may have ended
  double duck = 1;
  std::set<std::string> bad_files;

  Expected<void> open_device();
  void make_voices();
  void listen(const SoundListener& listener, const SoundLevels& levels) const;
  void set_narration(const std::optional<Narration>& wanted);
  void begin_speech(const std::string& file);
  void end_speech();
  void set_voices(const SoundScene& scene);
  Voice* voice_of(const std::string& id);
  Voice* take_voice(double heard_gain);
  void begin(Voice& voice, const SoundSource& source);
  void move_gains(double step_s);
};

Expected<void> SoundEngine::Impl::open_device() {
  const char* remedy =
      "connect a loudspeaker and check the system's sound settings; captions are shown without sound too";
  if (output == SoundOutput::samples) {
    device.reset(alcLoopbackOpenDeviceSOFT(nullptr));
  } else {
    quieten_alsa();
    device.reset(alcOpenDevice(nullptr));
  }
  if (!device) return fail(ErrorCode::not_found, "there is no sound device", "sound", remedy);
  std::vector<ALCint> requests{ALC_FREQUENCY, kSoundRate_hz};
  // Many sounds at once must not clip.
  requests.insert(requests.end(), {ALC_OUTPUT_LIMITER_SOFT, ALC_TRUE});
  if (output == SoundOutput::samples) {
    requests.insert(requests.end(), {ALC_FORMAT_CHANNELS_SOFT, ALC_STEREO_SOFT, ALC_FORMAT_TYPE_SOFT, ALC_SHORT_SOFT});
    requests.insert(requests.end(), {ALC_HRTF_SOFT, ALC_FALSE});
  }
  requests.push_back(0);
  context.reset(alcCreateContext(device.get(), requests.data()));
  if (!context || alcSetThreadContext(context.get()) == ALC_FALSE)
    return fail(ErrorCode::io_failure, "the sound device cannot be used", "sound", remedy);
  return {};
}

void SoundEngine::Impl::make_voices() {
  alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
  alDopplerFactor(0);  // the scene alone sets gains and pitches
  for (const SoundKind kind : kSoundKinds)
    clips[static_cast<std::size_t>(kind)] = make_clip_buffer(synthesise(kind));
  for (Voice& voice : voices) {
    alGenSources(1, &voice.source);
    alSourcef(voice.source, AL_ROLLOFF_FACTOR, 1);
    alSourcef(voice.source, AL_MAX_DISTANCE, kFarthest_m);
  }
  alGenSources(1, &speech);
  alSourcei(speech, AL_SOURCE_RELATIVE, AL_TRUE);
  alSourcef(speech, AL_ROLLOFF_FACTOR, 0);
}

void SoundEngine::Impl::listen(const SoundListener& listener, const SoundLevels& levels) const {
  const Eigen::Vector3f p = listener.p_W.cast<float>();
  std::array<float, 6> facing{};
  Eigen::Map<Eigen::Vector3f>(facing.data()) = listener.forward_W.cast<float>();
  Eigen::Map<Eigen::Vector3f>(facing.data() + 3) = listener.up_W.cast<float>();
  alListener3f(AL_POSITION, p.x(), p.y(), p.z());
  alListenerfv(AL_ORIENTATION, facing.data());
  const double volume = levels.muted ? 0 : std::clamp(levels.volume, 0.0, 1.0);
  alListenerf(AL_GAIN, static_cast<float>(volume));
}

void SoundEngine::Impl::end_speech() {
  alSourceStop(speech);
  alSourcei(speech, AL_BUFFER, 0);
  if (speech_buffer != 0) alDeleteBuffers(1, &speech_buffer);
  speech_buffer = 0;
}

void SoundEngine::Impl::begin_speech(const std::string& file) {
  if (bad_files.contains(file)) return;
  Expected<SoundRecording> read = read_sound(file);
  if (!read) {
    bad_files.insert(file);
    log::warning(read.error().to_string());
    return;
  }
  alGenBuffers(1, &speech_buffer);
  const ALenum format = read->channels == 1 ? AL_FORMAT_MONO16 : AL_FORMAT_STEREO16;
  alBufferData(speech_buffer, format, read->samples.data(), static_cast<ALsizei>(2 * read->samples.size()),
               read->rate_hz);
  alSourcei(speech, AL_BUFFER, static_cast<ALint>(speech_buffer));
  alSourcePlay(speech);
}

void SoundEngine::Impl::set_narration(const std::optional<Narration>& wanted) {
  // A narration whose file is not here yet may arrive later under the same id.
  const bool ready = wanted && !wanted->file.empty();
  const std::string id = ready ? wanted->id : std::string();
  if (id == narration) return;
  end_speech();
  narration = id;
  if (ready) begin_speech(wanted->file);
}

Voice* SoundEngine::Impl::voice_of(const std::string& id) {
  const auto at = std::ranges::find(voices, id, &Voice::id);
  return at == voices.end() ? nullptr : &*at;
}

/// A free voice, or else the quietest one if the new sound is louder.
Voice* SoundEngine::Impl::take_voice(double heard_gain) {
  const auto quietest =
      std::ranges::min_element(voices, {}, [](const Voice& voice) { return voice.id.empty() ? -1.0 : voice.heard; });
  if (!quietest->id.empty() && quietest->heard >= heard_gain) return nullptr;
  release(*quietest);
  return &*quietest;
}

void SoundEngine::Impl::begin(Voice& voice, const SoundSource& source) {
  voice.id = source.id;
  voice.looped = source.looped;
  // A one-shot sound has its full level from the first sample.
  voice.gain = source.looped ? 0 : source.gain;
  alSourcei(voice.source, AL_BUFFER, static_cast<ALint>(clips[static_cast<std::size_t>(source.kind)]));
  alSourcei(voice.source, AL_LOOPING, source.looped ? AL_TRUE : AL_FALSE);
  alSourcef(voice.source, AL_GAIN, static_cast<float>(kVoiceGain * duck * voice.gain));
}

void SoundEngine::Impl::set_voices(const SoundScene& scene) {
  for (Voice& voice : voices) {
    if (voice.looped) voice.target = voice.heard = 0;
  }
  std::vector<const SoundSource*> order;
  for (const SoundSource& source : scene.sources)
    order.push_back(&source);
  std::ranges::stable_sort(order, std::greater{},
                           [&](const SoundSource* source) { return heard(*source, scene.listener.p_W); });
  std::set<std::string> once;
  for (const SoundSource* source : order) {
    Voice* voice = voice_of(source->id);
    const bool known = voice != nullptr || begun.contains(source->id);
    if (!source->looped) once.insert(source->id);
    if (voice == nullptr && (source->looped || !known)) {
      voice = take_voice(heard(*source, scene.listener.p_W));
      if (voice != nullptr) begin(*voice, *source);
    }
    if (voice == nullptr) continue;
    voice->target = std::clamp(source->gain, 0.0, 1.0);
    voice->heard = heard(*source, scene.listener.p_W);
    set_vector(voice->source, AL_POSITION, source->p_W);
    alSourcef(voice->source, AL_REFERENCE_DISTANCE, static_cast<float>(near_of(*source)));
    alSourcef(voice->source, AL_PITCH, static_cast<float>(std::clamp(source->pitch, 0.25, 4.0)));
    if (!known || source->looped) {
      ALint state = 0;
      alGetSourcei(voice->source, AL_SOURCE_STATE, &state);
      if (state != AL_PLAYING) alSourcePlay(voice->source);
    }
  }
  begun = std::move(once);
}

void SoundEngine::Impl::move_gains(double step_s) {
  ALint speaks = 0;
  alGetSourcei(speech, AL_SOURCE_STATE, &speaks);
  duck = towards(duck, speaks == AL_PLAYING ? kDuckedGain : 1.0, step_s, kDuck_s);
  for (Voice& voice : voices) {
    if (voice.id.empty()) continue;
    voice.gain = voice.looped ? towards(voice.gain, voice.target, step_s, kGlide_s) : voice.target;
    ALint state = 0;
    alGetSourcei(voice.source, AL_SOURCE_STATE, &state);
    const bool faded = voice.looped && voice.target <= 0 && voice.gain < double{kSilent};
    if (state != AL_PLAYING || faded) {
      release(voice);
      continue;
    }
    alSourcef(voice.source, AL_GAIN, static_cast<float>(kVoiceGain * duck * voice.gain));
  }
}

SoundEngine::SoundEngine(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

SoundEngine::~SoundEngine() {
  if (!impl_->context) return;
  impl_->end_speech();
  for (Voice& voice : impl_->voices)
    alDeleteSources(1, &voice.source);
  alDeleteSources(1, &impl_->speech);
  alDeleteBuffers(static_cast<ALsizei>(impl_->clips.size()), impl_->clips.data());
}

Expected<std::unique_ptr<SoundEngine>> SoundEngine::open(SoundOutput output) {
  auto impl = std::make_unique<Impl>();
  impl->output = output;
  if (auto ok = impl->open_device(); !ok) return tl::unexpected(ok.error());
  impl->make_voices();
  if (alGetError() != AL_NO_ERROR)
    return fail(ErrorCode::busy, "the sound device has no room for this program's sounds", "sound",
                "close other programs that play sound");
  return std::unique_ptr<SoundEngine>(new SoundEngine(std::move(impl)));
}

void SoundEngine::apply(const SoundScene& scene, const SoundLevels& levels, double step_s) {
  alcSuspendContext(impl_->context.get());
  impl_->listen(scene.listener, levels);
  impl_->set_narration(scene.narration);
  impl_->set_voices(scene);
  impl_->move_gains(std::max(step_s, 0.0));
  alcProcessContext(impl_->context.get());
}

bool SoundEngine::lost() const {
  if (impl_->output == SoundOutput::samples) return false;
  if (alcIsExtensionPresent(impl_->device.get(), "ALC_EXT_disconnect") == ALC_FALSE) return false;
  ALCint connected = ALC_TRUE;
  alcGetIntegerv(impl_->device.get(), ALC_CONNECTED, 1, &connected);
  return connected == ALC_FALSE;
}

std::string SoundEngine::device() const {
  const ALCchar* name = alcGetString(impl_->device.get(), ALC_ALL_DEVICES_SPECIFIER);
  return name != nullptr ? name : "";
}

std::size_t SoundEngine::voices_playing() const {
  return static_cast<std::size_t>(std::ranges::count_if(impl_->voices, [](const Voice& v) { return !v.id.empty(); }));
}

std::string SoundEngine::speaking() const {
  ALint state = 0;
  alGetSourcei(impl_->speech, AL_SOURCE_STATE, &state);
  return state == AL_PLAYING ? impl_->narration : std::string();
}

const std::set<std::string>& SoundEngine::bad_files() const {
  return impl_->bad_files;
}

std::vector<float> SoundEngine::render(std::size_t frames) {
  MECHANE_ASSERT(impl_->output == SoundOutput::samples);
  std::vector<std::int16_t> samples(2 * frames);
  alcRenderSamplesSOFT(impl_->device.get(), samples.data(), static_cast<ALCsizei>(frames));
  std::vector<float> out(samples.size());
  std::ranges::transform(samples, out.begin(), [](std::int16_t s) { return static_cast<float>(s) / 32768.0F; });
  return out;
}

}  // namespace mechane::sound
