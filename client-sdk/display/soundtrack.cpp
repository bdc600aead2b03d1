#include "client-sdk/display/soundtrack.hpp"

#include <utility>

namespace mechane::display {

Soundtrack::Soundtrack(const SoundSettings& settings, bool audible, const std::string& language)
    : settings_(settings), audible_(audible), language_(language) {
  if (settings_.on && audible_) sound_.emplace(settings_, language_);
}

void Soundtrack::read(const client::WorldStatus* status, const std::string& language, TimePoint now) {
  subtitles_.hear(status, language, now);
}

std::string Soundtrack::in_writing(const std::string& language, TimePoint now) const {
  std::string said = subtitles_.at(now);
  const std::string sounds = captions_.at(now, language);
  if (!said.empty() && !sounds.empty()) said += ' ';
  return said + sounds;
}

void Soundtrack::hear(const HeardWorld& world, const picture::Camera& ears, const std::string& language,
                      TimePoint now) {
  std::vector<sound::SoundSource> sources = sounds_.hear(world.frame, world.presentation, world.objects, world.events);
  captions_.hear(sources, now);
  language_ = language;
  if (!sound_) return;
  sound_->set_language(language_);
  sound_->hear(ears, std::move(sources), world.status, world.folder);
}

void Soundtrack::set_levels(double volume, bool muted) {
  if (!sound_ && !muted && audible_) sound_.emplace(settings_, language_);
  if (sound_) sound_->set_levels({volume, muted});
}

std::optional<sound::SoundState> Soundtrack::state() const {
  return sound_ ? std::optional(sound_->state()) : std::nullopt;
}

}  // namespace mechane::display
