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

/// Caption, steps and readouts. A quantity is shown when its unit is one for visitors (l, rpm, N, degC, km/h ...).
/// Gauges grow to include the value and the step's goal; their ends are kept by name between calls.
class OverlayWriter {
 public:
  explicit OverlayWriter(std::string language) : language_(std::move(language)) {}
  void set_language(const std::string& language) { language_ = language; }
  [[nodiscard]] picture::OverlayContent write(const client::WorldStatus& status, const client::Frame* frame);

 private:
  std::string language_;
  std::map<std::string, double> gauge_end_;
};

}  // namespace mechane::visit
