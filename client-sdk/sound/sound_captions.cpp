#include "client-sdk/sound/sound_captions.hpp"

#include <string_view>

namespace mechane::sound {
namespace {

constexpr double kWorthAWord = 0.25;  ///< least gain; the sounds of taking and releasing things stay below it
constexpr Duration kShown = std::chrono::seconds(3);
/// A pause shorter than this is not a new beginning: a crank may be released and taken again.
constexpr Duration kForgotten = std::chrono::seconds(20);

struct Words {
  SoundKind kind;
  std::string_view english, greek;
};
constexpr std::array<Words, kSoundKinds.size()> kWords{{
    {SoundKind::water, "water running", "νερό που τρέχει"},
    {SoundKind::splash, "water splashing", "νερό που χύνεται"},
    {SoundKind::creak, "wood creaking", "τρίξιμο ξύλου"},
    {SoundKind::knock, "knock of wood", "χτύπος ξύλου"},
    {SoundKind::rope, "rope straining", "τρίξιμο σχοινιού"},
    {SoundKind::scrape, "something scraping", "σύρσιμο"},
    {SoundKind::thud, "thud", "γδούπος"},
    {SoundKind::fire, "fire crackling", "φωτιά που τριζοβολά"},
    {SoundKind::steam, "steam hissing", "σφύριγμα ατμού"},
    {SoundKind::bow, "bowstring snapping", "χορδή που τινάζεται"},
    {SoundKind::ratchet, "ratchet clicking", "χτύποι καστάνιας"},
}};

}  // namespace

void SoundCaptions::hear(std::span<const SoundSource> sources, TimePoint now) {
  for (const SoundSource& source : sources) {
    if (source.gain <= kWorthAWord) continue;
    std::optional<Heard>& heard = heard_[static_cast<std::size_t>(source.kind)];
    if (!heard || now - heard->last > kForgotten) heard = {now, now};
    heard->last = now;
  }
}

std::string SoundCaptions::at(TimePoint now, const std::string& language) const {
  std::string text;
  for (const Words& words : kWords) {
    const std::optional<Heard>& heard = heard_[static_cast<std::size_t>(words.kind)];
    if (!heard || now - heard->begun >= kShown) continue;
    if (!text.empty()) text += ' ';
    text.append("[").append(language == "el" ? words.greek : words.english).append("]");
  }
  return text;
}

}  // namespace mechane::sound
