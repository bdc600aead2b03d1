#include "client-sdk/gateway/operations/operations.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "server/base/utf8.hpp"
#include "server/base/whole_file.hpp"
#include <mechane/client/displays.hpp>
#include <mechane/proto/names.hpp>

namespace mechane::gateway {
namespace {

using StoreJson = nlohmann::json;

constexpr std::uintmax_t kMostStoreBytes = std::uintmax_t{4} << 20U;
constexpr std::int64_t kSoon_s = 600;
constexpr int kMostMinutes = 7 * 24 * 60;

tl::unexpected<Error> wrong_order(std::string what, const char* field, std::string remedy) {
  return fail(ErrorCode::invalid_value, std::move(what), field, std::move(remedy));
}

tl::unexpected<Error> damaged_store() {
  return fail(ErrorCode::damaged, "this is not a file of hours, messages and maintenance", {},
              "put the file back from a copy, or move it away: the gateway then begins without any");
}

std::optional<std::string> text_member(const StoreJson& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

std::optional<std::int64_t> number_member(const StoreJson& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number_integer()) return std::nullopt;
  return found->get<std::int64_t>();
}

std::optional<std::map<std::string, std::string>> texts_member(const StoreJson& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_object() || found->size() > 64) return std::nullopt;
  std::map<std::string, std::string> out;
  for (const auto& [name, text] : found->items()) {
    if (!text.is_string()) return std::nullopt;
    out[name] = text.get<std::string>();
  }
  return out;
}

/// Texts of a message: each can be a setting of a display.
Expected<std::map<std::string, std::string>> message_texts(const StoreJson& json) {
  const auto texts = texts_member(json, "texts");
  if (!texts) return wrong_order("the message has no texts", "texts", R"(send {"texts": {"el": "...", "en": "..."}})");
  std::map<std::string, std::string> out;
  for (const auto& [language, text] : *texts) {
    if (text.empty()) continue;
    client::DisplaySettings tried;
    if (auto fits = client::apply({"message-" + language, text}, tried); !fits) {
      const bool known = language == "el" || language == "en";
      return wrong_order(
          known ? "this text is too long, or has line breaks" : "displays have no words in this language", "texts",
          known ? "write one line of 240 bytes at most: about 120 letters of Greek" : "write el or en");
    }
    out[language] = text;
  }
  if (out.empty()) return wrong_order("the message is empty", "texts", "write a text in Greek or English");
  return out;
}

Expected<std::vector<std::string>> kiosks_member(const StoreJson& json) {
  std::vector<std::string> out;
  const auto found = json.find("kiosks");
  if (found == json.end()) return out;
  if (!found->is_array() || found->size() > OpeningHours::kMostKiosks)
    return wrong_order("kiosks is not a list of a hundred names at most", "kiosks",
                       "send a list of names; [] is all of them");
  for (const StoreJson& kiosk : *found) {
    if (!kiosk.is_string()) return wrong_order("a kiosk's name is not a text", "kiosks", "send a list of names");
    out.push_back(kiosk.get<std::string>());
    if (auto named = proto::check_name(out.back(), "kiosks"); !named) return tl::unexpected(named.error());
  }
  return out;
}

std::optional<VisitorMessage> stored_message(const StoreJson& json) {
  if (!json.is_object()) return std::nullopt;
  const auto id = number_member(json, "id"), until = number_member(json, "until");
  auto texts = message_texts(json);
  auto kiosks = kiosks_member(json);
  if (!id || *id <= 0 || !until || !texts || !kiosks) return std::nullopt;
  return VisitorMessage{static_cast<std::uint64_t>(*id), std::move(*kiosks), std::move(*texts), *until};
}

std::optional<TimedChange> stored_change(const StoreJson& json) {
  if (!json.is_object()) return std::nullopt;
  const auto id = number_member(json, "id"), until = number_member(json, "until");
  const auto kiosk = text_member(json, "kiosk"), name = text_member(json, "name"), value = text_member(json, "value");
  const auto before = texts_member(json, "before");
  if (!id || *id <= 0 || !until || !kiosk || !proto::is_name(*kiosk) || !name || !value || !before) return std::nullopt;
  return TimedChange{static_cast<std::uint64_t>(*id), *kiosk, *name, *value, *before, *until};
}

template <class One>
bool read_list(const StoreJson& json, const char* key, std::size_t most, std::optional<One> (*read)(const StoreJson&),
               std::vector<One>& into) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_array() || found->size() > most) return false;
  for (const StoreJson& one : *found) {
    auto made = read(one);
    if (!made) return false;
    into.push_back(std::move(*made));
  }
  return true;
}

