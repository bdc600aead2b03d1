#include "client-sdk/visit/subtitles.hpp"

#include <cctype>

#include <fmt/format.h>

#include "client-sdk/visit/overlay_text.hpp"
#include "server/base/utf8.hpp"

namespace mechane::visit {
namespace {

constexpr std::size_t kFewWords = 25;  ///< bytes
constexpr double kLettersPerSecond = 14;
constexpr double kBreath_s = 1;

/// A capital, Latin or Greek (U+0386 to U+03AB).
bool begins_sentence(std::string_view text) {
  if (text.empty()) return false;
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return std::isupper(first) != 0;
  if (first != 0xce || text.size() < 2) return false;
  const auto second = static_cast<unsigned char>(text[1]);
  return second >= 0x86 && second <= 0xab;
}

/// Whether the text ends with the end of a sentence. A full stop after a word of one or two letters is an
/// abbreviation's: "c.", "B.C.", "αι.".
bool ends_sentence(std::string_view text) {
  const char mark = text.back();
  if (mark == '!' || mark == '?' || mark == ';') return true;  // ';' is the Greek question mark
  if (mark != '.') return false;
  text.remove_suffix(1);
  return utf8_letters(text.substr(text.find_last_of(" .") + 1)) > 2;
}

}  // namespace

std::string narration_id(const client::WorldStatus& status) {
  if (status.step.empty()) return {};
  return fmt::format("{}/{}/{}/{}", status.world, status.scenario_hash, status.activity, status.step);
}

std::vector<std::string> sentences_of(std::string_view text) {
  std::vector<std::string> sentences;
  std::size_t from = 0;
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    const bool ends =
        text[at + 1] == ' ' && begins_sentence(text.substr(at + 2)) && ends_sentence(text.substr(from, at + 1 - from));
    if (!ends || at + 1 - from < kFewWords) continue;
    sentences.emplace_back(text.substr(from, at + 1 - from));
    from = at + 2;
  }
  if (from < text.size()) sentences.emplace_back(text.substr(from));
  return sentences;
}

Duration time_to_say(std::string_view sentence) {
  const double seconds = kBreath_s + static_cast<double>(utf8_letters(sentence)) / kLettersPerSecond;
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

void Subtitles::hear(const client::WorldStatus* status, const std::string& language, TimePoint now) {
  const bool speaks = status != nullptr && !status->done;
  const std::string key = speaks ? narration_id(*status) + " " + language : std::string();
  if (key == key_) return;
  key_ = key;
  sentences_ = speaks ? sentences_of(text_in(status->narration, language)) : std::vector<std::string>();
  from_ = now;
}

std::string Subtitles::at(TimePoint now) const {
  TimePoint until = from_;
  for (const std::string& sentence : sentences_) {
    until += time_to_say(sentence);
    if (now < until) return sentence;
  }
  return {};
}

}  // namespace mechane::visit
