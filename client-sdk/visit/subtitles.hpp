// What is read aloud, in writing, for who does not hear it: sentence by sentence, each for as long as it takes to say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/base/clock.hpp"
#include <mechane/client/types.hpp>

namespace mechane::visit {

/// The id of the step that a visit is at; empty before it has one. A new id: its narration begins.
[[nodiscard]] std::string narration_id(const client::WorldStatus& status);

/// UTF-8. One of few words stays with the next; abbreviations end none.
[[nodiscard]] std::vector<std::string> sentences_of(std::string_view text);

/// Calm and clear: 14 letters a second, and a breath.
[[nodiscard]] Duration time_to_say(std::string_view sentence);

class Subtitles {
 public:
  /// Once a picture. Null: nobody speaks. Another step, or another language, begins anew.
  void hear(const client::WorldStatus* status, const std::string& language, TimePoint now);
  /// What is being said; empty: nothing.
  [[nodiscard]] std::string at(TimePoint now) const;

 private:
  std::string key_;
  std::vector<std::string> sentences_;
  TimePoint from_;
};

}  // namespace mechane::visit
