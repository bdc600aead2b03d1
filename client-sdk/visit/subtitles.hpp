// Subtitles of the narration: sentence by sentence, each for as long as it takes to say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/base/clock.hpp"
#include <mechane/client/types.hpp>

namespace mechane::visit {

/// The id of a visit's present step; empty before it has one. With a new id its narration begins.
[[nodiscard]] std::string narration_id(const client::WorldStatus& status);

/// Splits UTF-8 text into sentences. A short one stays with the next; an abbreviation does not end a sentence.
[[nodiscard]] std::vector<std::string> sentences_of(std::string_view text);

/// How long a sentence is shown, at a calm pace: 14 letters a second, and a pause.
[[nodiscard]] Duration time_to_say(std::string_view sentence);

class Subtitles {
 public:
  /// Call it once a picture. Null: nobody speaks. Another step or language starts again.
  void hear(const client::WorldStatus* status, const std::string& language, TimePoint now);
  /// The sentence that is being spoken; empty: none.
  [[nodiscard]] std::string at(TimePoint now) const;

 private:
  std::string key_;
  std::vector<std::string> sentences_;
  TimePoint from_;
};

}  // namespace mechane::visit
