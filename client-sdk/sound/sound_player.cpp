#include "client-sdk/sound/sound_player.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "server/log/log.hpp"

namespace mechane::sound {
namespace {

/// How often gains are updated and the device is checked while no new scene arrives.
constexpr std::chrono::milliseconds kSoundStep{50};

}  // namespace

SoundPlayer::SoundPlayer(SoundPlayerOptions options)
    : options_(options), levels_(options.levels), thread_([this](const std::stop_token& stop) { run(stop); }) {}

SoundPlayer::~SoundPlayer() = default;

void SoundPlayer::play(SoundScene scene) {
  const std::lock_guard lock(mutex_);
  if (wanted_) {
    // A one-shot sound of a scene that was never played is added to the next scene.
    const auto kept = [](const SoundSource& source) { return !source.looped; };
    std::ranges::copy_if(wanted_->sources, std::back_inserter(scene.sources), kept);
  }
  wanted_ = std::move(scene);
  wanted_at_ = Clock::now();
  news_.notify_one();
}

void SoundPlayer::set_levels(const SoundLevels& levels) {
  const std::lock_guard lock(mutex_);
  levels_ = levels;
}

SoundLevels SoundPlayer::levels() const {
  const std::lock_guard lock(mutex_);
  return levels_;
}

SoundState SoundPlayer::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void SoundPlayer::run(const std::stop_token& stop) {
  auto before = Clock::now();
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(mutex_);
      news_.wait_for(lock, stop, kSoundStep, [this] { return wanted_.has_value(); });
    }
    const auto now = Clock::now();
    tend_device(now);
    play_newest(now, now - std::exchange(before, now));
  }
  engine_.reset();  // on the thread that made it
}

/// Opens the device, and gives up one that was lost.
void SoundPlayer::tend_device(Clock::time_point now) {
  if (engine_ != nullptr && engine_->lost()) {
    engine_.reset();
    pause_ = options_.first_retry;
    tell({ErrorCode::not_found, "the sound device was lost", "sound", "connect it again: it is found by itself"}, now);
  }
  if (engine_ != nullptr || now < next_try_) return;
  auto opened = SoundEngine::open(SoundOutput::device);
  if (!opened) {
    pause_ = pause_.count() == 0 ? options_.first_retry : std::min(2 * pause_, options_.longest_retry);
    tell(std::move(opened.error()), now);
    return;
  }
  engine_ = std::move(*opened);
  pause_ = {};
  told_.clear();
  const std::string device = engine_->device();
  log::info("sound: " + device);
  const std::lock_guard lock(mutex_);
  state_.sounding = true;
  state_.device = device;
  state_.problem.clear();
}

void SoundPlayer::tell(Error error, Clock::time_point now) {
  next_try_ = now + pause_;
  if (told_ != error.what) log::warning(error.to_string());
  told_ = error.what;
  const std::lock_guard lock(mutex_);
  state_.sounding = false;
  state_.device.clear();
  state_.voices = 0;
  state_.speaking.clear();
  state_.problem = std::move(error.what);
}

void SoundPlayer::play_newest(Clock::time_point now, Clock::duration step) {
  SoundLevels levels;
  {
    const std::lock_guard lock(mutex_);
    // A narration that has begun is played to its end; effects belong to the moment.
    if (wanted_) playing_ = *std::exchange(wanted_, std::nullopt);
    if (now - wanted_at_ > options_.forget) playing_.sources.clear();
    levels = levels_;
  }
  if (engine_ == nullptr) return;
  engine_->apply(playing_, levels, std::chrono::duration<double>(step).count());
  const std::lock_guard lock(mutex_);
  state_.voices = engine_->voices_playing();
  state_.speaking = engine_->speaking();
  state_.bad_files = engine_->bad_files();
}

}  // namespace mechane::sound