bool read_maintenance(const StoreJson& json, OperationsState& into) {
  const auto found = json.find("maintenance");
  if (found == json.end() || !found->is_object() || found->size() > OperationsState::kMostInMaintenance) return false;
  for (const auto& [kiosk, until] : found->items()) {
    if (!proto::is_name(kiosk) || !(until.is_null() || until.is_number_integer())) return false;
    into.maintenance[kiosk] = until.is_null() ? std::nullopt : std::optional(until.get<std::int64_t>());
  }
  return true;
}

Expected<std::optional<std::int64_t>> end_in(const StoreJson& json, std::int64_t now) {
  if (!json.is_object()) return wrong_order("this request is not a JSON object", "until", "send an object");
  const auto minutes = json.find("minutes"), until = json.find("until");
  if (minutes != json.end() && until != json.end())
    return wrong_order("an end is given twice", "until", "send minutes, or until");
  if (minutes != json.end()) {
    const double count = minutes->is_number() ? minutes->get<double>() : 0;
    if (!(count > 0 && count <= kMostMinutes))
      return wrong_order("minutes is not a number from above 0 to 10080", "minutes",
                         "write how many minutes it lasts: a week at most");
    return now + std::max<std::int64_t>(1, static_cast<std::int64_t>(60 * count));
  }
  if (until == json.end()) return std::nullopt;
  const auto at = until->is_string() ? minutes_of_day(until->get<std::string>()) : std::nullopt;
  if (!at) return wrong_order("until is not a time of the day", "until", "write hours and minutes: 18:30");
  return next_at(*at, now);
}

bool is_for(const VisitorMessage& message, const std::string& kiosk) {
  return message.kiosks.empty() || std::ranges::count(message.kiosks, kiosk) > 0;
}

}  // namespace

Expected<OperationsState> parse_operations(std::string_view text) {
  const StoreJson json = StoreJson::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("hours")) return damaged_store();
  OperationsState state;
  const auto next_id = number_member(json, "nextId");
  auto hours = parse_hours(json["hours"].dump(-1, ' ', false, StoreJson::error_handler_t::replace));
  if (!hours || !next_id || *next_id <= 0) return damaged_store();
  state.next_id = static_cast<std::uint64_t>(*next_id);
  state.hours = std::move(*hours);
  const bool whole = read_list(json, "messages", OperationsState::kMostMessages, stored_message, state.messages) &&
                     read_list(json, "changes", OperationsState::kMostChanges, stored_change, state.changes) &&
                     read_maintenance(json, state);
  if (!whole) return damaged_store();
  return state;
}

std::string operations_text(const OperationsState& state) {
  StoreJson messages = StoreJson::array(), changes = StoreJson::array(), maintenance = StoreJson::object();
  for (const VisitorMessage& one : state.messages)
    messages.push_back({{"id", one.id}, {"kiosks", one.kiosks}, {"texts", one.texts}, {"until", one.until}});
  for (const TimedChange& one : state.changes)
    changes.push_back({{"id", one.id},
                       {"kiosk", one.kiosk},
                       {"name", one.name},
                       {"value", one.value},
                       {"before", one.before},
                       {"until", one.until}});
  for (const auto& [kiosk, until] : state.maintenance)
    maintenance[kiosk] = until ? StoreJson(*until) : StoreJson();
  return StoreJson{{"nextId", state.next_id},
                   {"hours", StoreJson::parse(hours_text(state.hours))},
                   {"messages", messages},
                   {"changes", changes},
                   {"maintenance", maintenance}}
             .dump(2, ' ', false, StoreJson::error_handler_t::replace) +
         "\n";
}

