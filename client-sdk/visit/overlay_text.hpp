// The texts that a visitor reads, in the visitor's language, from the world's status.
#pragma once

#include <map>
#include <string>

#include "client-sdk/picture/overlay_content.hpp"
#include <mechane/client/client.hpp>

namespace mechane::visit {

/// The text in `language`, else in English, else in any language; empty when there is none.
[[nodiscard]] std::string text_in(const std::map<std::string, std::string>& texts, const std::string& language);

/// A calm note while there is no link or no hand; empty when all is well.
[[nodiscard]] std::string link_note(client::LinkState state, bool had_world, const std::string& language);

/// Caption, steps and readouts. A quantity is shown when its author gave it a label; and the first in a unit for visitors
/// (state::gauge_units()) where none in that unit has a label. A gauge has the author's range; without one it grows to include the value
/// and the step's goal, and its end is kept by name between calls.
class OverlayWriter {
 public:
  explicit OverlayWriter(std::string language) : language_(std::move(language)) {}
  void set_language(const std::string& language) { language_ = language; }
  [[nodiscard]] picture::OverlayContent write(const client::WorldStatus& status, const client::Frame* frame);

 private:
  picture::Readout readout_of(const client::QuantityInfo& info, double value);

  std::string language_;
  std::map<std::string, double> gauge_end_;
};

}  // namespace mechane::visit
