#include "client-sdk/visit/overlay_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "server/base/math.hpp"

namespace mechane::visit {
namespace {

/// A unit that is shown to visitors: its name, what it measures, the first end of its gauge.
struct ReadableUnit {
  std::string_view unit;
  std::string_view label_en, label_el;
  std::string_view unit_en, unit_el;
  double first_end;
  int decimals;
};

constexpr std::array<ReadableUnit, 6> kUnits{{
    {"l", "Water", "Νερό", "litres", "λίτρα", 5, 1},
    {"rpm", "Speed", "Ταχύτητα", "turns/min", "στρ./λεπτό", 60, 0},
    {"l/min", "Flow", "Ροή", "litres/min", "λίτρα/λεπτό", 30, 0},
    {"N", "Force", "Δύναμη", "newtons", "νιούτον", 5, 1},
    {"degC", "Temperature", "Θερμοκρασία", "°C", "°C", 100, 0},
    {"km", "Distance", "Απόσταση", "km", "χλμ.", 1, 2},
}};

std::optional<ReadableUnit> readable(const std::string& unit) {
  const auto* const found = std::ranges::find(kUnits, unit, &ReadableUnit::unit);
  return found == kUnits.end() ? std::nullopt : std::optional(*found);
}

std::string number(double value, int decimals, bool greek) {
  if (std::abs(value) >= 100) decimals = 0;  // tenths do not matter there, and do not fit into the gauge
  // No minus before a rounded zero.
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0;
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (greek) std::ranges::replace(text, '.', ',');
  return text;
}

}  // namespace

std::string text_in(const std::map<std::string, std::string>& texts, const std::string& language) {
  for (const std::string& wanted : {language, std::string("en")}) {
    if (const auto found = texts.find(wanted); found != texts.end()) return found->second;
  }
  return texts.empty() ? std::string() : texts.begin()->second;
}

std::string link_note(client::LinkState state, bool had_world, const std::string& language) {
  const bool greek = language == "el";
  switch (state) {
    case client::LinkState::joined:
      return {};
    case client::LinkState::searching:
    case client::LinkState::refused:
      if (had_world) break;
      return greek ? "Το έκθεμα ετοιμάζεται …" : "The exhibit is getting ready …";
    case client::LinkState::lost:
      break;
  }
  return greek ? "Μια στιγμή, το έκθεμα συνεχίζει αμέσως …" : "One moment, the exhibit will go on …";
}

picture::OverlayContent OverlayWriter::write(const client::WorldStatus& status, const client::Frame* frame) {
  const bool greek = language_ == "el";
  picture::OverlayContent content;
  content.title = text_in(status.title, language_);
  content.caption = text_in(status.caption, language_);
  if (status.done) content.caption = greek ? "Τα καταφέρατε!" : "You have done it!";
  if (status.hint && !status.done) content.hint = text_in(status.hint_text, language_);
  content.steps_done = status.steps_done;
  content.steps_total = status.steps_total;
  if (frame == nullptr) return content;
  std::set<std::string> shown;
  for (std::size_t i = 0; i < std::min(status.quantities.size(), frame->quantities.size()); ++i) {
    const client::QuantityInfo& info = status.quantities[i];
    // Visitors see which way a crank turns; a minus before its speed would only confuse.
    const double value = info.unit == "rpm" ? std::abs(frame->quantities[i]) : frame->quantities[i];
    const std::optional<ReadableUnit> unit = readable(info.unit);
    // At most one readout per unit, so that the panel stays simple.
    if (!unit || !std::isfinite(value) || !shown.insert(info.unit).second) continue;
    double& end = gauge_end_.try_emplace(info.name, unit->first_end).first->second;
    const double goal = info.goal ? std::abs(info.goal->value) : 0;
    if (const double most = std::max(std::abs(value), goal); most > end) end = round_up_to_scale(std::max(most, 1e-6));
    content.readouts.push_back(
        {std::string(greek ? unit->label_el : unit->label_en), number(value, unit->decimals, greek),
         std::string(greek ? unit->unit_el : unit->unit_en), std::abs(value) / end, number(end, end < 1 ? 1 : 0, greek),
         info.goal && !status.done ? std::optional(goal / end) : std::nullopt});
  }
  return content;
}

}  // namespace mechane::visit