Expected<std::optional<std::int64_t>> parse_end(std::string_view text, std::int64_t now) {
  return end_in(StoreJson::parse(text, nullptr, false), now);
}

Expected<VisitorMessage> parse_visitor_message(std::string_view text, std::int64_t now) {
  const StoreJson json = StoreJson::parse(text, nullptr, false);
  const auto end = end_in(json, now);
  if (!end) return tl::unexpected(end.error());
  if (!*end) return wrong_order("the message has no end", "minutes", R"(send {"minutes": 30}, or {"until": "18:30"})");
  auto texts = message_texts(json);
  if (!texts) return tl::unexpected(texts.error());
  auto kiosks = kiosks_member(json);
  if (!kiosks) return tl::unexpected(kiosks.error());
  return VisitorMessage{0, std::move(*kiosks), std::move(*texts), **end};
}

bool in_maintenance(const OperationsState& state, const std::string& kiosk, std::int64_t now) {
  const auto found = state.maintenance.find(kiosk);
  return found != state.maintenance.end() && (!found->second || *found->second > now);
}

KioskTarget target_of(const OperationsState& state, const std::string& kiosk, std::int64_t now) {
  KioskTarget target;
  const HoursPlan* const plan = plan_of(state.hours, kiosk);
  target.open = plan == nullptr || is_open(*plan, now);
  if (!target.open) target.sign = "closed";
  if (in_maintenance(state, kiosk, now)) target.sign = "maintenance";
  for (const VisitorMessage& message : state.messages) {  // the newest one counts
    if (message.until <= now || !is_for(message, kiosk)) continue;
    const auto text = [&message](const char* language) {
      const auto found = message.texts.find(language);
      return found == message.texts.end() ? std::string() : found->second;
    };
    target.message_el = text("el");
    target.message_en = text("en");
  }
  const bool silent = target.message_el.empty() && target.message_en.empty();
  if (silent && target.open && plan != nullptr && !is_open(*plan, now + kSoon_s)) {
    target.message_el = "Κλείνουμε σε λιγότερο από δέκα λεπτά.";
    target.message_en = "We close in less than ten minutes.";
  }
  return target;
}

Expected<void> add_change(OperationsState& state, TimedChange change) {
  for (TimedChange& known : state.changes) {
    if (known.kiosk != change.kiosk || known.name != change.name) continue;
    for (const auto& [display, value] : change.before)
      known.before.try_emplace(display, value);
    known.value = std::move(change.value);
    known.until = change.until;
    return {};
  }
  if (state.changes.size() >= OperationsState::kMostChanges)
    return fail(ErrorCode::too_large, "too many changes wait for their end", "until", "end some of them first");
  change.id = state.next_id++;
  state.changes.push_back(std::move(change));
  return {};
}

OperationsState without_ended(OperationsState state, std::int64_t now) {
  std::erase_if(state.messages, [now](const VisitorMessage& one) { return one.until <= now; });
  std::erase_if(state.maintenance, [now](const auto& one) { return one.second && *one.second <= now; });
  return state;
}

Expected<Operations> Operations::open(const std::filesystem::path& folder) {
  Operations made(folder / "operations.json");
  const auto bytes = read_whole(made.file_, kMostStoreBytes);
  if (!bytes && bytes.error().code == ErrorCode::not_found) return made;
  if (!bytes) return tl::unexpected(bytes.error());
  auto state = parse_operations(as_text(*bytes));
  if (!state) return tl::unexpected(state.error().in(made.file_.string()));
  made.state_ = std::move(*state);
  return made;
}

Expected<void> Operations::change(OperationsState next) {
  if (next == state_) return {};
  const std::string text = operations_text(next);
  if (auto written = write_whole(file_, std::as_bytes(std::span(text)), WholeFile::shared); !written) return written;
  state_ = std::move(next);
  return {};
}

}  // namespace mechane::gateway
