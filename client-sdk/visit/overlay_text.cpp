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

/// Other units that visitors read otherwise than authors write them.
struct UnitSymbol {
  std::string_view unit, en, el;
};

constexpr std::array<UnitSymbol, 4> kSymbols{
    {{"deg", "°", "°"}, {"turns", "turns", "στροφές"}, {"m2", "m²", "m²"}, {"m3", "m³", "m³"}}};

/// A unit that displays know, or one that the author's label explains. What has no unit is counted in whole numbers.
ReadableUnit unit_of(const client::QuantityInfo& info) {
  if (const auto known = readable(info.unit)) return *known;
  const auto* const symbol = std::ranges::find(kSymbols, info.unit, &UnitSymbol::unit);
  const bool has_symbol = symbol != kSymbols.end();
  return {info.unit,
          {},
          {},
          has_symbol ? symbol->en : info.unit,
          has_symbol ? symbol->el : info.unit,
          1,
          info.unit.empty() ? 0 : 1};
}

/// Visitors see which way a crank turns; a minus before its speed would only confuse, unless its gauge begins below 0.
double as_shown(const client::QuantityInfo& info, double value) {
  return info.unit == "rpm" && !(info.range && info.range->least < 0) ? std::abs(value) : value;
}

/// Where a value is on a gauge, 0..1. One without a range has no sign.
double place_of(const client::QuantityInfo& info, double value, double end) {
  if (!info.range) return std::abs(value) / end;
  return std::clamp((as_shown(info, value) - info.range->least) / (info.range->greatest - info.range->least), 0.0, 1.0);
}

/// Decimals with which a value has twenty steps or more on a gauge of this length; two at most.
int decimals_for(double length) {
  return length >= 20 ? 0 : length >= 2 ? 1 : 2;
}

std::string number(double value, int decimals, bool greek) {
  if (std::abs(value) >= 100) decimals = 0;  // tenths do not matter there, and do not fit into the gauge
  // No minus before a rounded zero.
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0;
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (greek) std::ranges::replace(text, '.', ',');
  return text;
}

/// The end of a range as its author wrote it.
std::string end_text(double end, bool greek) {
  int decimals = 0;
  for (double ten = 1; decimals < 3 && std::abs(std::remainder(end * ten, 1.0)) > 1e-6; ten *= 10)
    ++decimals;
  return number(end, decimals, greek);
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
  // At most one readout per unit, so that the panel stays simple, except those that the author has named.
  std::set<std::string> shown;
  for (const client::QuantityInfo& info : status.quantities) {
    if (!info.label.empty()) shown.insert(info.unit);
  }
  for (std::size_t i = 0; i < std::min(status.quantities.size(), frame->quantities.size()); ++i) {
    const client::QuantityInfo& info = status.quantities[i];
    if (!std::isfinite(frame->quantities[i])) continue;
    if (info.label.empty() && (!readable(info.unit) || !shown.insert(info.unit).second)) continue;
    content.readouts.push_back(readout_of(info, as_shown(info, frame->quantities[i])));
    if (status.done) content.readouts.back().goal.reset();
  }
  return content;
}

picture::Readout OverlayWriter::readout_of(const client::QuantityInfo& info, double value) {
  const bool greek = language_ == "el";
  const ReadableUnit unit = unit_of(info);
  picture::Readout out;
  out.named = !info.label.empty();
  out.label = out.named ? text_in(info.label, language_) : std::string(greek ? unit.label_el : unit.label_en);
  out.unit = greek ? unit.unit_el : unit.unit_en;
  int decimals = unit.decimals;
  double end = 0;
  if (info.range) {
    end = info.range->greatest;
    const double length = end - info.range->least;
    if (!info.unit.empty() || length < 2) decimals = std::max(decimals, decimals_for(length));
    out.begin = end_text(info.range->least, greek);
    out.end = end_text(end, greek);
  } else {
    double& grown = gauge_end_.try_emplace(info.name, unit.first_end).first->second;
    const double goal = info.goal ? std::abs(info.goal->value) : 0;
    if (const double most = std::max(std::abs(value), goal); most > grown)
      grown = round_up_to_scale(std::max(most, 1e-6));
    end = grown;
    out.end = number(end, end < 1 ? 1 : 0, greek);
  }
  out.value = number(value, decimals, greek);
  out.fraction = place_of(info, value, end);
  if (info.goal) out.goal = place_of(info, info.goal->value, end);
  return out;
}

}  // namespace mechane::visit
